#include "cli/options/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace defocus::engine {

namespace {

// ---- for all shells
// --------------------------------------------------------------------------------------------------

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

// Returns the text in single quotes of bash and zsh, which have no escapes inside.
std::string inQuotes(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

// Returns the first sentence, up to a colon or semicolon, cut to fit on one line.
std::string brief(const std::string& description) {
    constexpr std::size_t longest = 72;
    std::string text = description.substr(0, description.find_first_of(";:"));
    text = text.substr(0, text.find(". "));
    if (text.size() <= longest) return text;
    std::size_t end = text.rfind(' ', longest - 2);
    while (end > 0 && text[end - 1] == ',') --end;
    return text.substr(0, end) + "…";
}

bool takesValue(const OptionOutline& option) {
    return !option.value.empty();
}

// Returns the program's own options that every command takes too, without --help, --help-all and --version.
std::vector<OptionOutline> globalOptions(const CommandOutline& program) {
    std::vector<OptionOutline> options = program.options;
    std::erase_if(options, [](const OptionOutline& option) {
        const std::string& name = option.names.back();
        return name == "--help" || name == "--help-all" || name == "--version";
    });
    return options;
}

std::vector<OptionOutline> optionsWithin(const CommandOutline& program, const CommandOutline& command) {
    std::vector<OptionOutline> options = command.options;
    if (command.names.empty()) return options;
    const std::vector<OptionOutline> global = globalOptions(program);
    options.insert(options.end(), global.begin(), global.end());
    return options;
}

std::vector<std::string> namesBelow(const CommandOutline& command) {
    std::vector<std::string> names;
    for (const CommandOutline& below : command.commands) names.push_back(below.names.back());
    return names;
}

std::vector<std::string> positionalWords(const CommandOutline& command) {
    for (const OptionOutline& option : command.options)
        if (option.positional && !option.words.empty()) return option.words;
    return {};
}

// ---- zsh ------------------------------------------------------------------------------------------------------------

// Escapes a text for a specification of zsh's _arguments.
std::string zshText(const std::string& text) {
    std::string escaped = replaced(text, "\\", "\\\\");
    for (const char* mark : {"[", "]", ":"}) escaped = replaced(escaped, mark, std::string("\\") + mark);
    return escaped;
}

// Returns the part of a specification that completes a value: ":FORM:(words)" or ":FORM:_files".
std::string zshAction(const OptionOutline& option) {
    const std::string form = zshText(option.value.empty() ? option.names.front() : option.value);
    if (!option.words.empty() && option.file)
        return fmt::format(":{}:_alternative 'words\\:word\\:({})' 'files\\:file\\:_files'", form,
                           fmt::join(option.words, " "));
    if (!option.words.empty() && option.list)
        return fmt::format(":{}:_values -s , word {}", form, fmt::join(option.words, " "));
    if (!option.words.empty()) return fmt::format(":{}:({})", form, fmt::join(option.words, " "));
    return fmt::format(":{}:{}", form, option.file ? "_files" : " ");
}

// Adds a specification for each name of an option. The leading * lets an option be given several times.
void addZshOption(std::string& text, const OptionOutline& option) {
    for (const std::string& name : option.names) {
        std::string specification = "*" + name;
        if (takesValue(option) && name.starts_with("--")) specification += "=";
        specification += fmt::format("[{}]", zshText(brief(option.description)));
        if (takesValue(option)) specification += zshAction(option);
        text += fmt::format(" \\\n                {}", inQuotes(specification));
    }
}

void addZshCommand(std::string& text, const CommandOutline& program, const CommandOutline& command) {
    text += fmt::format("        {})\n            _arguments", inQuotes(joinedNames(command)));
    bool positional = false;
    for (const OptionOutline& option : optionsWithin(program, command)) {
        if (!option.positional) addZshOption(text, option);
        if (!option.positional || std::exchange(positional, true)) continue;
        text += fmt::format(" \\\n                {}", inQuotes("*" + zshAction(option)));
    }
    if (!command.commands.empty())
        text += fmt::format(" \\\n                {}",
                            inQuotes(fmt::format("*:command:({})", fmt::join(namesBelow(command), " "))));
    text += "\n            ;;\n";
}

// ---- fish -----------------------------------------------------------------------------------------------------------

std::string fishQuotes(const std::string& text) {
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

// Returns the condition that the line has this command but none of its sub-commands.
std::string fishCondition(const CommandOutline& command) {
    if (command.names.empty()) return "__fish_use_subcommand";
    std::string condition;
    for (const std::string& name : command.names)
        condition += (condition.empty() ? "" : "; and ") + fmt::format("__fish_seen_subcommand_from {}", name);
    if (!command.commands.empty())
        condition += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(namesBelow(command), " "));
    return condition;
}

void addFishOption(std::string& text, const std::string& condition, const OptionOutline& option) {
    text += "complete -c defocus";
    if (!condition.empty()) text += fmt::format(" -n {}", fishQuotes(condition));
    if (option.positional) {
        text += option.words.empty()
                    ? " -F"
                    : fmt::format(" -f -a {}", fishQuotes(fmt::format("{}", fmt::join(option.words, " "))));
        text += '\n';
        return;
    }
    for (const std::string& name : option.names)
        text += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2)) : fmt::format(" -s {}", name.substr(1));
    if (takesValue(option)) {
        text += option.file ? " -r -F" : " -x";
        if (!option.words.empty())
            text += fmt::format(" -a {}", fishQuotes(fmt::format("{}", fmt::join(option.words, " "))));
    }
    text += fmt::format(" -d {}\n", fishQuotes(brief(option.description)));
}

}  // namespace

