#include "defocus/setting_info.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "defocus/renderer.h"
#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus::engine {
namespace {

const SettingInfo& infoNamed(const std::vector<SettingInfo>& infos, const std::string& name) {
    return *std::ranges::find(infos, name, &SettingInfo::name);
}

TEST(SettingInfos, haveEachSettingAndEachOfAMethodOnce) {
    std::set<std::string> expected;
    for (const Setting& setting : settings()) expected.insert(setting.name);
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) expected.insert(setting.name);
    std::set<std::string> names, keywords;
    const std::vector<SettingInfo> infos = settingInfos();
    for (const SettingInfo& info : infos) {
        names.insert(info.name);
        keywords.insert(info.keyword);
    }
    EXPECT_EQ(names, expected);
    EXPECT_EQ(names.size(), infos.size());
    EXPECT_EQ(keywords.size(), infos.size());
}

TEST(SettingInfos, defaultsChangeNothing) {
    for (const SettingInfo& info : settingInfos()) {
        if (!info.defaultValue) continue;
        Request defaults;
        if (!info.methods.empty()) defaults.method = info.methods.front();
        Request request = defaults;
        ASSERT_NO_THROW(setSetting(request, info.name, *info.defaultValue)) << info.name;
        for (const Setting& setting : settings()) EXPECT_EQ(setting.text(request), setting.text(defaults)) << info.name;
    }
}

TEST(SettingInfos, tellFormRangeAndOwners) {
    const std::vector<SettingInfo> infos = settingInfos();
    const SettingInfo& samples = infoNamed(infos, "samples");
    EXPECT_EQ(samples.kind, SettingKind::integer);
    EXPECT_EQ(samples.min, 1);
    EXPECT_EQ(samples.max, maxSamples);
    EXPECT_EQ(samples.defaultValue, "auto");
    EXPECT_TRUE(samples.methods.empty());
    const SettingInfo& focus = infoNamed(infos, "focusDistance");
    EXPECT_EQ(focus.keyword, "focus_distance");
    EXPECT_EQ(focus.unit, "m");
    EXPECT_FALSE(focus.defaultValue);
    const SettingInfo& components = infoNamed(infos, "far-components");
    EXPECT_EQ(components.keyword, "far_components");
    EXPECT_EQ(components.option, "--far-components");
    EXPECT_EQ(std::ranges::count(components.methods, "circular"), 1);
}

}  // namespace
}  // namespace defocus::engine
