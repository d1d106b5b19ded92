// Tests that a scene built from memory equals the scene of a glTF file with the same data, and that invalid data is
// rejected.

#include "scene/scene_from_data.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "image/tone_map.h"
#include "models.h"
#include "scene/data_of_scene.h"
#include "scene/gltf/builder.h"
#include "scene/texture_from_data.h"

namespace defocus::engine {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Data of a scene with a square in the plane z = 0, two textures, a camera and a light. Each test changes one part of
// the data.
struct Square {
    std::vector<std::array<float, 3>> positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    std::vector<std::array<float, 3>> normals;
    std::vector<std::array<float, 2>> uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    std::vector<std::array<float, 4>> colors;
    std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    Image picture = Image(2, 2, 3);
    Image bumps = Image(2, 2, 3);
    MaterialData material{.name = "Paint", .baseColorTexture = 0, .normalTexture = 1};
    TextureData colorTexture{.name = "Picture"};
    TextureData dataTexture{.name = "Bumps", .content = TextureContent::data};
    InstanceData instance{.name = "Left"};
    CameraData camera{.name = "Main"};
    LightData light{.name = "Lamp", .type = LightType::spot};
    double metresPerUnit = 1;
    int meshMaterial = 0;

    Square() {
        picture.pixels = {0, 0.25f, 0.5f, 1, 0.125f, 0.75f, 0.5f, 0.5f, 0.5f, 0, 0, 1};
        bumps.pixels = {0.5f, 0.5f, 1, 0.75f, 0.5f, 1, 0.5f, 0.75f, 1, 0.5f, 0.5f, 1};
        colorTexture.image = picture;
        dataTexture.image = bumps;
    }

