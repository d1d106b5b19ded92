// Tests that a row added to the table of settings appears in every interface without further edits.

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

namespace defocus::engine {
namespace {

// Returns a numeric setting that has no member of its own in Request. Its functions store the value in Request::clip.
Setting newSetting() {
    Setting setting;
    setting.name = "newSetting";
    setting.option = "--new-setting";
    setting.group = SettingGroup::samples;
    setting.kind = SettingKind::number;
    setting.metavar = "R";
    setting.max = 10;
    setting.help = "Help of the new setting";
    setting.example = "3";
    setting.everyday = true;
    setting.excludes = {"seed"};
    setting.shotPlace = "/newSetting";
    setting.set = [](Request& request, const std::string& text) { request.clip = text; };
    setting.text = [](const Request& request) {
        return request.clip.empty() ? std::nullopt : std::optional(request.clip);
    };
    setting.clear = [](Request& request) { request.clip.clear(); };
    setting.unused = [](const SettingContext&) { return std::string("nothing uses it"); };
    return setting;
}

// Runs in a child process, because other tests of this process compare the table of settings with its documentation.
void checkNewSetting() {
    addSetting(newSetting());

    // The setting on the command line and in its help.
    Request request;
    CLI::App command;
    addSettings(command, request, settingsOf({SettingGroup::samples}));
    EXPECT_NE(command.help().find("Help of the new setting"), std::string::npos);
    command.parse("--new-setting 4", false);
    EXPECT_EQ(settingNamed("newSetting")->text(request), "4");
    EXPECT_THROW(command.parse("--new-setting 4 --seed 1", false), CLI::ExcludesError);

    // The setting in shots and in their schema.
    const Shot shot = parseShot(R"({"newSetting": 5})", "shot.json");
    EXPECT_TRUE(shot.given.contains("newSetting"));
    EXPECT_EQ(settingNamed("newSetting")->text(shot.request), "5");
    EXPECT_THROW((void)parseShot(R"({"newSetting": 11})", "shot.json"), Error);
    const auto schema = withSettings(nlohmann::ordered_json::object());
    EXPECT_EQ(schema["properties"]["newSetting"]["maximum"], 10);
    EXPECT_EQ(schema["properties"]["newSetting"]["examples"], nlohmann::ordered_json::array({3}));

    // settingInfos() provides the keyword arguments of Python and the rows of the viewer.
    const std::vector<SettingInfo> infos = settingInfos();
    const auto info = std::ranges::find(infos, "newSetting", &SettingInfo::name);
    ASSERT_NE(info, infos.end());
    EXPECT_EQ(info->keyword, "new_setting");
    EXPECT_EQ(info->max, 10);
}

TEST(NewSetting, appearsEverywhere) {
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
