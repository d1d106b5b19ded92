// Tests that textures that cannot be read are listed in Scene::ignored and do not prevent loading.

#include <gtest/gtest.h>

#include "image/png_builder.h"
#include "models.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

const Bytes& redPng() {
    static const Bytes png = buildPng(1, 1, 8, PngColour::rgb, {200, 10, 20});
    return png;
}

// A triangle whose material has this texture as base colour. Each test adds the images.
GltfBuilder texturedTriangle(const nlohmann::json& texture) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}, {"material", 0}}});
    builder.json["textures"] = {texture};
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.5, 0.3, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
    return builder;
}

// Expects a scene with its triangle and its base colour, but without the texture.
void expectOnlyFactors(const Scene& scene) {
    EXPECT_EQ(scene.meshes.at(0).triangleCount(), 1u);
    EXPECT_EQ(scene.materials.at(0).baseColorFactor, glm::vec4(0.8f, 0.5f, 0.3f, 1));
    EXPECT_FALSE(scene.materials.at(0).baseColor.used());
}

void expectNote(const Scene& scene, bool damage, const std::string& part) {
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].damage, damage);
    const std::string note = scene.ignored[0].what + ": " + scene.ignored[0].reason;
    EXPECT_NE(note.find(part), std::string::npos) << note;
}

TEST(GltfTexture, ofAMissingFileIsLeftOut) {
    GltfBuilder builder = texturedTriangle({{"source", 0}});
    builder.json["images"] = {{{"uri", "gone.png"}}};
    const Scene scene = builder.load();
    expectOnlyFactors(scene);
    expectNote(scene, true, "'gone.png' does not exist");
}

TEST(GltfTexture, ofDamagedDataIsLeftOut) {
    Bytes truncated = redPng();
    truncated.resize(40);
    for (const Bytes& data : {truncated, Bytes{'n', 'o', 'n', 'e'}}) {
        GltfBuilder builder = texturedTriangle({{"source", 0}});
        builder.json["images"] = {{{"name", "Bark"}, {"bufferView", builder.view(data)}, {"mimeType", "image/png"}}};
        const Scene scene = builder.load();
        expectOnlyFactors(scene);
        expectNote(scene, true, "'Bark'");
    }
}

// The file has a damaged JPEG that no texture uses; it is one of the glTF validator's test files.
TEST(GltfTexture, damagedImagesThatNothingUsesAreNoFault) {
    DEFOCUS_MODEL_OR_SKIP(path, std::filesystem::path("invalid") / "val_image_invalid_image_data.gltf");
    EXPECT_TRUE(loadGltf(path).ignored.empty());
}

TEST(GltfTexture, imagesThatNothingUsesAreNotRead) {
    GltfBuilder builder = texturedTriangle({{"source", 2}});
    builder.json["images"] = {{{"uri", "gone.png"}}, nlohmann::json::object()};
    builder.add("images", {{"bufferView", builder.view(redPng())}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", 0}});
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.imageNames.at(0), "image 2");
    EXPECT_EQ(scene.textures.at(0).image, 0);
    EXPECT_EQ(scene.textures.at(1).image, -1);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{200, 10, 20, 255}));
}

// Images that declare too many pixels for the size of their file are omitted before they are decoded. Here three images
// share a PNG of a hundred bytes that declares 16384 × 16384 px.
TEST(GltfTexture, pixelsAreCountedBeforeTheyAreDecoded) {
    GltfBuilder builder = texturedTriangle({{"source", 0}});
    Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    // 16384 × 16384 px, 8 bits per channel, grey
    appendChunk(png, "IHDR", {0, 0, 0x40, 0, 0, 0, 0x40, 0, 8, 0, 0, 0, 0});
    appendChunk(png, "IDAT", {0x78, 0x9c, 3, 0, 0, 0, 0, 1});
    appendChunk(png, "IEND", {});
    builder.json["images"] = {{{"bufferView", builder.view(png)}, {"mimeType", "image/png"}}};
    const Scene scene = builder.load();
    expectOnlyFactors(scene);
    expectNote(scene, true, "pixels: 268435456 elements are implausible for a file of");
}

TEST(GltfTexture, unsupportedFormatsFallBackToTheSource) {
    for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp", "MSFT_texture_dds"}) {
        GltfBuilder builder = texturedTriangle({{"extensions", {{extension, {{"source", 0}}}}}, {"source", 1}});
        builder.json["extensionsUsed"] = {extension};
        builder.json["images"] = {{{"bufferView", builder.view(Bytes{1, 2, 3, 4})}, {"mimeType", "image/other"}}};
        builder.add("images", {{"bufferView", builder.view(redPng())}, {"mimeType", "image/png"}});
        const Scene scene = builder.load();
        ASSERT_TRUE(scene.materials.at(0).baseColor.used());
        EXPECT_EQ(scene.images.at(0).rgba, (std::vector<std::uint8_t>{200, 10, 20, 255}));
        expectNote(scene, false, extension);

        builder.json["textures"][0].erase("source");
        const Scene without = builder.load();
        expectOnlyFactors(without);
        for (const Ignored& note : without.ignored)
            EXPECT_NE((note.what + note.reason).find(extension), std::string::npos) << note.what << ": " << note.reason;
    }
}

TEST(GltfTexture, withoutAnImageIsLeftOut) {
    const Scene scene = texturedTriangle(nlohmann::json::object()).load();
    expectOnlyFactors(scene);
    expectNote(scene, false, "it has no image");
}

// Exporters on Windows write backslashes in URIs, which glTF forbids. A file whose name contains a backslash takes
// precedence.
TEST(GltfTexture, backslashesInUrisAreReadAsSlashes) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "maps");
    const auto save = [](const std::filesystem::path& path, const Bytes& bytes) {
        GltfBuilder::save(path, std::string(bytes.begin(), bytes.end()));
    };
    const std::string backslash = "maps\\red.png";
    save(folder / "maps/red.png", redPng());
    GltfBuilder builder = texturedTriangle({{"source", 0}});
    builder.json["images"] = {{{"uri", backslash}}};
    GltfBuilder::save(folder / "built.glb", builder.glb());
    const Scene scene = loadGltf(folder / "built.glb");
    EXPECT_TRUE(scene.materials.at(0).baseColor.used());
    expectNote(scene, false, "read as 'maps/red.png'");

    save(folder / backslash, redPng());
    EXPECT_TRUE(loadGltf(folder / "built.glb").ignored.empty());

    builder.json["images"] = {{{"uri", "\\etc\\red.png"}}};
    GltfBuilder::save(folder / "built.glb", builder.glb());
    expectNote(loadGltf(folder / "built.glb"), true, "not a relative path");
}

TEST(GltfTexture, dataUrisAreNeverPrinted) {
    const std::string data(1000, 'A');
    for (const std::string begin :
         {"data:image/png;base64,", " DATA:Image/PNG;Base64,\n", "data:image/png;base64,*", "data:"}) {
        GltfBuilder builder = texturedTriangle({{"source", 0}});
        builder.json["images"] = {{{"uri", begin + data}}};
        const Scene scene = builder.load();
        expectOnlyFactors(scene);
        expectNote(scene, true, "image 0");
        EXPECT_EQ(scene.ignored[0].reason.find("AAAA"), std::string::npos) << scene.ignored[0].reason;
    }
}

}  // namespace
}  // namespace defocus::engine
