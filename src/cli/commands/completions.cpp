// defocus completions: prints a script that lets a shell complete command lines.
//
// The scripts of all shells contain the same table of candidates and the same awk program that reads the table. The
// scripts don't run defocus, which takes 0.2 s to load its shared libraries; a completion takes 10 ms.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/options/option_text.h"
#include "core/parse.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

// Candidates that the shell replaces with the names of all files or all folders. The letter after the colon is the
// option of bash's command compgen that lists them.
constexpr std::string_view anyFile = ":f";
constexpr std::string_view anyFolder = ":d";

// Returns the description up to its first full stop, colon or semicolon, cut to fit on one line. Apostrophes become
// typographic ones, because the scripts contain the table in single quotes.
std::string brief(const std::string& description) {
    constexpr std::size_t maxBytes = 72;
    std::string text = description.substr(0, description.find_first_of(";:\\"));
    text = text.substr(0, text.find(". "));
    if (text.size() > maxBytes) {
        text.resize(text.rfind(' ', maxBytes - 2));
        text.resize(text.find_last_not_of(',') + 1);
        text += "…";
    }
    for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos;) text.replace(at, 1, "’");
    return text;
}

// Returns whether a value in --help is a literal word such as "half", not a placeholder such as "FILE" or "WxH".
bool isLiteral(const std::string& text) {
    return std::ranges::none_of(text, [](unsigned char letter) { return std::isupper(letter) != 0; }) &&
           std::ranges::any_of(text, [](unsigned char letter) { return std::isalpha(letter) != 0; });
}

// Returns the candidates for an option's value, read from the placeholder in --help: "off" and "half" for "off|half|N".
// For a comma-separated list such as "depth,coc", each candidate begins with a comma. awkProgram replaces this comma
// with the part of the list that is already typed.
std::vector<std::string> candidatesOf(const CLI::Option& option) {
    const std::string form = option.get_type_name();
    const bool list = form.find('|') == std::string::npos && form.find(',') != std::string::npos;
    std::vector<std::string> candidates;
    if (option.check_lname("method"))
        for (const Method& method : methods()) candidates.push_back(method.name);
    for (const std::string& part : splitAt(form, list ? ',' : '|')) {
        if (isLiteral(part)) candidates.push_back((list ? "," : "") + part);
        if (part == "FILE" || part == "PATTERN") candidates.emplace_back(anyFile);
        if (part == "FOLDER") candidates.emplace_back(anyFolder);
    }
    if (option.get_positional() && candidates.empty()) candidates.emplace_back(anyFile);
    return candidates;
}

// Returns lines of "CONTEXT <tab> CANDIDATE <tab> DESCRIPTION". The context is a command (" bench speedup") or an
// option that takes a value (" render --lod"). An option without candidates has one line with an empty candidate.
std::string completionTable(const CLI::App& program) {
    std::string table;
    std::set<std::string> rows;  // omits duplicates: a command and the program may share an option
    const auto add = [&](const std::string& context, const std::string& candidate, const std::string& description) {
        const std::string row = fmt::format("{}\t{}\t{}\n", context, candidate, brief(description));
        if (rows.insert(row).second) table += row;
    };
    for (const CLI::App* command : allCommands(program)) {
        const std::string path = pathOf(*command);
        for (const CLI::App* below : command->get_subcommands(nullptr))
            add(path, below->get_name(), below->get_description());
        for (const CLI::App* owner : {command, &program})
            for (const CLI::Option* option : owner->get_options()) {
                const std::vector<std::string> candidates = candidatesOf(*option);
                if (option->get_positional())
                    for (const std::string& candidate : candidates) add(path, candidate, "");
                else
                    for (const std::string& name : namesOf(*option)) {
                        add(path, name, option->get_description());
                        if (option->get_type_name().empty()) continue;  // a flag takes no value
                        if (candidates.empty()) add(path + ' ' + name, "", "");
                        for (const std::string& candidate : candidates) add(path + ' ' + name, candidate, "");
                    }
            }
    }
    return table;
}

