// Tests that each option of each command has a case in option_cases.h or own_option_cases.h, or a test of its own. The
// slow tests every_option_gl_slow_test.cpp and every_own_option_gl_slow_test.cpp run the cases.

#include <gtest/gtest.h>

#include <set>

#include "cli/own_option_cases.h"

namespace defocus::engine {
namespace {

// Options that have a test of their own instead of a case: in the file named beside the option, else in
// every_own_option_gl_slow_test.cpp.
const std::set<std::string> triedAlone = {
    " --version",
    " --quiet",
    " --verbose",
    " --shader-dir",
    "render --keep-partial",  // stopping_gl_slow_test.cpp
    "capture --check",
    "capture --refocus",     // commands/capture_refocus_gl_test.cpp
    "refocus --frames",      // commands/refocus_gl_test.cpp
    "refocus --frame-rate",  // commands/refocus_gl_test.cpp
    "bench speedup --allow-changed",
    "bench popping --allow-changed",
    "bench prediction --allow-changed",
    "bench convergence --allow-changed",
    "bench scaling --allow-changed",
    "bench stability --allow-changed",
    "bench scaling --axes",
    "bench scaling --large",
    "bench scaling --runs",
    "bench scaling --scenes",
    "bench scaling --output",
    "bench scaling --report",
    "bench stability --output",
    "bench stability --report",
};

// Collects the command names: "", "render", "bench", "bench speedup" …
void collectCommands(const CLI::App& app, const std::string& names, Words& commands) {
    commands.push_back(names);
    for (const CLI::App* command : app.get_subcommands(nullptr))
        collectCommands(*command, names.empty() ? command->get_name() : names + " " + command->get_name(), commands);
}

TEST(OptionsOfAllCommands, haveACase) {
    Words commands;
    collectCommands(commandNamed(""), "", commands);
    std::set<std::string> own;
    for (const std::string& command : commands)
        for (const CLI::Option* option : optionsOffered(command)) {
            const std::string name = command + " " + nameOf(*option);
            if (ownOptionCases().contains(name))
                own.insert(name);
            else if (const Setting* setting = settingOf(*option))
                EXPECT_TRUE(settingCases().contains(setting->name)) << name;
            else if (const MethodSetting* ofMethod = methodSettingOf(*option))
                EXPECT_TRUE(methodSettingCases().contains(ofMethod->name)) << name;
            else if (command != "view" && command != "bench view")  // tests/view covers the viewer
                own.insert(name);
        }
    for (const std::string& option : own)
        EXPECT_TRUE(ownOptionCases().contains(option) != triedAlone.contains(option)) << option;
    for (const auto& [option, tried] : ownOptionCases()) EXPECT_TRUE(own.contains(option)) << option;
    for (const std::string& option : triedAlone) EXPECT_TRUE(own.contains(option)) << option;
}

}  // namespace
}  // namespace defocus::engine
