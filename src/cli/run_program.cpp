#include "cli/run_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/options/help_format.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/message.h"
#include "core/source_date.h"
#include "core/suggestion.h"
#include "frame/program_facts.h"

namespace defocus::engine {

namespace {

constexpr int failed = 1;
constexpr int wrongCommandLine = 2;

int printFault(int code, std::string message) {
    for (char& letter : message)
        if (letter == '\n') letter = ' ';
    printMessage("defocus: {}\n", message);
    return code;
}

void addGlobalOptions(CLI::App& program, GlobalOptions& global) {
    program.set_version_flag("--version", "defocus " + programVersion(), "Print the version and exit");
    program.add_flag("--quiet", global.quiet, "Print only errors: no progress, warnings or summary");
    program.add_flag("--verbose", global.verbose,
                     "Also print details: the device, cache use, times, and what is left out of the image and why");
    advanced(program
                 .add_option("--shader-dir", global.shaderDir,
                             "Folder of shaders to use instead of the built-in shaders, for live editing")
                 ->type_name("FOLDER")
                 ->check(unnamed(CLI::ExistingDirectory)));
}

std::vector<std::string> namesOf(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands(nullptr)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionsOf(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// Returns the innermost command on the command line, such as "speedup" for "bench speedup"; without a command, the
// program.
const CLI::App& chosenCommand(const CLI::App& program) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    return chosen.empty() ? program : chosenCommand(*chosen.front());
}

// Throws UsageError for --shader-dir with a command that doesn't use it.
void refuseUnusedShaders(const CLI::App& program, const GlobalOptions& global) {
    constexpr std::array drawing = {"render", "capture", "view", "speedup", "popping", "convergence", "scaling"};
    const std::string& command = chosenCommand(program).get_name();
    if (!global.shaderDir.empty() && std::ranges::find(drawing, command) == drawing.end())
        throw UsageError(fmt::format("--shader-dir cannot be used with '{}', which draws nothing", command));
}

std::string helpHint(const CLI::App& program) {
    return fmt::format("see defocus{} --help", pathOf(chosenCommand(program)));
}

bool isOption(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

// Returns the option of the command that corresponds to `word`, an option name from other programs; empty if there is
// none.
std::string knownForForeign(const CLI::App& command, std::string_view word) {
    static constexpr std::pair<std::string_view, const char*> table[] = {
        {"--aperture", "--fstop"},       {"--f-number", "--fstop"},
        {"--fov", "--focal-length"},     {"--sensor-width", "--horizontal-aperture"},
        {"--focus", "--focus-distance"}, {"--width", "--size"},
        {"--height", "--size"},          {"--resolution", "--size"},
        {"--spp", "--samples"},          {"--hdri", "--environment"},
        {"--fps", "--frame-rate"},       {"--frames", "--range"},
    };
    for (const auto& [foreign, own] : table)
        if (foreign == word && command.get_option_no_throw(own) != nullptr) return own;
    return "";
}

// Returns an error message for unexpected words: an unknown option, an unknown command, or an extra argument.
std::string unexpected(const CLI::App& program, const std::vector<std::string>& words) {
    const CLI::App& command = chosenCommand(program);
    const auto option = std::ranges::find_if(words, isOption);
    const std::string word = option != words.end() ? *option : words.front();

    std::vector<std::string> known = namesOf(command);
    std::string what = "command";
    if (option != words.end()) {
        what = "option";
        known = optionsOf(program);
        const std::vector<std::string> own = optionsOf(command);
        known.insert(known.end(), own.begin(), own.end());
    } else if (known.empty()) {
        return fmt::format("unexpected argument '{}'; {}", word, helpHint(program));
    }
    const std::string name = word.substr(0, word.find('='));
    std::string nearest = knownForForeign(command, name);
    if (nearest.empty()) nearest = nearestWord(name, known);
    if (!nearest.empty()) return fmt::format("there is no {} '{}'; did you mean '{}'?", what, word, nearest);
    if (what == "command")
        return fmt::format("there is no command '{}'; the commands are: {}", word, fmt::join(known, ", "));
    return fmt::format("there is no option '{}'; {}", word, helpHint(program));
}

// Returns an option that is given more often than allowed; null if there is none.
const CLI::Option* repeatedOption(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        if (option->get_items_expected_max() == 1 && option->count() > 1) return option;
    return nullptr;
}

std::string parseFault(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& command = chosenCommand(program);
    const bool unfinished = command.get_subcommands().empty() && !namesOf(command).empty();  // a sub-command is missing
    const bool strange = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || unfinished;
    const std::vector<std::string> words = program.remaining(true);
    // Report an unknown option, not the word that the parser rejects: that word may be the value of the unknown option.
    if (!words.empty() && (strange || std::ranges::any_of(words, isOption))) return unexpected(program, words);
    if (const CLI::Option* option = repeatedOption(command))
        return fmt::format("{} is given {} times; give it once", option->get_name(), option->count());
    if (unfinished && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
        return fmt::format("a command is missing; the commands are: {}; {}", fmt::join(namesOf(command), ", "),
                           helpHint(program));
    const std::string what = error.what();
    constexpr std::string_view ofSwitch = " was given a disallowed flag override";
    if (what.ends_with(ofSwitch))
        return fmt::format("--{} takes no value; {}", what.substr(0, what.size() - ofSwitch.size()), helpHint(program));
    return fmt::format("{}; {}", what, helpHint(program));
}

// Refuses empty names of files and folders, which may come from an unset variable of a script.
void refuseEmptyNames(CLI::App& command) {
    const CLI::Validator notEmpty(
        [](const std::string& text) {
            return text.empty() ? std::string("the name is empty; give a file or folder, or leave the option out")
                                : std::string();
        },
        "");
    for (CLI::Option* option : command.get_options([](const CLI::Option*) { return true; })) {
        const std::string type = option->get_type_name();
        const bool named = type.find("FILE") != std::string::npos || type.find("FOLDER") != std::string::npos;
        if (named || option->get_name() == "SHOT") option->check(notEmpty);
    }
    for (CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) refuseEmptyNames(*below);
}

// Returns an error message with the reason if standard output couldn't be written; empty if all output was written.
std::string outputFault() {
    std::cout.flush();  // writes the text of --help or --version
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return {};
    if (errno == 0) {  // an earlier write failed, and errno no longer tells why; write again to set it
        std::clearerr(stdout);
        std::fputc('\n', stdout);
        std::fflush(stdout);
    }
    return fmt::format("cannot write to standard output{}",
                       errno != 0 ? fmt::format(": {}", std::strerror(errno)) : "");
}

int run(int argc, char** argv) {
    checkSourceDate();
    CLI::App program("Renders glTF scenes with the depth of field of a real lens", "defocus");
    GlobalOptions global;
    global.words.assign(argv, argv + argc);
    addCommands(program, global);
    try {
        std::vector<std::string> words = withoutBooleanValues({argv + 1, argv + argc});
        std::ranges::reverse(words);  // CLI11 expects the last word first
        program.parse(std::move(words));
    } catch (const CLI::Success& shown) {  // thrown for --help and --version
        return program.exit(shown);
    } catch (const CLI::ParseError& error) {
        return printFault(wrongCommandLine, parseFault(program, error));
    } catch (const UsageError& error) {
        return printFault(wrongCommandLine, fmt::format("{}; {}", error.what(), helpHint(program)));
    }
    return 0;
}

}  // namespace

void addCommands(CLI::App& program, GlobalOptions& global) {
    program.fallthrough();
    program.require_subcommand(1);
    program.formatter(std::make_shared<HelpFormat>());
    program.set_help_flag("-h,--help", "Print the most common options");
    program.set_help_all_flag("--help-all", "Print all options of a command, or of all commands");
    addGlobalOptions(program, global);
    addRenderCommand(program, global);
    addCaptureCommand(program, global);
    addNewShotCommand(program, global);
    addExportCameraCommand(program, global);
    addMergeCommand(program, global);
    addRefocusCommand(program, global);
    addViewCommand(program, global);
    addPlanCommand(program, global);
    addInfoCommand(program, global);
    addPyramidCommand(program, global);
    addCompareCommand(program, global);
    addBenchCommand(program, global);
    addCacheCommand(program);
    addSettingsCommand(program);
    addCompletionsCommand(program);
    addManCommand(program);
    refuseEmptyNames(program);
    program.parse_complete_callback([&program, &global] { refuseUnusedShaders(program, global); });
    program.footer(
        "'defocus COMMAND --help' shows the most common options of a command, '--help-all' all of them.\n\n"
        "Example:\n"
        "  defocus render scene.glb -o out.exr -o out.png --fstop 1.4 --focus-distance 2.5");
}

std::vector<const CLI::App*> allCommands(const CLI::App& command) {
    std::vector<const CLI::App*> all = {&command};
    for (const CLI::App* below : command.get_subcommands(nullptr))
        std::ranges::copy(allCommands(*below), std::back_inserter(all));
    return all;
}

std::string pathOf(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return parent == nullptr ? "" : pathOf(*parent) + ' ' + command.get_name();
}

int runProgram(int argc, char** argv) {
    // If a file reaches the size limit, let the write fail instead of killing the process, so that the writer reports
    // the error and cleans up.
    std::signal(SIGXFSZ, SIG_IGN);
    claimClosedOutputs();
    try {
        const int code = run(argc, argv);
        const std::string fault = outputFault();
        return fault.empty() || code != 0 ? code : printFault(failed, fault);
    } catch (const std::bad_alloc&) {
        return printFault(failed, "out of memory; try a smaller --size or --wave, or a scene with fewer triangles");
    } catch (const std::exception& error) {
        // If fmt::print cannot write, it throws an exception whose message doesn't mention standard output. Print a
        // message that does.
        return printFault(failed, std::ferror(stdout) != 0 ? outputFault() : error.what());
    }
}

}  // namespace defocus::engine
