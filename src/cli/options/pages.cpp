// defocus completions and defocus man: print the files that are installed beside the program.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/command.h"
#include "cli/options/completions.h"
#include "cli/options/man_page.h"
#include "cli/options/option_text.h"
#include "cli/options/program_outline.h"

namespace defocus::engine {

namespace {

using Completions = std::string (*)(const CommandOutline&);

void print(const std::string& page) {
    fmt::print("{}", page);
    std::fflush(stdout);
}

}  // namespace

void addCompletionsCommand(CLI::App& program) {
    auto chosen = std::make_shared<Completions>();
    CLI::App* command = program.add_subcommand("completions", "Print what a shell needs to complete command lines");
    addChoice<Completions>(*command, "SHELL", *chosen,
                           {{"bash", bashCompletions}, {"zsh", zshCompletions}, {"fish", fishCompletions}},
                           "bash, zsh or fish")
        ->required();
    command->footer(
        "Example:\n"
        "  source <(defocus completions bash)\n"
        "An installed program brings them along, where the shells look for them.");
    command->callback([&program, chosen] { print((*chosen)(outlineOf(program))); });
}

void addManCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("man", "Print the manual page, for 'man -l -' to show");
    command->footer("Example:\n  defocus man | man -l -");
    command->callback([&program] { print(manPage(outlineOf(program))); });
}

}  // namespace defocus::engine
