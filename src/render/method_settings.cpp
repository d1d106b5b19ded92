#include "render/method_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/error.h"

namespace defocus {

namespace {

std::string accepted(const MethodSetting& setting) {
    if (!setting.choices.empty()) return fmt::format("one of {}", fmt::join(setting.choices, ", "));
    return fmt::format("a {}number from {:g} to {:g}", setting.whole ? "whole " : "", setting.least, setting.most);
}

bool takes(const MethodSetting& setting, const std::string& value) {
    if (!setting.choices.empty())
        return std::find(setting.choices.begin(), setting.choices.end(), value) != setting.choices.end();
    double number = 0;
    const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool parsed = fault == std::errc() && end == value.data() + value.size() && std::isfinite(number);
    return parsed && number >= setting.least && number <= setting.most &&
           (!setting.whole || number == std::floor(number));
}

const MethodSetting& settingNamed(std::string_view method, const std::vector<MethodSetting>& known,
                                  const std::string& name) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& s) { return s.name == name; });
    if (found != known.end()) return *found;
    if (known.empty()) fail("method {} has no settings, so '{}' cannot be set", method, name);
    std::string names;
    for (const MethodSetting& setting : known) names += (names.empty() ? "" : ", ") + setting.name;
    fail("method {} has no setting '{}'; it has: {}", method, name, names);
}

}  // namespace

MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given) {
    for (const auto& [name, value] : given) {
        const MethodSetting& setting = settingNamed(method, known, name);
        if (!takes(setting, value)) fail("method {}: {} is {}, not '{}'", method, name, accepted(setting), value);
    }
    MethodSettings complete = given;
    for (const MethodSetting& setting : known) complete.try_emplace(setting.name, setting.standard);
    return complete;
}

double numberOf(const MethodSettings& settings, const std::string& name) {
    const std::string& value = settings.at(name);
    double number = 0;
    std::from_chars(value.data(), value.data() + value.size(), number);
    return number;
}

std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings) {
    std::string text;
    for (const MethodSetting& setting : known) {
        const auto found = settings.find(setting.name);
        if (found == settings.end() || found->second == setting.standard) continue;
        text += (text.empty() ? "" : ",") + setting.name + "=" + found->second;
    }
    return text;
}

}  // namespace defocus
