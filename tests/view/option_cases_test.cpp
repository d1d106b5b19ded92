// Tests that each option of `defocus view` has a case, or a test of its own. every_option_slow_test.cpp runs the cases.

#include "cli/option_cases.h"

#include <gtest/gtest.h>

#include <set>

namespace defocus::engine {
namespace {

TEST(OptionsOfViewCommand, haveACase) {
    // options of `defocus view` with their own test in every_option_slow_test.cpp
    const std::set<std::string> own = {"--frames", "--screenshot", "--stats"};
    for (const CLI::Option* option : optionsOffered("view"))
        if (const Setting* setting = settingOf(*option))
            EXPECT_TRUE(settingCases().contains(setting->name)) << setting->name;
        else if (const MethodSetting* ofMethod = methodSettingOf(*option))
            EXPECT_TRUE(methodSettingCases().contains(ofMethod->name)) << ofMethod->name;
        else
            EXPECT_TRUE(own.contains(nameOf(*option))) << nameOf(*option);
}

}  // namespace
}  // namespace defocus::engine