    [[nodiscard]] Scene build() const {
        const MeshData meshes[] = {{"Body", positions, normals, uvs, colors, indices, meshMaterial}};
        const TextureData textures[] = {colorTexture, dataTexture};
        return sceneFromData({"Room", meshes, std::span(&material, 1), textures, std::span(&instance, 1),
                              std::span(&camera, 1), std::span(&light, 1), metresPerUnit});
    }
};

void expectSameMeshes(const Scene& scene, const Scene& wanted) {
    ASSERT_EQ(scene.meshes.size(), wanted.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Vertices& a = scene.meshes[i].vertices;
        const Vertices& b = wanted.meshes[i].vertices;
        EXPECT_EQ(a.positions, b.positions);
        EXPECT_EQ(a.normals, b.normals);
        EXPECT_EQ(a.tangents, b.tangents);
        EXPECT_EQ(a.uv0, b.uv0);
        EXPECT_EQ(a.colors, b.colors);
        ASSERT_EQ(scene.meshes[i].primitives.size(), wanted.meshes[i].primitives.size());
        for (std::size_t k = 0; k < scene.meshes[i].primitives.size(); ++k)
            EXPECT_EQ(scene.meshes[i].primitives[k].indices, wanted.meshes[i].primitives[k].indices);
    }
}

TEST(SceneFromData, meshesAreFinishedAsThoseOfFiles) {
    // The glTF file has the same arrays as the data. Both scenes need computed attributes: tangents for the normal map,
    // and flat normals for a mesh without normals.
    const ScratchFolder folder;
    Image blank(2, 2, 3);
    writeImage(folder / "blank.png", blank);
    for (const bool withNormals : {false, true}) {
        Square square;
        square.positions.push_back({7, 7, 7});  // an unused vertex
        square.uvs.push_back({0, 0});
        square.positions[2][2] = 0.5f;  // the triangles are not coplanar
        if (withNormals) square.normals.assign(5, {0, 0, 3});
        const auto floats = [](const auto& rows) {
            std::vector<float> result;
            for (const auto& row : rows) result.insert(result.end(), row.begin(), row.end());
            return result;
        };
        GltfBuilder builder;
        nlohmann::json attributes = {{"POSITION", builder.positions(floats(square.positions))},
                                     {"TEXCOORD_0", builder.floats(floats(square.uvs), "VEC2", 2)}};
        if (withNormals) attributes["NORMAL"] = builder.positions(floats(square.normals));
        builder.mesh({{{"attributes", attributes}, {"indices", builder.indices({0, 1, 2, 0, 2, 3})}, {"material", 0}}});
        builder.add("images", {{"uri", "blank.png"}});
        builder.add("textures", {{"source", 0}});
        builder.add("materials", {{"normalTexture", {{"index", 0}}}});
        GltfBuilder::save(folder / "square.glb", builder.glb());
        const Scene wanted = loadGltf(folder / "square.glb");
        const Scene scene = square.build();
        EXPECT_FALSE(scene.meshes.at(0).vertices.tangents.empty());
        EXPECT_EQ(scene.meshes[0].vertices.count(), withNormals ? 4u : 6u);
        expectSameMeshes(scene, wanted);
    }
}

TEST(SceneFromData, aLoadedSceneCanBeBuiltAgain) {
    for (const char* name : {"Unicode❤♻Test.glb", "NegativeScaleTest.glb", "meshes/bokeh.gltf", "meshes/fish.glb"}) {
        SCOPED_TRACE(name);
        const Scene wanted = loadGltf(modelPath(name));
        const DataOfScene memory(wanted);
        const Scene scene = sceneFromData(memory.data());
        expectSameMeshes(scene, wanted);
        ASSERT_EQ(scene.images.size(), wanted.images.size());
        for (std::size_t i = 0; i < scene.images.size(); ++i) EXPECT_EQ(scene.images[i].rgba, wanted.images[i].rgba);
        EXPECT_EQ(scene.cameras.size(), wanted.cameras.size());
        const Pose pose = poseAt(scene, 0);
        const Pose wantedPose = poseAt(wanted, 0, -1);
        ASSERT_EQ(pose.objects.size(), wantedPose.objects.size());
        EXPECT_EQ(pose.bounds.minimum, wantedPose.bounds.minimum);
        EXPECT_EQ(pose.bounds.maximum, wantedPose.bounds.maximum);
    }
}

TEST(SceneFromData, partsKeepTheirNamesAndValues) {
    Square square;
    square.metresPerUnit = 0.01;
    square.instance.name.clear();
    square.camera.focusDistance = 250;
    square.light.intensity = 30;
    const Scene scene = square.build();
    EXPECT_EQ(scene.name, "Room");
    ASSERT_EQ(scene.nodes.size(), 3u);
    EXPECT_EQ(scene.nodes[0].name, "Body") << "an instance without a name has the mesh's";
    EXPECT_EQ(scene.nodes[1].name, "Main");
    EXPECT_EQ(scene.nodes[2].name, "Lamp");
    EXPECT_EQ(scene.imageNames, (std::vector<std::string>{"Picture", "Bumps"}));
    EXPECT_EQ(scene.ownMetresPerUnit, 0.01);
    EXPECT_EQ(scene.cameras.at(0).lensValue("focusDistance"), 250);
    EXPECT_EQ(scene.lights.at(0).type, LightType::spot);
    EXPECT_EQ(scene.lights.at(0).intensity, 30);
    EXPECT_TRUE(scene.materials.at(0).normal.used());
    EXPECT_TRUE(scene.ignored.empty());
}

TEST(SceneFromData, positionsInThreesNeedNoIndices) {
    Square square;
    square.indices.clear();
    square.positions.pop_back();
    square.uvs.pop_back();
    EXPECT_EQ(square.build().meshes.at(0).triangleCount(), 1u);
}

TEST(SceneFromData, normalsOfNoLengthAreReplacedWithANote) {
    Square square;
    square.normals.assign(4, {0, 0, 0});
    const Scene scene = square.build();
    EXPECT_EQ(scene.meshes.at(0).vertices.normals.at(0), glm::vec3(0, 0, 1));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].count, 4u);
}

