#include "cli/options/request_options.h"

#include <algorithm>
#include <map>
#include <set>

#include "cli/options/option_text.h"
#include "core/error.h"

namespace defocus::engine {

namespace {

// Returns the option with the opposite effect of a boolean option: "--no-dof" for "--dof", "--cache" for "--no-cache".
std::string negationOf(const std::string& option) {
    constexpr std::string_view no = "--no-";
    return option.starts_with(no) ? "--" + option.substr(no.size()) : std::string(no) + option.substr(2);
}

CLI::Option* addBoolean(CLI::App& command, Request& request, const Setting& setting) {
    return command
        .add_flag_function(
            setting.option + ",!" + negationOf(setting.option),
            [&request, &setting](std::int64_t count) { setting.set(request, count > 0 ? "true" : "false"); },
            setting.help)
        ->disable_flag_override();
}

CLI::Option* addRepeated(CLI::App& command, Request& request, const Setting& setting) {
    return command
        .add_option_function<std::vector<std::string>>(
            setting.option,
            [&request, &setting](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) try {
                        setting.set(request, text);
                    } catch (const Error& error) {
                        throw CLI::ValidationError(setting.option, error.what());
                    }
            },
            setting.help)
        ->allow_extra_args(false)
        ->type_name(setting.metavar);
}

CLI::Option* addRow(CLI::App& command, Request& request, const Setting& setting) {
    if (setting.kind == SettingKind::boolean) return addBoolean(command, request, setting);
    if (setting.repeated) return addRepeated(command, request, setting);
    CLI::Option* option = addParsed(command, setting.option, setting.metavar, setting.help,
                                    [&request, &setting](const std::string& text) { setting.set(request, text); });
    if (const std::optional<std::string> value = setting.text(request)) option->default_str(*value);
    return option;
}

// Returns the default that --help shows for a method setting: one value, or a value for each method if the methods
// differ.
std::string defaultOf(const std::string& name) {
    std::set<std::string> values;
    std::vector<std::string> texts;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) {
            if (setting.name != name) continue;
            values.insert(setting.defaultValue);
            texts.push_back(fmt::format("{} for {}", setting.defaultValue, method.name));
        }
    return values.size() == 1 ? *values.begin() : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::vector<std::string> withoutBooleanValues(const std::vector<std::string>& words) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        const std::string option = words[i].substr(0, equals);
        const auto setting = std::ranges::find(settings(), option, &Setting::option);
        const bool boolean = setting != settings().end() && setting->kind == SettingKind::boolean;
        const bool separate = equals == std::string::npos;
        const std::string next = i + 1 < words.size() ? words[i + 1] : "";
        const std::string value = separate ? next : words[i].substr(equals + 1);
        const bool given = boolean && (value == "true" || value == "false");
        result.push_back(!given ? words[i] : value == "true" ? option : negationOf(option));
        if (given && separate) ++i;
    }
    return result;
}

void addSettings(CLI::App& command, Request& request, const std::vector<std::string>& names) {
    std::map<std::string, CLI::Option*> added;
    for (const Setting& setting : settings())
        if (std::ranges::find(names, setting.name) != names.end())
            added[setting.name] =
                addRow(command, request, setting)->group(groupTitle(setting.group))->configurable(setting.everyday);
    for (const auto& [name, option] : added)
        for (const std::string& other : settingNamed(name)->excludes)
            if (added.contains(other)) option->excludes(added[other]);
}

std::vector<std::string> settingsOf(const std::vector<SettingGroup>& groups, const std::vector<std::string>& without) {
    std::vector<std::string> names;
    for (const Setting& setting : settings())
        if (std::ranges::find(groups, setting.group) != groups.end() &&
            std::ranges::find(without, setting.name) == without.end())
            names.push_back(setting.name);
    return names;
}

void addDeveloperSettings(CLI::App& command, Request& request, const std::vector<std::string>& without) {
    addSettings(command, request, settingsOf({SettingGroup::developer}, without));
}

void addMethodSettings(CLI::App& command, Request& request) {
    std::map<std::string, std::string> owners;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings)
            owners[setting.name] += (owners[setting.name].empty() ? "" : ", ") + method.name;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) {
            const auto owner = owners.extract(setting.name);
            if (owner.empty()) continue;  // an earlier method already added the setting's option
            const Setting row = rowOf(setting);
            command
                .add_option_function<std::string>(
                    row.option, [&request, set = row.set](const std::string& text) { set(request, text); }, row.help)
                ->type_name(row.metavar)
                ->default_str(defaultOf(setting.name))
                ->configurable(false)
                ->group("Method " + owner.mapped());
        }
}

const Setting* settingOf(const CLI::Option& option) {
    for (const Setting& setting : settings())
        if (setting.option == option.get_name() && setting.help == option.get_description()) return &setting;
    return nullptr;
}

const MethodSetting* methodSettingOf(const CLI::Option& option) {
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings)
            if (option.get_name() == "--" + setting.name && option.get_description() == setting.description)
                return &setting;
    return nullptr;
}

}  // namespace defocus::engine
