// Tests that every option of `defocus view` affects the window's initial state: the command's own options, the options
// of the settings table, and the options of the methods. option_cases_test.cpp checks that each option has an entry in
// option_cases.h or a test of its own.

#include <map>

#include "cli/option_cases.h"
#include "image/image_io.h"
#include "view/view_program.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class OptionsOfView : public ViewProgram {
protected:
    void SetUp() override {
        ViewProgram::SetUp();
        if (IsSkipped()) return;
        // Writes the images in a child process: image writers start threads, and start() cannot fork a process with
        // threads.
        const pid_t writer = ::fork();
        if (writer == 0) {
            writeOptionScene(folder());
            ::_exit(0);
        }
        int status = -1;
        ::waitpid(writer, &status, 0);
        ASSERT_EQ(status, 0);
    }

    // Returns the window's state after the scene's first frame.
    json stateAfter(const Words& line) {
        start(line);
        EXPECT_EQ(ended(), 0) << textOf("stderr");
        return state();
    }

    // Returns a string with everything that an option may change: the command that the viewer shows for rendering its
    // image (with all non-default settings), the value of --wave, and the cache folders that exist.
    const std::string& seenOf(const Words& line) {
        const auto known = seen_.find(line);
        if (known != seen_.end()) return known->second;
        const fs::path cache = folder() / "cache" / "defocus";
        for (const fs::path& made : {cache, folder() / "kept"}) fs::remove_all(made);
        const json state = stateAfter(line);
        std::string text = state.at("command").get<std::string>() + " " + state.at("wave").dump();
        if (fs::exists(cache)) text += " cache";
        if (fs::exists(folder() / "kept")) text += " kept";
        return seen_.emplace(line, text).first->second;
    }

    void expectActs(const std::string& name, OptionCase tried) {
        if (name == "size") tried.words = {"--size", "300x200"};  // larger than the min size of a window
        for (Words* words : {&tried.words, &tried.with})
            std::ranges::replace(*words, "10,16,24,18,26,8,30,20", "100,90,120,90,120,60,130,100");
        const CommandLine view = {.name = "view", .command = {}, .size = "240x180", .rest = {"--frames", "1"}};
        const std::string& without = seenOf(lineOfCase(view, name, tried, false));
        EXPECT_NE(without, seenOf(lineOfCase(view, name, tried, true))) << name << " changes nothing";
    }

private:
    std::map<Words, std::string> seen_;
};

// Number of settings that one test covers, small enough that the test takes only seconds. The test parameter is the
// index of the first setting.
constexpr std::size_t settingsATest = 6;

std::vector<std::string> allOffered() {
    std::vector<std::string> names;
    for (const CLI::Option* option : optionsOffered("view"))
        if (const Setting* setting = settingOf(*option)) names.emplace_back(setting->name);
    return names;
}

class SettingsOfView : public OptionsOfView, public testing::WithParamInterface<std::size_t> {};

TEST_P(SettingsOfView, areInWhatTheWindowStartsWith) {
    const std::vector<std::string> names = allOffered();
    for (std::size_t i = GetParam(); i < std::min(names.size(), GetParam() + settingsATest); ++i)
        expectActs(names[i], settingCases().at(names[i]));
}

INSTANTIATE_TEST_SUITE_P(From, SettingsOfView, testing::Range<std::size_t>(0, allOffered().size(), settingsATest),
                         [](const auto& each) { return allOffered()[each.param]; });

class MethodSettingsOfView : public OptionsOfView, public testing::WithParamInterface<std::size_t> {};

TEST_P(MethodSettingsOfView, areInWhatTheWindowStartsWith) {
    const std::vector<std::string> names = methodSettingsOffered("view");
    for (std::size_t i = GetParam(); i < std::min(names.size(), GetParam() + settingsATest); ++i)
        expectActs(names[i], methodSettingCases().at(names[i]));
}

INSTANTIATE_TEST_SUITE_P(From, MethodSettingsOfView,
                         testing::Range<std::size_t>(0, methodSettingsOffered("view").size(), settingsATest),
                         [](const auto& each) {
                             std::string name = methodSettingsOffered("view")[each.param];
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// --frames, --screenshot and --stats have their documented effects. start() always passes --stats.
TEST_F(OptionsOfView, framesScreenshotAndState) {
    const Words scene = {"ball.glb", "--size", "240x180"};
    const json three = stateAfter(joined(scene, {"--frames", "3"}));
    EXPECT_GE(three.at("frames").get<int>(), 3);
    EXPECT_FALSE(fs::exists(folder() / "window.png"));
    stateAfter(joined(scene, {"--screenshot", "window.png"}));
    EXPECT_EQ(readImage(folder() / "window.png").height, 180);
}

}  // namespace
}  // namespace defocus::engine
