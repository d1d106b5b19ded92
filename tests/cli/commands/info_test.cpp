// Tests `defocus info`, which runs in the test process.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.h"
#include "core/error.h"
#include "models.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

std::string info(const std::string& arguments) {
    CLI::App program;
    GlobalOptions global;
    global.quiet = true;
    addInfoCommand(program, global);
    testing::internal::CaptureStdout();
    try {
        program.parse("info " + arguments);
    } catch (...) {
        (void)testing::internal::GetCapturedStdout();
        throw;
    }
    return testing::internal::GetCapturedStdout();
}

// `info --json` lists the contents of a file: here a square that three nodes use, a triangle, and an unknown optional
// extension.
TEST(Info, jsonHoldsWhatTheFileHolds) {
    GltfBuilder builder;
    const int corners = builder.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int square = builder.mesh(
        {{{"attributes", {{"POSITION", corners}}}, {"indices", builder.indices({0, 1, 2, 0, 2, 3})}, {"material", 0}}});
    builder.add("nodes", {{"mesh", square}});
    builder.add("nodes", {{"mesh", square}});
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    builder.add("materials", {{"name", "Plain"}});
    builder.json["extensionsUsed"] = nlohmann::json::array({"EXT_nobody_knows"});
    const ScratchFolder folder;
    GltfBuilder::save(folder / "built.glb", builder.glb());
    const nlohmann::json json = nlohmann::json::parse(info((folder / "built.glb").string() + " --json"));
    EXPECT_EQ(json["triangles"], 2 + 1);
    EXPECT_EQ(json["trianglesInScene"], 3 * 2 + 1);
    EXPECT_EQ(json["meshes"].size(), 2u);
    EXPECT_EQ(json["objects"], 4);
    EXPECT_EQ(json["materials"].size(), 1u);
    EXPECT_EQ(json["extensions"], nlohmann::json::array({"EXT_nobody_knows"}));
    ASSERT_EQ(json["ignored"].size(), 1u);
    EXPECT_EQ(json["ignored"][0]["what"], "extension EXT_nobody_knows");
    EXPECT_NE(json["ignored"][0]["reason"], "");
}

TEST(Info, jsonOfARealFile) {
    DEFOCUS_MODEL_OR_SKIP(path, "GlassVaseFlowers.glb");
    const nlohmann::json json = nlohmann::json::parse(info(path.string() + " --json"));
    EXPECT_EQ(json["triangles"], 10218);
    EXPECT_EQ(json["trianglesInScene"], 14036);
    EXPECT_EQ(json["meshes"].size(), 3u);
    EXPECT_EQ(json["objects"], 4);
    EXPECT_EQ(json["materials"].size(), 3u);
    EXPECT_EQ(json["extensions"], nlohmann::json({"KHR_materials_transmission", "KHR_materials_volume"}));
    EXPECT_TRUE(json["ignored"].empty());
}

// `info` counts the faces that are repaired before simplification: here a duplicate triangle, a degenerate triangle,
// and a third triangle that shares an edge with two others (the diagonal of a square).
TEST(Info, countsWhatIsRepairedBeforeSimplification) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1})}}},
                   {"indices", builder.indices({0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 0, 1, 0, 2, 4})}}});
    const ScratchFolder folder;
    GltfBuilder::save(folder / "fin.glb", builder.glb());
    const std::string file = (folder / "fin.glb").string();
    EXPECT_EQ(nlohmann::json::parse(info(file + " --json"))["meshes"][0]["repairedFaces"],
              nlohmann::json({{"all", 3}, {"dropped", 2}, {"turned", 0}, {"cut", 1}, {"split", 1}}));
    EXPECT_NE(info(file).find(
                  "repairs     3 faces repaired before simplification: 2 removed (no area or repeated), 1 detached at "
                  "edges shared by more than two faces, 1 detached at corners where surfaces only touch"),
              std::string::npos)
        << info(file);
}

TEST(Info, textCountsPointsAndLines) {
    GltfBuilder builder;
    const nlohmann::json corners = {{"POSITION", builder.positions(unitTriangle)}};
    constexpr int points = 0, lines = 1, strip = 3;
    builder.mesh({{{"attributes", corners}},
                  {{"attributes", corners}, {"mode", points}},
                  {{"attributes", corners}, {"mode", lines}},
                  {{"attributes", corners}, {"mode", strip}}});
    const ScratchFolder folder;
    GltfBuilder::save(folder / "modes.glb", builder.glb());
    const std::string text = info((folder / "modes.glb").string());
    EXPECT_NE(text.find("strokes     3 points, 3 lines"), std::string::npos) << text;
    EXPECT_NE(text.find("1, 1 in the scene"), std::string::npos) << text;
}

TEST(Info, textOfARealFileWithLinesAndPoints) {
    DEFOCUS_MODEL_OR_SKIP(path, "MeshPrimitiveModes.gltf");
    const std::string text = info(path.string());
    EXPECT_NE(text.find("strokes     7 points, 19 lines"), std::string::npos) << text;
    EXPECT_NE(text.find("16, 16 in the scene"), std::string::npos) << text;
}