// ---- bash -----------------------------------------------------------------------------------------------------------

std::string bashCompletions(const CommandOutline& program) {
    std::string commands;  // cases that match a command in the line, such as "bench speedup"
    std::string options;
    std::string values;
    for (const CommandOutline* command : allCommands(program)) {
        const std::string path = joinedNames(*command);
        if (!path.empty()) commands += fmt::format("            {}) command={} ;;\n", inQuotes(path), inQuotes(path));
        std::vector<std::string> names;
        for (const OptionOutline& option : optionsWithin(program, *command)) {
            if (option.positional) continue;
            names.insert(names.end(), option.names.begin(), option.names.end());
            if (!takesValue(option)) continue;
            std::vector<std::string> patterns;
            for (const std::string& name : option.names) patterns.push_back(inQuotes(path + " " + name));
            values += fmt::format("        {}) values={}{}{} ;;\n", fmt::join(patterns, "|"),
                                  inQuotes(fmt::format("{}", fmt::join(option.words, " "))),
                                  option.file ? " files=1" : "", option.list ? " list=1" : "");
        }
        std::vector<std::string> words = namesBelow(*command);
        if (words.empty()) words = positionalWords(*command);
        const bool files = words.empty();
        options += fmt::format("        {}) options={}\n            words={}{} ;;\n", inQuotes(path),
                               inQuotes(fmt::format("{}", fmt::join(names, " "))),
                               inQuotes(fmt::format("{}", fmt::join(words, " "))), files ? " files=1" : "");
    }
    return R"(# bash completion for defocus; 'defocus completions bash' writes it.

_defocus_files() {
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    COMPREPLY+=($(compgen -f -- "$1"))
}

_defocus() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
    local command='' options='' words='' values='' files='' list='' word index
    COMPREPLY=()

    # bash parts words at = too: --option=value are three of them.
    if [[ $current == = ]]; then
        current=''
    elif [[ $before == = && $COMP_CWORD -gt 2 ]]; then
        before=${COMP_WORDS[COMP_CWORD-2]}
    fi

    for ((index = 1; index < COMP_CWORD; ++index)); do
        word=${COMP_WORDS[index]}
        case "${command:+$command }$word" in
)" + commands +
           R"(        esac
    done

    # The value of an option.
    case "$command $before" in
)" + values +
           R"(        *) values=none ;;
    esac
    if [[ $values != none ]]; then
        local given=''
        [[ -n $list && $current == *,* ]] && given=${current%,*},
        COMPREPLY=($(compgen -P "$given" -W "$values" -- "${current#"$given"}"))
        [[ -n $files ]] && _defocus_files "$current"
        return
    fi

    # An option, a command or a file.
    case "$command" in
)" + options +
           R"(    esac
    if [[ $current == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$current"))
    else
        COMPREPLY=($(compgen -W "$words" -- "$current"))
        [[ -n $files ]] && _defocus_files "$current"
    fi
}

complete -F _defocus defocus
)";
}

std::string zshCompletions(const CommandOutline& program) {
    std::string commands;
    std::string arguments;
    for (const CommandOutline* command : allCommands(program)) {
        const std::string path = joinedNames(*command);
        if (!path.empty())
            commands += fmt::format("            {}) command={}; first=$index ;;\n", inQuotes(path), inQuotes(path));
        addZshCommand(arguments, program, *command);
    }
    return R"(#compdef defocus
# zsh completion for defocus; 'defocus completions zsh' writes it.

_defocus() {
    local command='' word
    integer index first=1
    for ((index = 2; index < CURRENT; ++index)); do
        word=$words[index]
        case "${command:+$command }$word" in
)" + commands +
           R"(        esac
    done

    # What follows the command is completed as if the command were the program.
    words=("${(@)words[first,-1]}")
    ((CURRENT -= first - 1))
    case $command in
)" + arguments +
           R"(    esac
}

if [[ $funcstack[1] == _defocus ]]; then
    _defocus "$@"
else
    compdef _defocus defocus
fi
)";
}

std::string fishCompletions(const CommandOutline& program) {
    std::string text =
        "# fish completion for defocus; 'defocus completions fish' writes it.\n\n"
        "complete -c defocus -f -n __fish_use_subcommand\n";
    for (const OptionOutline& option : globalOptions(program)) addFishOption(text, "", option);
    for (const CommandOutline* command : allCommands(program)) {
        const std::string condition = fishCondition(*command);
        text += '\n';
        for (const CommandOutline& below : command->commands)
            text += fmt::format("complete -c defocus -n {} -f -a {} -d {}\n", fishQuotes(condition), below.names.back(),
                                fishQuotes(brief(below.description)));
        for (const OptionOutline& option : command->options) {
            const std::string& name = option.names.back();
            const bool global =
                command->names.empty() && name != "--help" && name != "--help-all" && name != "--version";
            if (!global) addFishOption(text, condition, option);
        }
    }
    return text;
}

}  // namespace defocus::engine
