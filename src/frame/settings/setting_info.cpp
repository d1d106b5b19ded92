#include "defocus/setting_info.h"

#include <algorithm>

#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus {

namespace {

SettingInfo infoOf(const Setting& setting) {
    SettingInfo info;
    info.name = setting.name;
    info.keyword = snakeCase(setting.name);
    info.option = setting.option;
    info.group = groupTitle(setting.group);
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

SettingInfo infoOf(const MethodSetting& setting) {
    SettingInfo info;
    info.name = setting.name;
    info.keyword = snakeCase(setting.name);
    info.option = "--" + setting.name;
    info.group = groupTitle(SettingGroup::method);
    info.kind = !setting.choices.empty() ? SettingKind::choice
                : setting.whole          ? SettingKind::integer
                                         : SettingKind::number;
    info.metavar.assign(1, setting.whole ? 'N' : 'R');
    info.min = setting.least;
    info.max = setting.most;
    info.choices = setting.choices;
    info.help = setting.description;
    info.defaultValue = setting.standard;
    return info;
}

}  // namespace

std::vector<SettingInfo> settingInfos() {
    std::vector<SettingInfo> infos;
    for (const Setting& setting : settings()) infos.push_back(infoOf(setting));
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) {
            auto known = std::ranges::find(infos, setting.name, &SettingInfo::name);
            if (known == infos.end()) known = infos.insert(infos.end(), infoOf(setting));
            known->methods.push_back(method.name);
        }
    return infos;
}

}  // namespace defocus
