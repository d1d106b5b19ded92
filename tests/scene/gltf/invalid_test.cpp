// Tests that invalid and hostile files give a one-line error that names the file and says what is wrong.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "models.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

std::string errorOf(const std::filesystem::path& path) {
    return messageOf<Error>([&] { (void)loadGltf(path); });
}

std::string errorOf(const GltfBuilder& builder) {
    return messageOf<Error>([&] { (void)builder.load(); });
}

void expectFault(const std::string& message, const std::string& file, const std::string& fault) {
    EXPECT_NE(message.find(file), std::string::npos) << "'" << message << "' does not name " << file;
    EXPECT_NE(message.find(fault), std::string::npos) << "'" << message << "' does not say " << fault;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

struct InvalidFile {
    const char* file;
    const char* fault;
};

class Invalid : public testing::TestWithParam<InvalidFile> {};

TEST_P(Invalid, isOneLineThatNamesFileAndFault) {
    DEFOCUS_MODEL_OR_SKIP(path, std::filesystem::path("invalid") / GetParam().file);
    expectFault(errorOf(path), GetParam().file, GetParam().fault);
}

constexpr InvalidFile invalidFiles[] = {
    {"val_json_empty_file.gltf", "JSON"},
    {"val_json_invalid_syntax.gltf", "JSON"},
    {"val_json_bom.gltf", "byte order mark"},
    {"val_glb_truncated_chunk_data.glb", "truncated"},
    {"val_glb_length_mismatch.glb", "length mismatch"},
    {"val_glb_invalid_magic.glb", "magic"},
    {"val_glb_only_header.glb", "too small"},
    {"val_asset_1_0_version.gltf", "version 1.0"},
    {"val_accessor_unresolved_bufferviews.gltf", "accessors[0].bufferView is 0, but the file has 0"},
    {"val_buffer_not_found.gltf", "not_found.bin"},
    {"val_buffer_wrong_bytelength.glb", "byteLength is 17"},
    {"val_buffer_view_invalid_length.gltf", "buffer view 0"},
    {"val_mesh_unresolved_indices.gltf", "indices is 1"},
    {"val_mesh_accessor_unequal_count.gltf", "but POSITION has"},
    {"val_mesh_data_index_buffer_oob.gltf", "out of range"},
    {"val_node_node_loop.gltf", "loop"},
    {"val_skin_unresolved_joint.gltf", "joints[0] is 0"},
    {"assimp_IndexOutOfRange_IndexOutOfRange.gltf", "index 255 is out of range"},
    {"assimp_BoxWithInfinites-glTF-Binary_BoxWithInfinites.glb", "infinite"},
};
INSTANTIATE_TEST_SUITE_P(Corpus, Invalid, testing::ValuesIn(invalidFiles),
                         [](const auto& tested) { return testNameOf(tested.param.file); });

TEST(InvalidGltf, missingFileAndDirectory) {
    const ScratchFolder folder;
    expectFault(errorOf(folder / "none.glb"), "none.glb", "No such file");
    expectFault(errorOf(folder.path()), folder.path().string(), "is a folder");
}

GltfBuilder triangle() {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}});
    return builder;
}

TEST(InvalidGltf, theTriangleThatTheseTestsBreakLoads) {
    EXPECT_EQ(errorOf(triangle()), "");
}

TEST(InvalidGltf, requiredExtensionIsNamed) {
    GltfBuilder builder = triangle();
    builder.json["extensionsRequired"] = {"EXT_unheard_of"};
    expectFault(errorOf(builder), "built.glb", "EXT_unheard_of");
}

TEST(InvalidGltf, metadataExtensionsAreNoFault) {
    GltfBuilder builder = triangle();
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) builder.json[list] = {"KHR_xmp_json_ld"};
    EXPECT_TRUE(builder.load().ignored.empty());
}

TEST(InvalidGltf, wrongTypesAreNamedByPlace) {
    GltfBuilder builder = triangle();
    builder.json["accessors"][0]["count"] = "three";
    expectFault(errorOf(builder), "built.glb", "accessors[0].count must be an integer");
    builder.json["accessors"][0]["count"] = -3;
    expectFault(errorOf(builder), "built.glb", "accessors[0].count must be an integer of at least 0");
    builder = triangle();
    builder.json["nodes"][0]["matrix"] = {1, 0, 0};
    expectFault(errorOf(builder), "built.glb", "nodes[0].matrix must have 16 numbers, not 3");
    builder = triangle();
    builder.json["meshes"] = 7;
    expectFault(errorOf(builder), "built.glb", "meshes must be an array");
}