TEST(SceneFromData, texturesAreEncodedAsFilesStoreThem) {
    Image image(2, 1, 4);
    image.pixels = {0.25f, 0.125f, 0, 0.5f, 0, 0, 0, 0};
    const auto bytes = [&](TextureContent content, bool straight) {
        return textureImage({.image = image, .content = content, .straightAlpha = straight}, "texture 0").rgba;
    };
    const auto encoded = [](float value) { return static_cast<std::uint8_t>(std::lround(255 * srgbEncode(value))); };
    EXPECT_EQ(bytes(TextureContent::color, false),
              (std::vector<std::uint8_t>{encoded(0.5f), encoded(0.25f), 0, 128, 0, 0, 0, 0}));
    EXPECT_EQ(bytes(TextureContent::color, true),
              (std::vector<std::uint8_t>{encoded(0.25f), encoded(0.125f), 0, 128, 0, 0, 0, 0}));
    EXPECT_EQ(bytes(TextureContent::data, false), (std::vector<std::uint8_t>{64, 32, 0, 128, 0, 0, 0, 0}));

    Image grey(1, 1, 1);
    grey.pixels = {1};
    EXPECT_EQ(textureImage({.image = grey, .content = TextureContent::data}, "texture 0").rgba,
              (std::vector<std::uint8_t>{255, 255, 255, 255}));
    // Values slightly outside [0, 1] are rounding errors and are clamped.
    grey.pixels = {1.001f};
    EXPECT_EQ(textureImage({.image = grey}, "texture 0").rgba[0], 255);

    // Every byte of both encodings, sRGB and linear, survives the conversion to linear floats and back.
    Image all(256, 1, 1);
    for (const TextureContent content : {TextureContent::color, TextureContent::data}) {
        for (std::size_t i = 0; i < 256; ++i) {
            const float value = static_cast<float>(i) / 255;
            all.pixels[i] = content == TextureContent::color ? srgbDecode(value) : value;
        }
        const TextureImage texture = textureImage({.image = all, .content = content}, "texture 0");
        for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(texture.rgba[4 * i], i);
    }
}

struct Fault {
    const char* message;
    std::function<void(Square&)> change;
};

