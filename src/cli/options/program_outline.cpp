#include "cli/options/program_outline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/parse.h"
#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

std::string longName(const CLI::Option& option) {
    return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

// Returns the setting that the option sets; null for an option of the command's own, even one of the same name.
const Setting* settingOf(const CLI::Option& option) {
    for (const Setting& setting : settings())
        if (setting.option == longName(option) && setting.help == option.get_description()) return &setting;
    return nullptr;
}

bool isOfMethod(const CLI::Option& option) {
    return std::ranges::any_of(methods(), [&](const Method& method) {
        return std::ranges::any_of(method.settings, [&](const MethodSetting& setting) {
            return "--" + setting.name == longName(option) && setting.description == option.get_description();
        });
    });
}

// Returns whether the text is a literal word such as "half". "FILE" and "WxH" are placeholders.
bool isWord(const std::string& text) {
    return !text.empty() &&
           std::ranges::none_of(text, [](unsigned char letter) { return std::isupper(letter) != 0; }) &&
           std::ranges::any_of(text, [](unsigned char letter) { return std::isalpha(letter) != 0; });
}

// Reads the literal words in the form of a value: "off" and "half" of "off|half|N", all words of "depth,coc".
void readForm(OptionOutline& option) {
    option.list = option.value.find('|') == std::string::npos && option.value.find(',') != std::string::npos;
    for (const std::string& part : splitAt(option.value, option.list ? ',' : '|')) {
        if (isWord(part)) option.words.push_back(part);
        for (const char* file : {"FILE", "FOLDER", "PATTERN", "PATH", "SCENE", "SHOT", "IMAGE"})
            option.file = option.file || part == file;
    }
    option.list = option.list && option.words.size() > 1;
}

OptionOutline outlineOf(const CLI::Option& option) {
    OptionOutline outline;
    outline.positional = option.get_positional();
    for (const std::string& name : option.get_snames()) outline.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) outline.names.push_back("--" + name);
    if (outline.positional) outline.names = {option.get_name()};
    if (option.get_type_size() != 0) outline.value = option.get_type_name();
    outline.description = option.get_description();
    outline.standard = option.get_default_str();
    outline.group = option.get_group();
    outline.shared = settingOf(option) != nullptr || isOfMethod(option);
    readForm(outline);
    if (outline.positional) outline.file = true;
    if (const Setting* setting = settingOf(option); setting != nullptr && setting->name == "method")
        for (const Method& method : methods()) outline.words.push_back(method.name);
    return outline;
}

CommandOutline outlineOf(const CLI::App& app, const std::vector<std::string>& names) {
    CommandOutline outline;
    outline.names = names;
    outline.description = app.get_description();
    outline.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options()) outline.options.push_back(outlineOf(*option));
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        std::vector<std::string> below = names;
        below.push_back(command->get_name());
        outline.commands.push_back(outlineOf(*command, below));
    }
    return outline;
}

}  // namespace

CommandOutline outlineOf(const CLI::App& program) {
    return outlineOf(program, {});
}

bool isEveryday(const CLI::Option& option) {
    const std::string name = longName(option);
    return option.get_configurable() || name == "--help" || name == "--help-all";  // CLI11 unsets it for help options
}

std::string joinedNames(const CommandOutline& command) {
    return fmt::format("{}", fmt::join(command.names, " "));
}

std::vector<const CommandOutline*> allCommands(const CommandOutline& command) {
    std::vector<const CommandOutline*> all = {&command};
    for (const CommandOutline& below : command.commands) {
        const std::vector<const CommandOutline*> more = allCommands(below);
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

}  // namespace defocus::engine
