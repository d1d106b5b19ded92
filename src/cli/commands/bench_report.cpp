#include "cli/commands/bench_report.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/message.h"

namespace defocus::engine {

namespace {

// Python interpreters to try in order. The first python3 in PATH may lack packages that Debian has for
// /usr/bin/python3.
constexpr const char* interpreters[] = {"python3", "/usr/bin/python3"};

// Exit codes of report_script.cpp.in for a missing interpreter and for an interpreter without matplotlib.
constexpr int notInstalled = 127;
constexpr int withoutMatplotlib = 3;

// Runs a program found in PATH, with its output on stderr. Returns its exit code; −1 if a signal killed it.
int exitCodeOf(std::vector<std::string> words) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) return -1;
    if (child == 0) {
        ::dup2(STDERR_FILENO, STDOUT_FILENO);
        ::execvp(pointers[0], pointers.data());
        ::_exit(notInstalled);
    }
    int status = 0;
    if (::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
}

// Draws the report with the first interpreter that has matplotlib. Returns false if there is none. Throws Error if the
// script fails.
bool runScript(const std::filesystem::path& results, const std::filesystem::path& report) {
    for (const char* python : interpreters) {
        const int code = exitCodeOf({python, "-c", reportScript(), results.string(), report.string()});
        if (code == 0) return true;
        if (code != notInstalled && code != withoutMatplotlib)
            fail("cannot create the report {}: Python ended with exit code {}; all result files are complete",
                 (report / "index.html").string(), code);
    }
    return false;
}

}  // namespace

void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report) {
    command
        .add_option("--report", report,
                    "Folder for the results and for index.html, a page with plots and tables of all results in the "
                    "folder (requires python3-matplotlib). Replaces --output")
        ->type_name("FOLDER")
        ->excludes(output)
        ->group("Output");
}

void drawReport(const std::filesystem::path& results, const std::filesystem::path& report) {
    if (report.empty()) return;
    if (runScript(results, report))
        fmt::print("\nreport: {}\n", (report / "index.html").string());
    else
        printMessage(
            "no report: python3 with matplotlib is missing (Debian: python3-matplotlib); the results are in {}\n",
            report.string());
}

}  // namespace defocus::engine
