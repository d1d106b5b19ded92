// defocus man: prints the manual page, defocus(1), in groff's man macros.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options/help_format.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "frame/program_facts.h"

namespace defocus::engine {

namespace {

// Escapes the ASCII characters that groff would replace with typographic ones.
std::string plain(const std::string& text) {
    static const std::map<char, std::string> escapes = {{'\\', "\\e"},  {'-', "\\-"},   {'\'', "\\(aq"},
                                                        {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
    std::string result;
    for (const char letter : text) result += escapes.contains(letter) ? escapes.at(letter) : std::string(1, letter);
    return result;
}

// Returns a line of text, escaped so that it doesn't begin like a groff request.
std::string line(const std::string& text) {
    return (text.starts_with('.') ? "\\&" : "") + plain(text) + "\n";
}

std::string section(const std::string& title) {
    return fmt::format(".SH \"{}\"\n", title);
}

std::string subsection(const std::string& title) {
    return fmt::format(".SS \"{}\"\n", plain(title));
}

// Returns whether an option sets a setting. Settings are documented once for all commands.
bool isSetting(const CLI::Option* option) {
    return settingOf(*option) != nullptr || methodSettingOf(*option) != nullptr;
}

std::string optionText(const CLI::Option& option) {
    const HelpFormat help;
    return fmt::format(".TP\n\\fB{}\\fR\\fI{}\\fR\n{}", plain(fmt::format("{}", fmt::join(namesOf(option), ", "))),
                       plain(help.make_option_opts(&option)), line(help.make_option_desc(&option) + "."));
}

// Converts a command's footer to man macros. Indented lines become code blocks; each other line becomes a paragraph.
std::string footerText(const std::string& footer) {
    std::string text;
    std::istringstream lines(footer);
    bool code = false;
    for (std::string each; std::getline(lines, each);) {
        const bool indented = each.starts_with("  ");
        if (indented != code) text += indented ? ".PP\n.nf\n" : ".fi\n";
        code = indented;
        if (!each.empty()) text += (indented ? "" : ".PP\n") + line(each);
    }
    return text + (code ? ".fi\n" : "");
}

std::string commandText(const CLI::App& command) {
    const std::string name = "defocus" + pathOf(command);
    std::string usage;
    std::string options;
    std::vector<std::string> groups;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) usage += fmt::format(" [\\fI{}\\fR]", plain(option->get_name()));
        if (!isSetting(option) && !option->get_name().starts_with("--help")) options += optionText(*option);
        if (isSetting(option) && std::ranges::find(groups, option->get_group()) == groups.end())
            groups.push_back(option->get_group());
    }
    if (!groups.empty())
        options +=
            ".PP\n" + line(fmt::format("Also accepts the settings in these groups: {}.", fmt::join(groups, "; ")));
    return subsection(name) + line(command.get_description() + ".") +
           fmt::format(".PP\n.B {}\n[\\fIoptions\\fR]{}\n", name, usage) + options + footerText(command.get_footer());
}

// Returns the text about all settings, sorted by group. A setting that several commands share appears once, with the
// first command's description.
std::string settingsText(const CLI::App& program) {
    std::vector<std::string> groups;
    std::map<std::string, std::string> texts;
    std::set<std::string> told;
    for (const CLI::App* command : allCommands(program))
        for (const CLI::Option* option : command->get_options(isSetting)) {
            if (!told.insert(option->get_name()).second) continue;
            std::string& text = texts[option->get_group()];
            if (text.empty()) groups.push_back(option->get_group());
            text += optionText(*option);
        }
    std::string all;
    for (const std::string& group : groups) all += subsection(group) + texts[group];
    return all;
}

std::string manPage(const CLI::App& program) {
    // The comment in the first line sets the encoding for groff and man.
    std::string text = fmt::format(".\\\" -*- coding: utf-8 -*-\n.TH DEFOCUS 1 \"\" \"defocus {}\" \"User Commands\"\n",
                                   programVersion());
    text += section("NAME") + "defocus \\- render glTF scenes with the depth of field of a real lens\n";
    text += section("SYNOPSIS") + ".B defocus\n\\fIcommand\\fR [\\fIoptions\\fR]\n";
    text += section("DESCRIPTION") + line(program.get_description() + ".") + footerText(program.get_footer());
    text += section("OPTIONS OF ALL COMMANDS");
    for (const CLI::Option* option : program.get_options()) text += optionText(*option);
    text += section("COMMANDS");
    for (const CLI::App* command : allCommands(program))
        if (command != &program) text += commandText(*command);
    text += section("SETTINGS") + "Settings have the same meaning in all commands.\n";
    text += settingsText(program);
    text += section("EXIT STATUS") +
            ".TP\n"
            "0\n"
            "Success.\n"
            ".TP\n"
            "1\n"
            "Failure; the reason is printed to standard error.\n"
            ".TP\n"
            "2\n"
            "Invalid command line.\n";
    text += section("FILES") + ".TP\n\\fI\\(ti/.cache/defocus\\fR\n" +
            "Cache of simplified meshes; $XDG_CACHE_HOME/defocus if that variable is set.\n";
    return text;
}

}  // namespace

void addManCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("man", "Print the manual page, for 'man -l -'");
    command->footer("Example:\n  defocus man | man -l -");
    command->callback([&program] {
        fmt::print("{}", manPage(program));
        std::fflush(stdout);
    });
}

}  // namespace defocus::engine
