// Tests the files that the viewer keeps between runs: recent scenes and saved views.

#include "view/document/kept_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "lens/lens_fields.h"
#include "view/random_view.h"

namespace defocus::engine {
namespace {

class WindowMemory : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-memory-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] std::filesystem::path scene(int i) const {
        const std::filesystem::path path = folder_ / ("scene" + std::to_string(i) + ".glb");
        std::ofstream(path) << "a scene";
        return path;
    }
    [[nodiscard]] std::filesystem::path list() const { return folder_ / "state" / "recent.json"; }
    [[nodiscard]] std::filesystem::path views() const { return folder_ / "config" / "views.json"; }

    std::filesystem::path folder_;
};

TEST_F(WindowMemory, theLatestSceneComesFirstAndOnce) {
    EXPECT_TRUE(readRecentFiles(list()).empty());
    for (const int i : {1, 2, 3, 1}) rememberRecentFile(list(), scene(i));
    EXPECT_EQ(readRecentFiles(list()), (std::vector{scene(1), scene(3), scene(2)}));
    std::filesystem::remove(folder_ / "scene3.glb");
    EXPECT_EQ(readRecentFiles(list()), (std::vector{scene(1), scene(2)}));
    for (int i = 0; i < 40; ++i) rememberRecentFile(list(), scene(i));
    EXPECT_EQ(readRecentFiles(list()).size(), maxRecentFiles);
    EXPECT_EQ(readRecentFiles(list()).front(), scene(39));
}

TEST_F(WindowMemory, linksAreReplacedAndNotFollowed) {
    namespace fs = std::filesystem;
    rememberRecentFile(list(), scene(1));
    const fs::path victim = folder_ / "victim.json";
    fs::rename(list(), victim);
    fs::create_symlink(victim, list());
    EXPECT_TRUE(readRecentFiles(list()).empty());
    rememberRecentFile(list(), scene(2));
    EXPECT_FALSE(fs::is_symlink(list()));
    EXPECT_EQ(readRecentFiles(list()), std::vector{scene(2)});
    EXPECT_EQ(readRecentFiles(victim), std::vector{scene(1)});
}

TEST_F(WindowMemory, aListThatIsNoneIsBegunAnew) {
    std::filesystem::create_directories(list().parent_path());
    for (const char* text : {"", "{", "3", "{\"a\": 1}", "[3, null]"}) {
        std::ofstream(list()) << text;
        EXPECT_TRUE(readRecentFiles(list()).empty()) << text;
    }
    rememberRecentFile(list(), scene(1));
    EXPECT_EQ(readRecentFiles(list()), std::vector{scene(1)});
}

TEST_F(WindowMemory, viewsComeBackAsTheyWere) {
    Dice dice(3);
    std::vector<SavedView> kept;
    for (int i = 0; i < 20; ++i) {
        SavedView view{"view " + std::to_string(i), {randomCamera(dice), dice.number(0.1, 9)}, 0.02, {}};
        changeFields(view.lens, dice);
        try {
            checkLens(view.lens);
        } catch (const Error&) {
            view.lens = {};
        }
        kept.push_back(view);
    }
    writeSavedViews(views(), "a", kept);
    writeSavedViews(views(), "b", {kept[0]});
    const std::vector<SavedView> read = readSavedViews(views(), "a");
    ASSERT_EQ(read.size(), kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_EQ(read[i].name, kept[i].name);
        EXPECT_EQ(read[i].camera.worldFromCamera, kept[i].camera.worldFromCamera);
        EXPECT_EQ(read[i].camera.pivotDistance, kept[i].camera.pivotDistance);
        for (const LensField& field : lensFields())
            EXPECT_DOUBLE_EQ(lensFieldValue(read[i].lens, field),
                             std::min(lensFieldValue(kept[i].lens, field), field.max))
                << field.name;
    }
    writeSavedViews(views(), "a", {});
    EXPECT_TRUE(readSavedViews(views(), "a").empty());
    EXPECT_EQ(readSavedViews(views(), "b").size(), 1u);
}

TEST_F(WindowMemory, viewsWithoutSenseAreLeftOutAndNoJsonIsAFault) {
    SavedView view;
    view.name = "good";
    writeSavedViews(views(), "a", {view});
    std::ifstream file(views());
    nlohmann::json json = nlohmann::json::parse(file);
    nlohmann::json flat = json["a"][0];
    flat["worldFromCamera"][0] = 0;
    nlohmann::json nameless = json["a"][0];
    nameless["name"] = 3;
    nlohmann::json impossible = json["a"][0];
    impossible["pivotDistance"] = -1;
    json["a"] = {flat, nameless, impossible, json["a"][0], 3, nullptr};
    std::ofstream(views()) << json;
    EXPECT_EQ(readSavedViews(views(), "a").size(), 1u);
    std::ofstream(views()) << "[";
    EXPECT_THROW(readSavedViews(views(), "a"), Error);
    // throws, since files of other programs must not be overwritten
    EXPECT_THROW(writeSavedViews(views(), "a", {view}), Error);
}

}  // namespace
}  // namespace defocus::engine
