// Tests that a row added to the table of settings appears on the command line, in shots and in their schema without
// further edits.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "capture/shot_json.h"
#include "capture/shot_schema.h"
#include "cli/options/request_options.h"
#include "defocus/setting_info.h"
#include "frame/settings/settings.h"
#include "new_setting.h"

namespace defocus::engine {
namespace {

// Adds an undocumented setting to the table of settings. Runs in a child process, because other tests of this process
// require all settings to be documented.
void checkNewSetting() {
    addSetting(newSetting());

    // The command line accepts the setting, and --help lists it.
    Request request;
    CLI::App command;
    addSettings(command, request, settingsOf({SettingGroup::samples}));
    EXPECT_NE(command.help().find("Help of the new setting"), std::string::npos);
    command.parse("--new-setting 4", false);
    EXPECT_EQ(settingNamed("newSetting")->text(request), "4");
    EXPECT_THROW(command.parse("--new-setting 4 --seed 1", false), CLI::ExcludesError);

    // Shot files and their schema accept the setting.
    const Shot shot = parseShot(R"({"newSetting": 5})", "shot.json");
    EXPECT_TRUE(shot.given.contains("newSetting"));
    EXPECT_EQ(settingNamed("newSetting")->text(shot.request), "5");
    EXPECT_THROW((void)parseShot(R"({"newSetting": 11})", "shot.json"), Error);
    const auto schema = withSettings(nlohmann::ordered_json::object());
    EXPECT_EQ(schema["properties"]["newSetting"]["maximum"], 10);
    EXPECT_EQ(schema["properties"]["newSetting"]["examples"], nlohmann::ordered_json::array({2.5}));

    // settingInfos(), from which the Python package makes its keyword arguments, contains the new setting.
    const std::vector<SettingInfo> infos = settingInfos();
    const auto info = std::ranges::find(infos, "newSetting", &SettingInfo::name);
    ASSERT_NE(info, infos.end());
    EXPECT_EQ(info->keyword, "new_setting");
    EXPECT_EQ(info->max, 10);
}

TEST(NewSetting, appearsOnTheCommandLineAndInShots) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            checkNewSetting();
            std::exit(testing::Test::HasFailure() ? 1 : 0);
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace defocus::engine
