// Tests that a row added to the table of settings appears in the panel without further edits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "new_setting.h"
#include "view/panels/panels.h"

namespace defocus::engine {
namespace {

bool panelHas(const char* name) {
    return std::ranges::any_of(settingsPanelRows(), [&](const Setting* setting) { return setting->name == name; });
}

TEST(NewSetting, appearsInThePanel) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    // Runs in a child process, because it adds to the table of settings, which other tests of this process use.
    EXPECT_EXIT(
        {
            EXPECT_FALSE(panelHas("newSetting"));
            addSetting(newSetting());
            EXPECT_TRUE(panelHas("newSetting"));
            EXPECT_TRUE(panelHas("blurThreshold"));
            EXPECT_FALSE(panelHas("fStop"));
            std::exit(testing::Test::HasFailure() ? 1 : 0);
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace defocus::engine
