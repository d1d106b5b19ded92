#include "frame/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/enum_name.h"
#include "core/error.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

// Converts a name to an option's form: "farComponents" to "far-components".
std::string dashed(std::string_view name) {
    std::string text = snakeCase(name);
    std::ranges::replace(text, '_', '-');
    return text;
}

const MethodSetting* methodSettingNamed(std::string_view name) {
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings)
            if (setting.name == name) return &setting;
    return nullptr;
}

}  // namespace

const Setting* settingNamed(std::string_view name) {
    const auto found = std::ranges::find(settings(), name, &Setting::name);
    return found == settings().end() ? nullptr : &*found;
}

Setting rowOf(const MethodSetting& setting) {
    Setting row;
    row.name = setting.name;
    row.option = "--" + setting.name;
    row.group = SettingGroup::method;
    row.kind = !setting.choices.empty() ? SettingKind::choice
               : setting.integer        ? SettingKind::integer
                                        : SettingKind::number;
    row.metavar = !setting.choices.empty() ? fmt::format("{}", fmt::join(setting.choices, "|"))
                  : setting.integer        ? "N"
                                           : "R";
    row.min = setting.min;
    row.max = setting.max;
    row.choices = setting.choices;
    row.help = setting.description;
    row.keyed = setting.keyed;
    row.set = [name = setting.name](Request& request, const std::string& text) { request.methodSettings[name] = text; };
    row.text = [name = setting.name, value = setting.defaultValue](const Request& request) {
        const auto given = request.methodSettings.find(name);
        return given != request.methodSettings.end() ? given->second : value;
    };
    row.clear = [name = setting.name](Request& request) { request.methodSettings.erase(name); };
    return row;
}

bool dependsOnScene(const Setting& setting) {
    if (setting.group == SettingGroup::camera) return setting.name != "size";
    return setting.group == SettingGroup::lens || setting.name == "time" || setting.name == "clip" ||
           setting.name == "hide";
}

std::string namedError(std::string_view setting, std::string_view error) {
    const bool named = error.starts_with(setting) && error.substr(setting.size()).starts_with(' ');
    return named ? std::string(error) : fmt::format("{}: {}", setting, error);
}

void setByName(Request& request, std::string_view name, const std::string& text) {
    if (const Setting* setting = settingNamed(name)) {
        try {
            return setting->set(request, text);
        } catch (const Error& error) {
            throw UsageError(namedError(name, error.what()));
        }
    }
    if (const std::string dashes = dashed(name); methodSettingNamed(dashes) != nullptr) {
        request.methodSettings[dashes] = text;
        return;
    }
    std::vector<std::string> known;
    for (const Setting& setting : settings()) known.push_back(setting.name);
    const std::string nearest = nearestWord(std::string(name), known);
    throw UsageError(nearest.empty() ? fmt::format("there is no setting '{}'", name)
                                     : fmt::format("there is no setting '{}'; did you mean '{}'?", name, nearest));
}

std::optional<std::string> changedText(const Setting& setting, const Request& request) {
    static const Request defaults;
    std::optional<std::string> text = setting.text(request);
    if (text == setting.text(defaults)) return std::nullopt;
    return text;
}

std::string pixelSettings(const Request& request) {
    std::string text;
    for (const Setting& setting : settings())
        if (setting.effect == SettingEffect::pixels && setting.kind != SettingKind::path)
            text += fmt::format("{}={};", setting.name, setting.text(request).value_or(""));
    return text;
}

std::string snakeCase(std::string_view name) {
    std::string result;
    for (const char letter : name) {
        const auto code = static_cast<unsigned char>(letter);
        if (std::isupper(code) != 0) result += '_';
        result += letter == '-' ? '_' : static_cast<char>(std::tolower(code));
    }
    return result;
}

std::string groupTitle(SettingGroup group) {
    return enumName<SettingGroup::developer>(
        group, {"Scene", "Camera", "Lens", "Samples and level of detail", "Method", "Output", "Developer options"});
}

}  // namespace defocus::engine
