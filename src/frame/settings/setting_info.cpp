#include "defocus/setting_info.h"

#include <algorithm>

#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus {

namespace {

SettingInfo infoOf(const engine::Setting& setting) {
    SettingInfo info;
    info.name = setting.name;
    info.keyword = engine::snakeCase(setting.name);
    info.option = setting.option;
    info.group = engine::groupTitle(setting.group);
    info.kind = setting.kind;
    info.metavar = setting.metavar;
    info.unit = setting.unit;
    info.min = setting.min;
    info.max = setting.max;
    info.choices = setting.choices;
    info.help = setting.help;
    info.defaultValue = setting.text(Request{});
    info.excludes = setting.excludes;
    info.arraySeparator = setting.arraySeparator;
    info.repeated = setting.repeated;
    return info;
}

}  // namespace

std::vector<SettingInfo> settingInfos() {
    std::vector<SettingInfo> infos;
    for (const engine::Setting& setting : engine::settings()) infos.push_back(infoOf(setting));
    for (const engine::Method& method : engine::methods())
        for (const engine::MethodSetting& setting : method.settings) {
            auto known = std::ranges::find(infos, setting.name, &SettingInfo::name);
            if (known == infos.end()) known = infos.insert(infos.end(), infoOf(engine::rowOf(setting)));
            known->methods.push_back(method.name);
        }
    return infos;
}

}  // namespace defocus
