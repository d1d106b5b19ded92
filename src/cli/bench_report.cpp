#include "cli/bench_report.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/message.h"

namespace defocus {

namespace {

// A python3 from elsewhere may come first on the path, without Debian's packages.
constexpr const char* interpreters[] = {"python3", "/usr/bin/python3"};

// The exit code of `words`, found on the path and run to its end; -1 where it can't be run. What it prints goes to
// stderr, or nowhere.
int exitCodeOf(std::vector<std::string> words, bool silent) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) return -1;
    if (child == 0) {
        const int nowhere = silent ? ::open("/dev/null", O_WRONLY) : -1;
        ::dup2(silent ? nowhere : STDERR_FILENO, STDOUT_FILENO);
        if (silent) ::dup2(nowhere, STDERR_FILENO);
        ::execvp(pointers[0], pointers.data());
        ::_exit(127);
    }
    int status = 0;
    if (::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
}

// False where there is no Python with matplotlib.
bool runScript(const std::filesystem::path& results, const std::filesystem::path& report) {
    for (const char* python : interpreters) {
        if (exitCodeOf({python, "-c", "import matplotlib.pyplot, PIL"}, true) != 0) continue;
        const int code = exitCodeOf({python, "-c", reportScript(), results.string(), report.string()}, false);
        if (code != 0)
            fail(
                "{}: the report could not be drawn (exit code {} of its script); the results beside it stand on their "
                "own",
                (report / "index.html").string(), code);
        return true;
    }
    return false;
}

}  // namespace

void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report) {
    command
        .add_option("--report", report,
                    "Instead: a folder for the same files and index.html, plots and tables in one file; of all benches "
                    "that have written there (needs python3-matplotlib)")
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
            "no report: there is no python3 with matplotlib (Debian: python3-matplotlib); the results in {} stand "
            "on their own\n",
            report.string());
}

}  // namespace defocus