// Integers such as 3.0 are accepted, since JSON has a single number type.
TEST(InvalidGltf, integersMayBeWrittenAsFloats) {
    GltfBuilder builder = triangle();
    builder.json["accessors"][0]["count"] = 3.0;
    builder.json["accessors"][0]["componentType"] = 5126.0;
    builder.json["bufferViews"][0]["byteLength"] = 36.0;
    builder.json["nodes"][0]["mesh"] = 0.0;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -0.0;
    builder.json["meshes"][0]["primitives"][0]["mode"] = 4.0;
    ASSERT_EQ(errorOf(builder), "");
    EXPECT_EQ(builder.load().meshes.at(0).triangleCount(), 1u);
    for (const double count : {2.5, -3.0, 1e300}) {
        builder.json["accessors"][0]["count"] = count;
        expectFault(errorOf(builder), "built.glb", "accessors[0].count must be an integer of at least 0");
    }
}

TEST(InvalidGltf, buffersWithoutDataAreAFaultWhereTheyAreRead) {
    GltfBuilder builder = triangle();
    builder.json["buffers"] = {{{"byteLength", 1}}};
    builder.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 1}}};
    const int zeros = builder.accessor(-1, gltfFloat, "VEC3", 3);
    const ScratchFolder folder;
    GltfBuilder::save(folder / "built.gltf", builder.json.dump());
    expectFault(errorOf(folder / "built.gltf"), "built.gltf", "buffer 0 has no data");
    builder.json["accessors"].erase(0);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = zeros - 1;
    GltfBuilder::save(folder / "unused.gltf", builder.json.dump());
    EXPECT_EQ(errorOf(folder / "unused.gltf"), "");
}

