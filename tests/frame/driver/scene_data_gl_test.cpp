// Tests rendered images of scenes that are built from arrays in memory instead of files.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "models.h"
#include "scene/data_of_scene.h"
#include "scene/gltf/gltf.h"

namespace defocus::engine {
namespace {

class SceneDataImage : public OwnContextTest {};
class SceneOfFile : public OwnContextTest, public testing::WithParamInterface<const char*> {};

Request memoryRequest() {
    Request request;
    request.size = {96, 72};
    request.samples = 8;
    request.lens.fStop = 0.5;
    request.units = 1;
    request.noCache = true;
    return request;
}

TEST_P(SceneOfFile, rendersWithTheSameBitsFromMemory) {
    const std::filesystem::path path = modelPath(GetParam());
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    const auto loaded = std::make_unique<engine::Scene>(loadGltf(path));
    auto memory = std::make_unique<DataOfScene>(*loaded);
    const defocus::Scene scene = defocus::Scene::create(memory->data());
    memory.reset();  // frees the caller's data, which the scene has copied
    const Image wanted = SceneRenderer(defocus::Scene::load(path), memoryRequest()).render();
    const Image image = SceneRenderer(scene, memoryRequest()).render();
    EXPECT_EQ(image.pixels, wanted.pixels);
    EXPECT_GT(std::set<float>(image.pixels.begin(), image.pixels.end()).size(), 10u);  // the image is not empty
}

// Together, the files contain textures, mirrored instances, a camera, unlit materials, vertex colours and a normal map.
INSTANTIATE_TEST_SUITE_P(, SceneOfFile,
                         testing::Values("Unicode❤♻Test.glb", "NegativeScaleTest.glb", "meshes/bokeh.gltf",
                                         "meshes/fish.glb", "khronos/NormalTangentTest.glb"),
                         [](const auto& model) { return testNameOf(model.param); });

TEST_F(SceneDataImage, aSquareCoversItsPixels) {
    // At distance 2, the image of 64 × 64 px is 2 units high and wide, so a pixel is 1/32 wide.
    const std::array<float, 3> corners[] = {
        {-0.5f, -0.25f, -2}, {0.25f, -0.25f, -2}, {0.25f, 0.5f, -2}, {-0.5f, 0.5f, -2}};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    const MaterialData materials[] = {{.name = "Red", .baseColor = {0.5f, 0.25f, 0.125f, 1}, .unlit = true}};
    const MeshData meshes[] = {{.name = "Square", .positions = corners, .indices = triangles, .material = 0}};
    const InstanceData instances[] = {{.name = "Wall", .mesh = 0}};
    const CameraData cameras[] = {{.name = "Main", .yfov = 2 * std::atan(0.5)}};
    Request request = memoryRequest();
    request.size = {64, 64};
    request.background = TransparentBackground{};
    request.lens.dofEnabled = false;
    const Image image =
        SceneRenderer(defocus::Scene::create(
                          {.meshes = meshes, .materials = materials, .instances = instances, .cameras = cameras}),
                      request)
            .render();
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool covered = x >= 16 && x < 40 && y >= 16 && y < 40;
            const std::vector<float> wanted =
                covered ? std::vector<float>{0.5f, 0.25f, 0.125f, 1} : std::vector<float>(4);
            const float* const pixel = image.at(x, y);
            EXPECT_EQ(std::vector<float>(pixel, pixel + 4), wanted) << x << ", " << y;
        }
}

TEST_F(SceneDataImage, texturesKeepTheirColours) {
    // The square shows a texture of two texels, side by side, without filtering.
    const std::array<float, 3> corners[] = {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}};
    const std::array<float, 2> uvs[] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    Image picture(2, 1, 3);
    picture.pixels = {1, 0.5f, 0.02f, 0, 0.2f, 0.8f};
    const TextureData textures[] = {{.image = picture, .magnification = TextureFilter::nearest}};
    const MaterialData materials[] = {{.baseColorTexture = 0, .unlit = true}};
    const MeshData meshes[] = {{.positions = corners, .uvs = uvs, .indices = triangles, .material = 0}};
    const InstanceData instances[] = {{.mesh = 0}};
    const CameraData cameras[] = {{.yfov = 2 * std::atan(0.5)}};
    Request request = memoryRequest();
    request.size = {32, 32};
    request.lens.dofEnabled = false;
    const Image image = SceneRenderer(defocus::Scene::create({.meshes = meshes,
                                                              .materials = materials,
                                                              .textures = textures,
                                                              .instances = instances,
                                                              .cameras = cameras}),
                                      request)
                            .render();
    for (const int column : {3, 28})
        for (int c = 0; c < 3; ++c) {
            const float wanted = picture.at(column / 16, 0)[c];
            EXPECT_NEAR(image.at(column, 12)[c], wanted, 0.01f * wanted + 1e-3f) << column << " channel " << c;
        }
}

TEST_F(SceneDataImage, scenesWithoutCamerasAndLightsAreFramedAndLit) {
    const std::array<float, 3> corners[] = {{-0.2f, -0.2f, 0}, {0.2f, -0.2f, 0}, {0, 0.2f, -0.2f}};
    const MeshData meshes[] = {{.name = "Sail", .positions = corners}};
    const InstanceData instances[] = {{.mesh = 0}};
    const defocus::Scene scene = defocus::Scene::create({.name = "Sea", .meshes = meshes, .instances = instances});
    EXPECT_EQ(scene.info().name, "Sea");
    EXPECT_EQ(scene.info().nodes, std::vector<std::string>{"Sail"});
    EXPECT_EQ(scene.info().triangles, 1u);
    Request request = memoryRequest();
    request.units.reset();
    SceneRenderer renderer(scene, request);
    const Image image = renderer.render();
    EXPECT_GT(image.at(48, 40)[1], 0.05f);
    EXPECT_TRUE(renderer.warnings().empty()) << renderer.warnings().front();
}

}  // namespace
}  // namespace defocus::engine
