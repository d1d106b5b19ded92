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

// Returns a triangle whose material has this texture as base colour. Each test adds the images of the texture.
GltfBuilder texturedTriangle(const nlohmann::json& texture) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}, {"material", 0}}});
    builder.json["textures"] = {texture};
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.5, 0.3, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
    return builder;
}

// Expects the scene to contain the triangle and its base colour factor, but not the texture.
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
    expectNote(scene, true, "pixels: 268435456 elements would expand a file of");
}

TEST(GltfTexture, unsupportedFormatsFallBackToTheSource) {
    for (const char* extension : {"KHR_texture_basisu", "MSFT_texture_dds"}) {
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

// Lossless WebP with 3 × 2 pixels, from ffmpeg's libwebp encoder.
const Bytes& webp() {
    static const Bytes bytes = {0x52, 0x49, 0x46, 0x46, 0x4a, 0,    0,    0,    0x57, 0x45, 0x42, 0x50, 0x56, 0x50,
                                0x38, 0x4c, 0x3d, 0,    0,    0,    0x2f, 0x02, 0x40, 0,    0x10, 0x2f, 0x40, 0x98,
                                0x6d, 0xb4, 0xff, 0x38, 0xcf, 0xea, 0x5c, 0xa7, 0x41, 0x26, 0x6d, 0x53, 0x59, 0xf5,
                                0x7f, 0x75, 0xaa, 0x46, 0x10, 0x40, 0x52, 0x0e, 0x9b, 0xec, 0x8f, 0x30, 0xd3, 0x02,
                                0x81, 0x24, 0xb4, 0xcd, 0x56, 0x0f, 0x40, 0x7f, 0x5b, 0xbb, 0x3b, 0x64, 0x01, 0x02,
                                0x01, 0xca, 0x58, 0xf1, 0xc0, 0x27, 0x11, 0xfd, 0x8f, 0x77, 0,    0};
    return bytes;
}

// Colours have straight alpha. OpenImageIO premultiplies WebP images; dividing by alpha again leaves rounding errors.
TEST(GltfTexture, webpWithoutFallbackIsRead) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        GltfBuilder builder = texturedTriangle({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
        builder.json[list] = {"EXT_texture_webp"};
        builder.json["images"] = {{{"bufferView", builder.view(webp())}, {"mimeType", "image/webp"}}};
        const Scene scene = builder.load();
        EXPECT_TRUE(scene.ignored.empty());
        ASSERT_TRUE(scene.materials.at(0).baseColor.used());
        const TextureImage& image = scene.images.at(0);
        ASSERT_EQ(image.width, 3);
        ASSERT_EQ(image.height, 2);
        const std::vector<std::uint8_t> expected = {200, 10,  20, 255, 0,   255, 0,   255, 0, 0, 255, 255,
                                                    200, 100, 50, 128, 255, 255, 255, 64,  0, 0, 0,   0};
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(image.rgba[i], expected[i], expected[i / 4 * 4 + 3] < 255 ? 2 : 0) << i;
    }
}

TEST(GltfTexture, webpFallsBackToTheSource) {
    GltfBuilder builder = texturedTriangle({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}, {"source", 1}});
    builder.json["extensionsUsed"] = {"EXT_texture_webp"};
    builder.json["images"] = {{{"bufferView", builder.view(Bytes{1, 2, 3, 4})}, {"mimeType", "image/webp"}}};
    builder.add("images", {{"bufferView", builder.view(redPng())}, {"mimeType", "image/png"}});
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_EQ(scene.images.at(0).rgba, (std::vector<std::uint8_t>{200, 10, 20, 255}));
}

TEST(GltfTexture, damagedWebpIsLeftOut) {
    for (const std::size_t size : {12, 20, 40}) {
        GltfBuilder builder = texturedTriangle({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
        Bytes part = webp();
        part.resize(size);
        builder.json["images"] = {{{"bufferView", builder.view(part)}, {"mimeType", "image/webp"}}};
        const Scene scene = builder.load();
        expectOnlyFactors(scene);
        expectNote(scene, true, "image 0");
    }
}

// F0 is the texture's colour times specularFactor, and roughness is 1 − glossinessFactor · alpha.
TEST(GltfTexture, ofSpecularAndGlossinessIsReflectanceAndRoughness) {
    GltfBuilder builder = texturedTriangle({{"source", 0}});
    const Bytes png = buildPng(2, 1, 8, PngColour::rgba, {200, 100, 50, 255, 10, 20, 30, 51});
    builder.json["images"] = {{{"bufferView", builder.view(png)}, {"mimeType", "image/png"}}};
    builder.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseFactor", {0.25, 0.5, 0.125, 0.5}},
        {"specularFactor", {1, 0.5, 0.25}},
        {"glossinessFactor", 0.5},
        {"specularGlossinessTexture", {{"index", 0}}}};
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.ignored.empty());
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.baseColorFactor, glm::vec4(0.25f, 0.5f, 0.125f, 0.5f));
    EXPECT_FALSE(material.baseColor.used());
    EXPECT_EQ(material.metallicFactor, 0.0f);
    EXPECT_EQ(material.ior, 0.0f) << "the reflectance without colour is 1";
    EXPECT_EQ(material.specularColorFactor, glm::vec3(1, 0.5f, 0.25f));
    const auto imageOf = [&](const TextureUse& use) {
        return scene.images.at(
            static_cast<std::size_t>(scene.textures.at(static_cast<std::size_t>(use.texture)).image));
    };
    EXPECT_EQ(imageOf(material.specularColor).rgba[4], 10);
    ASSERT_TRUE(material.metallicRoughness.used());
    EXPECT_NEAR(material.roughnessFactor * imageOf(material.metallicRoughness).rgba[1] / 255, 1 - 0.5, 0.003);
    EXPECT_NEAR(material.roughnessFactor * imageOf(material.metallicRoughness).rgba[5] / 255, 1 - 0.5 * 0.2, 0.003);
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