TEST(InvalidGltf, hugeCountsAreRefusedBeforeMemoryIsTaken) {
    for (const std::uint64_t count : {std::uint64_t{1} << 33, std::uint64_t{4'000'000'000}, std::uint64_t{1} << 52}) {
        GltfBuilder builder;
        builder.mesh({{{"attributes", {{"POSITION", builder.accessor(-1, gltfFloat, "VEC3", count)}}}}});
        expectFault(errorOf(builder), "built.glb", "elements");
    }
    GltfBuilder builder = triangle();
    builder.json["accessors"][0]["count"] = std::uint64_t{1} << 52;  // more elements than the buffer view can hold
    expectFault(errorOf(builder), "built.glb", "extend past the end of buffer view 0");
    builder = triangle();
    builder.json["accessors"][0]["byteOffset"] = (std::uint64_t{1} << 53) - 1;
    expectFault(errorOf(builder), "built.glb", "extend past the end of buffer view 0");
}

TEST(InvalidGltf, manySmallClaimsAddUp) {
    GltfBuilder builder;
    nlohmann::json primitives;
    for (int i = 0; i < 100; ++i)
        primitives.push_back({{"attributes", {{"POSITION", builder.accessor(-1, gltfFloat, "VEC3", 10'000'000)}}}});
    builder.mesh(primitives);
    expectFault(errorOf(builder), "built.glb", "elements");
}

TEST(InvalidGltf, deepJsonIsRefused) {
    const ScratchFolder folder;
    std::string nested(1'000'000, '[');
    GltfBuilder::save(folder / "deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + nested);
    expectFault(errorOf(folder / "deep.gltf"), "deep.gltf", "nested");
}

TEST(InvalidGltf, deepHierarchiesAreWalked) {
    GltfBuilder builder = triangle();
    constexpr int depth = 200'000;
    for (int i = 0; i < depth; ++i) builder.json["nodes"].push_back({{"children", {i}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.nodes.size(), depth + 1u);
    EXPECT_EQ(scene.roots.size(), 1u);
}

TEST(InvalidGltf, nodesWithTwoParentsOrThemselvesAsParent) {
    GltfBuilder builder = triangle();
    builder.json["nodes"].push_back({{"children", {0}}});
    builder.json["nodes"].push_back({{"children", {0}}});
    expectFault(errorOf(builder), "built.glb", "node 0 is a child of two nodes");
    builder = triangle();
    builder.json["nodes"][0]["children"] = {0};
    expectFault(errorOf(builder), "built.glb", "loop");
}

TEST(InvalidGltf, overflowingTransformsAreRefused) {
    GltfBuilder builder = triangle();
    builder.json["nodes"][0]["scale"] = {1e300, 1, 1};
    builder.json["nodes"].push_back({{"children", {0}}, {"scale", {1e300, 1, 1}}});
    expectFault(errorOf(builder), "built.glb", "not finite");
}

TEST(InvalidGltf, namesCannotBreakTheLine) {
    GltfBuilder builder = triangle();
    builder.json["meshes"][0]["name"] = "a\nb\r\x1b[2J";
    builder.json["meshes"][0]["primitives"][0]["mode"] = 9;
    const std::string message = errorOf(builder);
    expectFault(message, "built.glb", "mode 9");
    EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](unsigned char c) { return c < 0x20; }));
}

TEST(InvalidGltf, namesSayNothingToATerminal) {
    GltfBuilder builder = triangle();
    builder.json["nodes"][0]["name"] = "fish\x1b[31m\nred";
    EXPECT_EQ(builder.load().nodes[0].name, "fish?[31m?red");
}

TEST(InvalidGltf, namesCannotBuryTheFault) {
    GltfBuilder builder = triangle();
    builder.json["extensionsRequired"] = {std::string(100'000, 'x')};
    EXPECT_LT(errorOf(builder).size(), 1000u);
}

TEST(InvalidGltf, filesOutsideAreNotFetched) {
    for (const char* uri : {"http://example.org/a.bin", "/dev/zero", "file:///etc/passwd", "..", ""}) {
        GltfBuilder builder;
        builder.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
        expectFault(errorOf(builder), "built.glb", "buffer 0");
    }
}

TEST(InvalidGltf, sparseIndicesBeyondTheAccessor) {
    GltfBuilder builder;
    const int indices = builder.view(std::vector<std::uint16_t>{0, 3});
    const int values = builder.view(std::vector<float>{1, 2, 3, 4, 5, 6});
    const nlohmann::json sparse = {{"count", 2},
                                   {"indices", {{"bufferView", indices}, {"componentType", gltfUnsignedShort}}},
                                   {"values", {{"bufferView", values}}}};
    builder.mesh({{{"attributes", {{"POSITION", builder.accessor(-1, gltfFloat, "VEC3", 3, {{"sparse", sparse}})}}}}});
    expectFault(errorOf(builder), "built.glb", "sparse index 3");
}

TEST(InvalidGltf, jointsBeyondTheSkin) {
    GltfBuilder builder;
    const int positions = builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int joints = builder.accessor(builder.view(std::vector<std::uint8_t>(12, 5)), gltfUnsignedByte, "VEC4", 3);
    const int weights = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    builder.mesh({{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}}},
                 {{"skin", 0}});
    builder.json["skins"] = {{{"joints", {0}}}};
    expectFault(errorOf(builder), "built.glb", "joint 5");
}

TEST(InvalidGltf, animationsThatCannotBePlayed) {
    GltfBuilder builder = triangle();
    const int times = builder.floats({0, 1}, "SCALAR", 1);
    const int backwards = builder.floats({1, 0}, "SCALAR", 1);
    const int values = builder.floats({0, 0, 0, 1, 1, 1}, "VEC3", 3);
    const auto animation = [&](int input, int output, const char* interpolation, int sampler) {
        GltfBuilder animated = builder;
        animated.json["animations"] = {
            {{"channels", {{{"sampler", sampler}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
        return errorOf(animated);
    };
    EXPECT_EQ(animation(times, values, "LINEAR", 0), "");
    expectFault(animation(backwards, values, "LINEAR", 0), "built.glb", "do not increase");
    expectFault(animation(times, values, "CUBICSPLINE", 0), "built.glb", "need 18 values");
    expectFault(animation(times, values, "BEZIER", 0), "built.glb", "BEZIER");
    expectFault(animation(times, values, "LINEAR", 7), "built.glb", "sampler 7");
    expectFault(animation(times, times, "LINEAR", 0), "built.glb", "components");
}

TEST(InvalidGltf, camerasAndLightsThatAreImpossible) {
    GltfBuilder builder = triangle();
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 4.0}, {"znear", 0.1}}}}};
    expectFault(errorOf(builder), "built.glb", "yfov");
    builder = triangle();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "laser"}}};
    expectFault(errorOf(builder), "built.glb", "laser");
    builder = triangle();
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
    expectFault(errorOf(builder), "built.glb", "light 2");
}

}  // namespace
}  // namespace defocus::engine
