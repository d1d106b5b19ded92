// Tests cut-out and alpha-blended surfaces in both lens-space methods.

#include "likeness.h"
#include "render/lens_space/lens_space_images.h"

namespace defocus::engine {
namespace {

using SeeThroughSurfaces = LensSpace;

// Returns blended panes one behind another, all in one mesh, in front of a uniform background of radiance 1.
std::unique_ptr<SmallWorld> panes(int count, float alpha) {
    auto small = std::make_unique<SmallWorld>();
    Material pane = unlitMaterial({0, 0, 0, alpha});
    pane.alphaMode = AlphaMode::blend;
    small->scene.materials.push_back(pane);
    Mesh mesh = quad(0);
    const std::vector<glm::vec3> corners = mesh.vertices.positions;
    const std::vector<std::uint32_t> indices = mesh.primitives[0].indices;
    for (int i = 1; i < count; ++i) {
        for (const glm::vec3& corner : corners) mesh.vertices.positions.push_back(corner - glm::vec3(0, 0, i));
        for (const std::uint32_t index : indices)
            mesh.primitives[0].indices.push_back(index +
                                                 static_cast<std::uint32_t>(corners.size()) * static_cast<unsigned>(i));
    }
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 0, 1});
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -2}), glm::dvec3(20, 20, 1)));
    small->world.environment = {EnvironmentType::uniform, {1, 1, 1}, {}, {}, nullptr, 1};
    small->view.width = small->view.height = 24;
    small->view.lens.fStop = 1;
    finish(*small);
    return small;
}

// n black panes of opacity α let the fraction (1 − α)ⁿ of the background through.
TEST_P(SeeThroughSurfaces, panesLetTheirShareOfLightThrough) {
    for (const int count : {1, 3}) {
        const Image image = lensSpaceImage(GetParam(), *panes(count, 0.4f), 32);
        EXPECT_NEAR(meanRed(image), std::pow(0.6, count), 0.01) << count;
        EXPECT_EQ(image.at(12, 12)[3], 1.0f);
    }
}

// Alpha grows from left to right. The surface is visible only where alpha reaches the cutoff.
TEST_P(SeeThroughSurfaces, cutOutsEndWhereAlphaReachesTheCutoff) {
    const auto small = groundUnderCamera();
    Mesh& mesh = small->scene.meshes[0];
    for (std::size_t i = 0; i < mesh.vertices.colors.size(); ++i)
        mesh.vertices.colors[i].a = mesh.vertices.positions[i].x > 0 ? 1.0f : 0.0f;
    finish(*small);
    const Image whole = lensSpaceImage(GetParam(), *small, 16);
    small->scene.materials[0].alphaMode = AlphaMode::mask;
    small->scene.materials[0].alphaCutoff = 0.5f;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    const Image cut = lensSpaceImage(GetParam(), *small, std::string(GetParam()) == "line" ? 40 : 256);
    EXPECT_GE(psnrAgainst(reference, cut), 36);
    EXPECT_LT(psnrAgainst(reference, whole), 25);
}

INSTANTIATE_TEST_SUITE_P(Methods, SeeThroughSurfaces, testing::Values("stochastic", "line"));

}  // namespace
}  // namespace defocus::engine