TEST(Info, textGroupsLargeNumbersAndListsClips) {
    const std::string text = info(modelPath("meshes/reed.glb").string());
    for (const char* part : {"Bend", "1,200", "4 joints"}) EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Info, textOfARealFileWithThreeClips) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    const std::string text = info(path.string());
    for (const char* clip : {"Survey", "Walk", "Run"}) EXPECT_NE(text.find(clip), std::string::npos) << text;
    EXPECT_NE(text.find("1,728"), std::string::npos) << text;
    EXPECT_NE(text.find("24 joints"), std::string::npos) << text;
}

TEST(Info, builtInSchoolWithoutAFile) {
    const nlohmann::json json = nlohmann::json::parse(info("--fish 3 --fish-triangles 500 --json"));
    EXPECT_EQ(json["file"], "");
    EXPECT_GE(json["meshes"].size(), 3u);
}

// `info --camera` prints hyperfocal distance, depth of field, angles of view, exposure and blur. The lens is 50 mm at
// f/2 on 36 × 27 mm, focused at s = 2 m. The hyperfocal distance is H = 2500/(2·0.03) mm = 41.667 m, and the near and
// far limits are H·s/(H ± s).
TEST(Info, cameraAnswersWhatPhotographersAsk) {
    const nlohmann::json json = nlohmann::json::parse(
        info("--camera --fish 1 --fish-triangles 200 --focal-length 50 --fstop 2 --focus-distance 2 --size 1000x750 "
             "--depths 1,4,inf --exposure-time 1/125 --iso 400 --json"));
    EXPECT_NEAR(json["acceptableCoc"], 0.03, 1e-12);
    EXPECT_NEAR(json["hyperfocal"], 41.6666667, 1e-6);
    EXPECT_NEAR(json["near"], 41.6666667 * 2 / 43.6666667, 1e-6);
    EXPECT_NEAR(json["far"], 41.6666667 * 2 / 39.6666667, 1e-6);
    EXPECT_NEAR(json["depthOfField"], json["inFrontOfFocus"].get<double>() + json["behindFocus"].get<double>(), 1e-12);
    EXPECT_NEAR(json["inFrontOfFocus"], 2 - json["near"].get<double>(), 1e-12);
    EXPECT_NEAR(json["horizontalFieldOfView"], 39.5978, 1e-4);  // 2·atan(18/50)
    EXPECT_NEAR(json["verticalFieldOfView"], 30.21915, 1e-4);   // 2·atan(13.5/50)
    EXPECT_NEAR(json["exposure"]["ev100"], std::log2(4 * 125 / 4.0), 1e-9);
    ASSERT_EQ(json["blur"].size(), 3u);
    EXPECT_NEAR(json["blur"][0]["pixels"], -0.025 * 0.5 * 1000 / 0.72, 1e-9);
    EXPECT_NEAR(json["blur"][0]["millimetres"], -0.025 * 0.5 * 50, 1e-9);
    EXPECT_FALSE(json["blur"][0]["inFocus"]);
    EXPECT_NEAR(json["blur"][1]["pixels"], 0.025 * 0.25 * 1000 / 0.72, 1e-9);
    EXPECT_NEAR(json["blur"][2]["millimetres"], 0.025 * 0.5 * 50, 1e-9);
    EXPECT_TRUE(json["blur"][2]["depth"].is_null());
    EXPECT_TRUE(json["plainLens"]);
}

TEST(Info, cameraSaysWhereTheControlsCount) {
    const std::string school = "--camera --fish 1 --fish-triangles 200 --focus-distance 2 --size 640x480 ";
    const nlohmann::json json = nlohmann::json::parse(info(school + "--foreground-limit 3 --depths 0.2,50 --json"));
    EXPECT_FALSE(json["plainLens"]);
    EXPECT_EQ(json["blur"][0]["pixels"], -3);
    const std::string text = info(school + "--foreground-limit 3");
    EXPECT_NE(text.find("The depth of field is computed without"), std::string::npos) << text;
    const std::string plain = info(school);
    EXPECT_EQ(plain.find("The depth of field is computed without"), std::string::npos) << plain;
    for (const char* part : {"hyperfocal", "in focus", "field of view", "acceptable blur", "infinity"})
        EXPECT_NE(plain.find(part), std::string::npos) << plain;
}

TEST(Info, cameraIsTheOneThatIsNamed) {
    EXPECT_NO_THROW((void)info("--camera=auto --fish 1 --fish-triangles 200"));
    EXPECT_THROW((void)info("--camera=Nobody --fish 1 --fish-triangles 200"), Error);
}

TEST(Info, brokenFilesAreErrors) {
    EXPECT_THROW((void)info("/nowhere/none.glb"), Error);
}

}  // namespace
}  // namespace defocus::engine
