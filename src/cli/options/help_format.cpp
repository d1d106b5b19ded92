#include "cli/options/help_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "cli/options/option_text.h"

namespace defocus::engine {

namespace {

constexpr std::size_t lineWidth = 100;

// Returns the number of columns of a UTF-8 string: the number of its bytes that are not continuation bytes.
std::size_t columnsOf(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) != 0x80u; }));
}

// Returns `left` followed by `text`, which is wrapped and indented to `column`. `text` starts on a new line if `left`
// is too wide.
std::string inColumns(const std::string& left, const std::string& text, std::size_t column) {
    std::string lines = "  " + left;
    std::size_t at = columnsOf(lines);
    const auto startColumn = [&] {
        lines.append(column - at, ' ');
        at = column;
    };
    const auto breakLine = [&] {
        lines += '\n';
        at = 0;
        startColumn();
    };
    if (at + 2 > column)
        breakLine();
    else
        startColumn();
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (at > column && at + 1 + columnsOf(word) > lineWidth)
            breakLine();
        else if (at > column)
            word.insert(word.begin(), ' ');
        lines += word;
        at += columnsOf(word);
    }
    return lines + '\n';
}

// Returns the options of a group, without positional arguments: all of them, or only the options that --help shows.
std::vector<const CLI::Option*> optionsOf(const CLI::App& app, const std::string& group, bool all) {
    return app.get_options([&](const CLI::Option* option) {
        return option->nonpositional() && option->get_group() == group && (all || isEveryday(*option));
    });
}

}  // namespace

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    std::string text = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
    std::size_t left = app->get_options([](const CLI::Option* option) { return option->nonpositional(); }).size();
    for (const std::string& group : app->get_groups()) {
        const std::vector<const CLI::Option*> options = optionsOf(*app, group, mode == CLI::AppFormatMode::All);
        if (!options.empty()) text += make_group(group, false, options);
        left -= options.size();
    }
    if (left > 0)
        text += fmt::format("\n{} shown by --help-all.\n",
                            left == 1 ? "One more option is" : fmt::format("{} more options are", left));
    return text + make_subcommands(app, mode) + '\n' + make_footer(app);
}

std::string HelpFormat::make_option(const CLI::Option* option, bool isPositional) const {
    return inColumns(make_option_name(option, isPositional) + make_option_opts(option), make_option_desc(option),
                     get_column_width());
}

// Returns an option's name; a flag with a negation is shown as "--dof,--no-dof".
std::string HelpFormat::make_option_name(const CLI::Option* option, bool isPositional) const {
    std::string name = CLI::Formatter::make_option_name(option, isPositional);
    const std::string mark = "{false}";
    if (const std::size_t at = name.find(mark); at != std::string::npos) name.erase(at, mark.size());
    return name;
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
    const bool takesValue = option->get_type_size() != 0 && !option->get_positional();
    const std::string type = option->get_type_name();
    return takesValue && !type.empty() ? " " + type : "";
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
    const std::string value = option->get_default_str();
    const std::string& text = option->get_description();
    return value.empty() ? text : text + " (default " + value + ")";
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
    return inColumns(command->get_name(), command->get_description(), get_column_width());
}

}  // namespace defocus::engine
