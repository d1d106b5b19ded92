// Tests that `defocus new-shot` writes a shot that `capture` accepts, with the schema for shots beside it.

#include <nlohmann/json.hpp>

#include "cli/gl_program.h"
#include "cli/option_cases.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class NewShot : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        fs::create_directory(folder() / "scenes");
        writeOptionScene(folder() / "scenes");
    }
    [[nodiscard]] json shot(const char* name) const { return json::parse(textOf(folder() / name)); }
};

TEST_F(NewShot, ofAnAnimationIsCaptured) {
    ASSERT_EQ(run({"new-shot", "scenes/ball.glb"}).exitCode, 0);
    const json made = shot("ball.json");
    EXPECT_EQ(made.begin().key(), "$schema");
    EXPECT_EQ(json::parse(textOf(folder() / made.at("$schema").get<std::string>())).at("title"), "defocus shot");
    EXPECT_EQ(made.at("scene"), "scenes/ball.glb");
    EXPECT_EQ(made.at("range"), json({0, 47})) << "2 s at 24 frames a second";
    EXPECT_EQ(made.at("animation").at("clip"), "Away");
    const Outcome captured = run({"capture", "ball.json", "--range", "3", "--size", "32x18", "--samples", "2"});
    EXPECT_EQ(captured.exitCode, 0) << captured.err;
    EXPECT_TRUE(fs::exists(folder() / "ball/0003.exr"));
}

TEST_F(NewShot, findsTheSceneFromAnotherFolder) {
    fs::create_directory(folder() / "shots");
    ASSERT_EQ(run({"new-shot", "scenes/ball.glb", "-o", "shots/a.json"}).exitCode, 0);
    EXPECT_EQ(shot("shots/a.json").at("scene"), "../scenes/ball.glb");
    EXPECT_EQ(run({"capture", "shots/a.json", "--dry-run", "--range", "0"}).exitCode, 0);
}

TEST_F(NewShot, ofTheSchoolTurns) {
    ASSERT_EQ(run({"new-shot"}).exitCode, 0);
    EXPECT_EQ(shot("fish.json").at("camera").at("turntable").at("turns"), 1);
    EXPECT_FALSE(shot("fish.json").contains("scene"));
}

TEST_F(NewShot, replacesNoneUnasked) {
    ASSERT_EQ(run({"new-shot", "scenes/ball.glb"}).exitCode, 0);
    std::ofstream(folder() / "ball.json") << "mine";
    std::ofstream(folder() / "shot.schema.json") << "mine too";
    expectOneLine(run({"new-shot", "scenes/ball.glb"}), 1);
    EXPECT_EQ(textOf(folder() / "ball.json"), "mine");
    ASSERT_EQ(run({"new-shot", "scenes/ball.glb", "--overwrite"}).exitCode, 0);
    EXPECT_EQ(shot("ball.json").at("frameRate"), 24);
    EXPECT_EQ(textOf(folder() / "shot.schema.json"), "mine too") << "an existing schema is kept";
}

TEST_F(NewShot, faultsAreOneLine) {
    expectOneLine(run({"new-shot", "missing.glb"}), 1);
    EXPECT_FALSE(fs::exists(folder() / "missing.json"));
}

}  // namespace
}  // namespace defocus::engine
