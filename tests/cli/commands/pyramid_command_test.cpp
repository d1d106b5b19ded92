// Tests `defocus pyramid`, which runs in the test process.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.h"
#include "core/error.h"
#include "core/file.h"
#include "lod/invariants.h"
#include "lod/pyramid/cache.h"
#include "scene/gltf/gltf.h"
#include "scene/gltf/write.h"
#include "school/fish_school.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

std::string pyramid(std::vector<std::string> arguments) {
    CLI::App program;
    GlobalOptions global;
    global.quiet = true;
    addPyramidCommand(program, global);
    arguments.insert(arguments.begin(), "pyramid");
    std::reverse(arguments.begin(), arguments.end());  // CLI11 expects the arguments in reverse order
    testing::internal::CaptureStdout();
    try {
        program.parse(arguments);
    } catch (...) {
        (void)testing::internal::GetCapturedStdout();
        throw;
    }
    return testing::internal::GetCapturedStdout();
}

const std::vector<std::string> oneFish = {"--fish", "1", "--fish-triangles", "2000"};

std::vector<std::string> withFish(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = oneFish;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<glm::vec3> cornerPositions(const Mesh& mesh, std::size_t primitive) {
    std::vector<glm::vec3> corners;
    for (const std::uint32_t v : mesh.primitives.at(primitive).indices) corners.push_back(mesh.vertices.positions[v]);
    return corners;
}

TEST(PyramidCommand, JsonHoldsTheLevelsAndWhatWasMeasured) {
    const nlohmann::json json = nlohmann::json::parse(pyramid(withFish({"--json"})));
    const Pyramid expected = buildPyramid(fishSchool({1, 2000, 1}).meshes.at(0));
    const nlohmann::json& mesh = json["meshes"][0];
    ASSERT_EQ(mesh["levels"].size(), expected.levels.size());
    EXPECT_GT(mesh["buildSeconds"], 0);
    EXPECT_EQ(mesh["end"], "minTriangles");
    for (std::size_t l = 0; l < expected.levels.size(); ++l) {
        const nlohmann::json& level = mesh["levels"][l];
        EXPECT_EQ(level["triangles"], expected.levels[l].triangleCount);
        EXPECT_EQ(level["vertices"], expected.levels[l].vertexCount);
        EXPECT_EQ(level["error"].get<double>(), expected.levels[l].error);
        ASSERT_EQ(level.contains("measured"), l > 0);
        if (l == 0) continue;
        EXPECT_GE(level["error"].get<double>(), 0.9 * level["measured"]["percentile99"].get<double>());
        EXPECT_LE(level["measured"]["percentile99"], level["measured"]["maximum"]);
        EXPECT_LT(level["measured"]["mean"], level["measured"]["percentile99"]);
    }
    const nlohmann::json quick = nlohmann::json::parse(pyramid(withFish({"--json", "--no-measure"})));
    EXPECT_FALSE(quick["meshes"][0]["levels"][1].contains("measured"));
}

TEST(PyramidCommand, ExportedLevelsReadBackAsTheyAre) {
    const ScratchFolder folder;
    const std::string levels = (folder / "a" / "levels").string();
    const nlohmann::json json =
        nlohmann::json::parse(pyramid(withFish({"--json", "--no-measure", "--export", levels})));
    const Pyramid expected = buildPyramid(fishSchool({1, 2000, 1}).meshes.at(0));
    ASSERT_GT(expected.levels.size(), 3u);
    for (std::size_t l = 0; l < expected.levels.size(); ++l) {
        const PyramidLevel& level = expected.levels[l];
        const Scene scene = loadGltf(json["meshes"][0]["levels"][l]["file"].get<std::string>());
        EXPECT_TRUE(scene.ignored.empty());
        ASSERT_EQ(scene.meshes.size(), 1u);
        ASSERT_EQ(scene.meshes[0].primitives.size(), level.primitives.size());
        for (std::size_t p = 0; p < level.primitives.size(); ++p) {
            std::vector<glm::vec3> corners;
            for (std::uint32_t i = 0; i < level.primitives[p].count; ++i)
                corners.push_back(level.positions[expected.indices[level.primitives[p].first + i]]);
            EXPECT_EQ(cornerPositions(scene.meshes[0], p), corners) << "level " << l;
        }
        for (const glm::vec3& normal : scene.meshes[0].vertices.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
        EXPECT_EQ(scene.meshes[0].vertices.uv0.empty(), expected.vertices.uv0.empty());
        EXPECT_EQ(scene.meshes[0].vertices.colors.empty(), level.colors.empty());
    }
}

// Exported files stay in the given folder even if the mesh has a name such as ../../evil.
TEST(PyramidCommand, NoNameLeavesTheFolder) {
    const ScratchFolder folder;
    for (const char* name : {"../../evil", "/etc/evil", "..", ".hidden", "a\nb", "\xc3\xa9t\xc3\xa9"}) {
        Mesh mesh = flatGrid(1);
        mesh.name = name;
        writeGlb(folder / "in.glb", mesh);
        const nlohmann::json json = nlohmann::json::parse(
            pyramid({(folder / "in.glb").string(), "--json", "--export", (folder / "out").string()}));
        const std::filesystem::path file = json["meshes"][0]["levels"][0]["file"].get<std::string>();
        EXPECT_EQ(file.parent_path(), folder / "out") << name;
        EXPECT_NE(file.filename().string().front(), '.') << name;
        EXPECT_TRUE(std::filesystem::is_regular_file(file)) << name;
    }
}

TEST(PyramidCommand, TextHasALineALevel) {
    const std::string text = pyramid(oneFish);
    const Pyramid expected = buildPyramid(fishSchool({1, 2000, 1}).meshes.at(0));
    EXPECT_NE(text.find(fmt::format("{} levels", expected.levels.size())), std::string::npos) << text;
    EXPECT_NE(text.find("measured distance"), std::string::npos) << text;
    EXPECT_NE(text.find(std::to_string(expected.levels.back().triangleCount)), std::string::npos) << text;
}

// With --cache-dir, pyramids are built only once. A second run loads them and prints the same levels.
TEST(PyramidCommand, KeepsLevelsInTheFolderThatItIsGiven) {
    const ScratchFolder folder;
    const std::string cache = (folder / "cache").string();
    const std::vector<std::string> arguments = withFish({"--json", "--no-measure", "--cache-dir", cache});
    nlohmann::json built = nlohmann::json::parse(pyramid(arguments))["meshes"][0];
    EXPECT_EQ(cacheFiles(cache).size(), 1u);
    EXPECT_GT(built["buildSeconds"], 0);
    nlohmann::json loaded = nlohmann::json::parse(pyramid(arguments))["meshes"][0];
    EXPECT_TRUE(loaded["buildSeconds"].is_null());
    built.erase("buildSeconds");
    loaded.erase("buildSeconds");
    EXPECT_EQ(loaded, built);
    EXPECT_NE(pyramid(withFish({"--no-measure", "--cache-dir", cache})).find("from the cache"), std::string::npos);
}

TEST(PyramidCommand, SaysWhyThereIsNoFurtherLevel) {
    const ScratchFolder folder;
    writeGlb(folder / "slab.glb", slab(20, 3));
    const std::string file = (folder / "slab.glb").string();
    EXPECT_NE(pyramid({file, "--no-measure"}).find("no further level: holes"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(pyramid({file, "--no-measure", "--json"}))["meshes"][0]["end"], "topology");
    EXPECT_NE(pyramid(withFish({"--no-measure"}))
                  .find("no further level: the last level has the minimum number of triangles"),
              std::string::npos);
}

TEST(PyramidCommand, UnknownMeshAndFolderThatCannotBeWrittenAreErrors) {
    const std::string name = fishSchool({1, 2000, 1}).meshes.at(0).name;
    EXPECT_NE(messageOf<Error>([&] { (void)pyramid(withFish({"--mesh", name + "x"})); }).find(name), std::string::npos);
    const ScratchFolder folder;
    writeFile(folder / "file", "x");
    for (const char* target : {"file", "file/below"}) {
        const std::string path = (folder / target).string();
        EXPECT_NE(messageOf<Error>([&] { (void)pyramid(withFish({"--export", path})); }).find(path), std::string::npos);
    }
}

}  // namespace
}  // namespace defocus::engine