// Awk program that reads the table from standard input and prints the candidates for the last argument, each with a tab
// and its description. The awk program's arguments are the words of the command line after "defocus". The scripts
// contain this text in single quotes, so it must contain neither a single quote nor a double backslash.
constexpr std::string_view awkProgram = R"(
    BEGIN { FS = "\t"; words = ARGC - 1; ARGC = 1 }
    { rows[$1] = rows[$1] "\n" $2 "\t" $3 }
    END {
        for (i = 1; i < words; ++i) {
            if (ARGV[i] == "=") continue  # bash splits --option=value at =
            key = command " " ARGV[i]
            if (option != "") option = ""
            else if (key in rows) { if (ARGV[i] ~ /^-/) option = key; else command = key }
        }
        current = ARGV[words] == "=" ? "" : ARGV[words]
        equals = match(current, /^--[^=]*=/) ? RLENGTH : 0
        if (equals) option = command " " substr(current, 1, equals - 1)
        current = substr(current, equals + 1)
        given = match(current, /^.*,/) ? substr(current, 1, RLENGTH) : ""
        count = split(rows[option == "" ? command : option], candidates, "\n")
        for (i = 1; i <= count; ++i) {
            candidate = candidates[i]
            if (sub(/^,/, given, candidate) || (candidate ~ /^[^\t]/ && (candidate ~ /^-/) == (current ~ /^-/)))
                print candidate
        }
    })";

constexpr std::string_view bashScript = R"(# bash completion for defocus; 'defocus completions bash' writes it.

_defocus_candidates() {{
    printf '%s' '{table}' | awk '{awk}' "$@"
}}

_defocus() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} candidate description
    [[ $current == = ]] && current=''
    COMPREPLY=()
    while IFS=$'\t' read -r candidate description; do
        case $candidate in
            :*)
                compopt -o filenames 2>/dev/null
                mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen "-${{candidate#:}}" -- "$current")
                ;;
            "$current"*) COMPREPLY+=("$candidate") ;;
        esac
    done < <(_defocus_candidates "${{COMP_WORDS[@]:1:COMP_CWORD}}")
}}

complete -F _defocus defocus
)";

constexpr std::string_view zshScript = R"(#compdef defocus
# zsh completion for defocus; 'defocus completions zsh' writes it.

_defocus_candidates() {{
    printf '%s' '{table}' | awk '{awk}' "$@"
}}

_defocus() {{
    local line
    local -a candidates files
    for line in "${{(@f)$(_defocus_candidates "${{(@)words[2,CURRENT-1]}}" "$PREFIX")}}"; do
        case $line in
            :f*) files=(_files) ;;
            :d*) files=(_files -/) ;;
            ?*) candidates+=("${{line/$'\t'/:}}") ;;
        esac
    done
    compset -P '--*='
    _describe -t values value candidates
    $files
}}

if [[ $funcstack[1] == _defocus ]]; then
    _defocus "$@"
else
    compdef _defocus defocus
fi
)";

constexpr std::string_view fishScript = R"(# fish completion for defocus; 'defocus completions fish' writes it.

function _defocus_candidates
    printf '%s' '{table}' | awk '{awk}' $argv
end

function _defocus
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l option (string match -r -- '^--[^=]*=' "$current")
    set -l value (string replace -r -- '^--[^=]*=' '' "$current")
    for line in (_defocus_candidates $words[2..-1] "$current")
        switch $line
            case ':f*'
                complete -C "'' $value"
            case ':d*'
                complete -C "'' $value" | string match -- '*/'
            case '*'  # fish would search the description, too
                string match -i -- "*$value*"\t'*' $line
        end
    end | string replace -r -- '^' "$option"
end

complete -c defocus -f -a '(_defocus)'
)";

}  // namespace

void addCompletionsCommand(CLI::App& program) {
    auto script = std::make_shared<std::string_view>();
    CLI::App* command = program.add_subcommand("completions", "Print the shell script that completes command lines");
    addChoice<std::string_view>(*command, "SHELL", *script,
                                {{"bash", bashScript}, {"zsh", zshScript}, {"fish", fishScript}},
                                "Shell: bash, zsh or fish")
        ->required();
    command->footer(
        "Example:\n"
        "  source <(defocus completions bash)\n"
        "If defocus is installed, the shells find the completion scripts without this command.");
    command->callback([&program, script] {
        fmt::print(fmt::runtime(*script), fmt::arg("table", completionTable(program)), fmt::arg("awk", awkProgram));
        std::fflush(stdout);
    });
}

}  // namespace defocus::engine
