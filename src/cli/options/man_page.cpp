#include "cli/options/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "frame/program_facts.h"

namespace defocus::engine {

namespace {

// Escapes a text so that groff prints it unchanged. Characters beyond ASCII are written by their code point.
std::string plain(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (text[i] == '\\')
            result += "\\e";
        else if (text[i] == '-')
            result += "\\-";
        else if (text[i] == '\'')
            result += "\\(aq";
        else if (text[i] == '^')
            result += "\\(ha";
        else if (text[i] == '~')
            result += "\\(ti";
        else if (byte < 0x80)
            result += text[i];
        else {
            const int more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
            unsigned code = byte & (0x3fu >> more);
            for (int k = 0; k < more; ++k) code = code << 6 | (static_cast<unsigned char>(text[++i]) & 0x3fu);
            result += fmt::format("\\[u{:04X}]", code);
        }
    }
    return result;
}

// Returns a line of text, escaped so that it doesn't begin like a groff request.
std::string line(const std::string& text) {
    const bool request = !text.empty() && (text.front() == '.' || text.front() == '\'');
    return (request ? "\\&" : "") + plain(text) + "\n";
}

std::string section(const std::string& title) {
    return fmt::format(".SH \"{}\"\n", title);
}

std::string subsection(const std::string& title) {
    return fmt::format(".SS \"{}\"\n", plain(title));
}

std::string optionText(const OptionOutline& option) {
    std::string head;
    for (const std::string& name : option.names)
        head += (head.empty() ? "" : ", ") + fmt::format("\\fB{}\\fR", plain(name));
    if (!option.value.empty() && !option.positional) head += fmt::format(" \\fI{}\\fR", plain(option.value));
    std::string text = option.description;
    if (!option.standard.empty()) text += " (default " + option.standard + ")";
    return ".TP\n" + head + "\n" + line(text + ".");
}

std::string synopsis(const CommandOutline& command) {
    std::string text = fmt::format(".B defocus {}\n", joinedNames(command));
    text += "[\\fIoptions\\fR]";
    for (const OptionOutline& option : command.options)
        if (option.positional) text += fmt::format(" [\\fI{}\\fR]", plain(option.names.front()));
    return text + "\n";
}

// Returns a command's footer in man macros. Indented lines are code, other lines are sentences.
std::string footerText(const std::string& footer) {
    std::string text;
    std::istringstream lines(footer);
    bool code = false;
    for (std::string each; std::getline(lines, each);) {
        const bool indented = each.starts_with("  ");
        if (indented != code) text += indented ? ".PP\n.nf\n" : ".fi\n";
        code = indented;
        if (each.empty()) continue;
        text += (indented ? "" : ".PP\n") + line(indented ? each : each);
    }
    return text + (code ? ".fi\n" : "");
}

std::string commandText(const CommandOutline& command) {
    std::string text = subsection("defocus " + joinedNames(command)) + line(command.description + ".") + ".PP\n";
    text += synopsis(command);
    bool takesSettings = false;
    for (const OptionOutline& option : command.options) {
        const std::string& name = option.names.back();
        takesSettings = takesSettings || option.shared;
        if (!option.shared && name != "--help" && name != "--help-all") text += optionText(option);
    }
    if (takesSettings) {
        std::vector<std::string> groups;
        for (const OptionOutline& option : command.options)
            if (option.shared && std::ranges::find(groups, option.group) == groups.end())
                groups.push_back(option.group);
        text += ".PP\n" + line(fmt::format("Takes settings too, of: {}.", fmt::join(groups, ", ")));
    }
    return text + footerText(command.footer);
}

// Returns each shared option once, by group, with the description of the first command that has it.
std::string settingsText(const CommandOutline& program) {
    std::vector<std::string> groups;
    std::map<std::string, std::vector<OptionOutline>> byGroup;
    std::vector<std::string> told;
    for (const CommandOutline* command : allCommands(program))
        for (const OptionOutline& option : command->options) {
            if (!option.shared || std::ranges::find(told, option.names.back()) != told.end()) continue;
            told.push_back(option.names.back());
            if (!byGroup.contains(option.group)) groups.push_back(option.group);
            byGroup[option.group].push_back(option);
        }
    std::string text;
    for (const std::string& group : groups) {
        text += subsection(group);
        for (const OptionOutline& option : byGroup.at(group)) text += optionText(option);
    }
    return text;
}

}  // namespace

std::string manPage(const CommandOutline& program) {
    std::string text =
        "'\\\" t\n" + fmt::format(".TH DEFOCUS 1 \"\" \"defocus {}\" \"User Commands\"\n", programVersion());
    text += section("NAME") + "defocus \\- render glTF scenes with the depth of field of a real lens\n";
    text += section("SYNOPSIS") + ".B defocus\n\\fIcommand\\fR [\\fIoptions\\fR]\n";
    text += section("DESCRIPTION") + line(program.description + ".");
    text += footerText(program.footer);
    text += section("OPTIONS OF ALL COMMANDS");
    for (const OptionOutline& option : program.options) text += optionText(option);
    text += section("COMMANDS");
    for (const CommandOutline* command : allCommands(program))
        if (!command->names.empty()) text += commandText(*command);
    text += section("SETTINGS") + line("The settings of a picture mean the same for each command that takes them.");
    text += settingsText(program);
    text += section("EXIT STATUS") +
            ".TP\n0\nThe work is done.\n.TP\n1\nSomething failed; a line on standard error says what.\n"
            ".TP\n2\nThe command line is wrong.\n";
    text += section("FILES") + ".TP\n\\fI~/.cache/defocus\\fR\n" +
            line("Simplified meshes, which are made once; $XDG_CACHE_HOME/defocus where that variable is set.");
    return text;
}

}  // namespace defocus::engine
