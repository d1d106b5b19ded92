// defocus info, run in this process.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/command.h"
#include "core/error.h"
#include "models.h"

namespace defocus {
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

TEST(Info, jsonHoldsWhatTheFileHolds) {
    DEFOCUS_MODEL_OR_SKIP(path, "GlassVaseFlowers.glb");
    const nlohmann::json json = nlohmann::json::parse(info(path.string() + " --json"));
    EXPECT_EQ(json["triangles"], 10218);
    EXPECT_EQ(json["trianglesInScene"], 14036);
    EXPECT_EQ(json["meshes"].size(), 3u);
    EXPECT_EQ(json["objects"], 4);
    EXPECT_EQ(json["materials"].size(), 3u);
    EXPECT_EQ(json["extensions"], nlohmann::json({"KHR_materials_transmission", "KHR_materials_volume"}));
    ASSERT_EQ(json["ignored"].size(), 2u);
    EXPECT_EQ(json["ignored"][0]["what"], "extension KHR_materials_transmission");
    EXPECT_NE(json["ignored"][0]["reason"], "");
}

TEST(Info, textNamesWhatIsIgnoredAndWhy) {
    DEFOCUS_MODEL_OR_SKIP(path, "MeshPrimitiveModes.gltf");
    const std::string text = info(path.string());
    EXPECT_NE(text.find("3 × lines: only triangles are drawn"), std::string::npos) << text;
    EXPECT_NE(text.find("points: only triangles are drawn"), std::string::npos) << text;
    EXPECT_NE(text.find("16, 16 in the scene"), std::string::npos) << text;
}

TEST(Info, textGroupsLargeNumbersAndListsClips) {
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

TEST(Info, brokenFilesAreErrors) {
    EXPECT_THROW((void)info("/nowhere/none.glb"), Error);
}

}  // namespace
}  // namespace defocus