TEST(SceneFromData, invalidDataIsRefusedWithItsName) {
    const Fault faults[] = {
        {"mesh 'Body' (0): it has no positions", [](Square& s) { s.positions.clear(); }},
        {"mesh 'Body' (0): positions[1] is not finite (NaN or infinite)", [](Square& s) { s.positions[1][2] = nan; }},
        {"mesh 'Body' (0): uvs[3] is not finite (NaN or infinite)", [](Square& s) { s.uvs[3][0] = nan; }},
        {"mesh 'Body' (0): it has 3 normals for 4 positions; give one for each position, or none",
         [](Square& s) { s.normals.resize(3); }},
        {"mesh 'Body' (0): it has 5 uvs for 4 positions; give one for each position, or none",
         [](Square& s) { s.uvs.resize(5); }},
        {"mesh 'Body' (0): it has 1 colors for 4 positions; give one for each position, or none",
         [](Square& s) { s.colors.resize(1); }},
        {"mesh 'Body' (0): colors[2] is 1.5; colours must be from 0 to 1",
         [](Square& s) {
             s.colors.resize(4);
             s.colors[2][1] = 1.5f;
         }},
        {"mesh 'Body' (0): index 17 is out of range for 4 vertices", [](Square& s) { s.indices[4] = 17; }},
        {"mesh 'Body' (0): it has 5 indices, not a multiple of 3; each triangle needs three",
         [](Square& s) { s.indices.pop_back(); }},
        {"mesh 'Body' (0): it has 4 positions, not a multiple of 3; each triangle needs three",
         [](Square& s) { s.indices.clear(); }},
        {"mesh 'Body' (0): there is no material 3; the scene has 1", [](Square& s) { s.meshMaterial = 3; }},
        {"mesh 'Body' (0): there is no material -2; the scene has 1", [](Square& s) { s.meshMaterial = -2; }},
        {"mesh 'Body' (0): its material 0 has textures, but the mesh has no uvs", [](Square& s) { s.uvs.clear(); }},
        {"material 'Paint' (0): there is no texture 2; the scene has 2",
         [](Square& s) { s.material.occlusionTexture = 2; }},
        {"material 'Paint' (0): texture 1 holds data; as emissionTexture it must hold colours",
         [](Square& s) { s.material.emissionTexture = 1; }},
        {"material 'Paint' (0): texture 0 holds colours; as normalTexture it must hold data",
         [](Square& s) { s.material.normalTexture = 0; }},
        {"material 'Paint' (0): baseColor is -1; it must be from 0 to 1",
         [](Square& s) { s.material.baseColor[3] = -1; }},
        {"material 'Paint' (0): metallic is 2; it must be from 0 to 1", [](Square& s) { s.material.metallic = 2; }},
        {"material 'Paint' (0): roughness is nan; it must be from 0 to 1",
         [](Square& s) { s.material.roughness = nan; }},
        {"material 'Paint' (0): emission is -0.5; it must be a finite number of at least 0",
         [](Square& s) { s.material.emission[1] = -0.5f; }},
        {"material 'Paint' (0): ior is 0.5; it must be a finite number of at least 1",
         [](Square& s) { s.material.ior = 0.5f; }},
        {"material 'Paint' (0): transmission is 1.5; it must be from 0 to 1",
         [](Square& s) { s.material.transmission = 1.5f; }},
        {"material 'Paint' (0): attenuationDistance is 0; it must be above 0",
         [](Square& s) { s.material.attenuationDistance = 0; }},
        {"material 'Paint' (0): alphaMode has no value 7",
         [](Square& s) { s.material.alphaMode = static_cast<AlphaMode>(7); }},
        {"texture 'Picture' (0): its image has no pixels (0 × 0)", [](Square& s) { s.colorTexture.image = {}; }},
        {"texture 'Picture' (0): its image has 2 channels; give 1, 3 or 4",
         [](Square& s) { s.colorTexture.image.channels = 2; }},
        {"texture 'Bumps' (1): an image of 2 × 9 pixels with 3 channels needs more than the 12 values given",
         [](Square& s) { s.dataTexture.image.height = 9; }},
        {"texture 'Picture' (0): channel 1 of pixel (1, 0) is -1; textures hold values from 0 to 1",
         [](Square& s) { s.picture.at(1, 0)[1] = -1; }},
        {"texture 'Bumps' (1): channel 0 of pixel (0, 1) is nan; textures hold values from 0 to 1",
         [](Square& s) { s.bumps.at(0, 1)[0] = nan; }},
        {"instance 'Left' (0): there is no mesh 1; the scene has 1", [](Square& s) { s.instance.mesh = 1; }},
        {"instance 'Left' (0): there is no mesh -1", [](Square& s) { s.instance.mesh = -1; }},
        {"instance 'Left' (0): its transform is not finite (NaN or infinite)",
         [](Square& s) { s.instance.transform[5] = infinity; }},
        {"instance 'Left' (0): the last row of its transform is 2, 0, 0, 1 instead of 0, 0, 0, 1; matrices are "
         "column-major",
         [](Square& s) { s.instance.transform[3] = 2; }},
        {"camera 'Main' (0): yfov is 4; it must be between 0 and π radians", [](Square& s) { s.camera.yfov = 4; }},
        {"camera 'Main' (0): znear is 0; it must be a finite number above 0", [](Square& s) { s.camera.znear = 0; }},
        {"camera 'Main' (0): focusDistance is -1; it must be a finite number above 0",
         [](Square& s) { s.camera.focusDistance = -1; }},
        {"light 'Lamp' (0): intensity is -3; it must be a finite number of at least 0",
         [](Square& s) { s.light.intensity = -3; }},
        {"light 'Lamp' (0): a cone from 1 to 0.5 radians is impossible; angles are 0 ≤ inner < outer ≤ π/2",
         [](Square& s) {
             s.light.innerConeAngle = 1;
             s.light.outerConeAngle = 0.5f;
         }},
        {"light 'Lamp' (0): its transform is not finite (NaN or infinite)",
         [](Square& s) { s.light.transform[12] = std::numeric_limits<double>::quiet_NaN(); }},
        {"the scene: metresPerUnit is 0; it must be from 1e-09 to 1000000000", [](Square& s) { s.metresPerUnit = 0; }},
    };
    for (const Fault& fault : faults) {
        Square square;
        fault.change(square);
        EXPECT_EQ(messageOf<UsageError>([&] { static_cast<void>(square.build()); }), fault.message);
    }
    Square square;
    square.instance.name.clear();
    square.instance.mesh = 4;
    EXPECT_EQ(messageOf<UsageError>([&] { static_cast<void>(square.build()); }),
              "instance 0: there is no mesh 4; the scene has 1");
    square = {};
    square.light.name = "two\nlines";
    square.light.range = -1;
    EXPECT_EQ(messageOf<UsageError>([&] { static_cast<void>(square.build()); }),
              "light 'two lines' (0): range is -1; it must be a finite number of at least 0");
    EXPECT_EQ(messageOf<UsageError>([] { static_cast<void>(sceneFromData({})); }),
              "the scene is empty; add an instance of a mesh");
}

TEST(SceneFromData, straightAlphaIsNotTakenForPremultiplied) {
    Image image(1, 1, 4);
    image.pixels = {1, 0, 0, 0.25f};
    const std::string message =
        messageOf<UsageError>([&] { static_cast<void>(textureImage({.image = image}, "texture 0")); });
    EXPECT_EQ(message,
              "texture 0: the colour 1 of pixel (0, 0) exceeds its alpha 0.25; premultiply the colours, or set "
              "straightAlpha");
}

}  // namespace
}  // namespace defocus::engine
