#pragma once
// Defines a setting that tests add to the table of settings.

#include <fmt/format.h>

#include <optional>
#include <string>

#include "core/parse.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

// Returns a numeric setting for which Request has no member; its functions store the value in Request::clip.
inline Setting newSetting() {
    Setting setting;
    setting.name = "newSetting";
    setting.option = "--new-setting";
    setting.group = SettingGroup::samples;
    setting.kind = SettingKind::number;
    setting.metavar = "MM";
    setting.unit = "mm";
    setting.max = 10;
    setting.help = "Help of the new setting";
    setting.example = "2.5";
    setting.everyday = true;
    setting.excludes = {"seed"};
    setting.shotPlace = "/newSetting";
    setting.set = [](Request& request, const std::string& text) {
        request.clip = fmt::format("{}", parseNumber(text, {0, 10}));
    };
    setting.text = [](const Request& request) {
        return request.clip.empty() ? std::nullopt : std::optional(request.clip);
    };
    setting.clear = [](Request& request) { request.clip.clear(); };
    setting.unused = [](const SettingContext&) { return std::string("nothing uses it"); };
    return setting;
}

}  // namespace defocus::engine
