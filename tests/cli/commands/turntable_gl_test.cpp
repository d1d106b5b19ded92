// Tests that each cell of `defocus pyramid --turntable` shows the level that its label names.

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "cli/commands/turntable.h"
#include "cli/program.h"
#include "core/error.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "lod/shapes.h"
#include "scene/gltf/write.h"

namespace defocus::engine {
namespace {

constexpr std::array<double, 4> radii = {1, 0.8, 0.55, 0.3};  // radius of each level in m

// A pyramid of white unlit spheres on an empty background, each level with a smaller radius than the previous one.
struct ShrinkingSphere {
    ShrinkingSphere() {
        Mesh mesh = sphere(96, 48);
        mesh.primitives.front().material = 0;
        scene.meshes.push_back(mesh);
        scene.materials.emplace_back().unlit = true;
        Pyramid pyramid = fullDetail(mesh);
        for (std::size_t l = 1; l < radii.size(); ++l) {
            PyramidLevel& level = pyramid.levels.emplace_back(pyramid.levels.front());
            level.clusters.clear();
            level.error = 1 - radii[l];
            for (glm::vec3& position : level.positions) position *= static_cast<float>(radii[l]);
        }
        world.scene = owned;
        world.environment.type = EnvironmentType::none;
        world.pyramids.push_back(std::move(pyramid));
        object.mesh = 0;
    }
    std::shared_ptr<Scene> owned = std::make_shared<Scene>();
    Scene& scene = *owned;
    World world;
    Object object;
};

// Returns the number of pixels that the object covers in the cell. Pixels of the object have the value 1; the cell's
// corner has the background's value.
double coverage(const Image& image, const TurntableCell& cell) {
    const double paper = image.at(cell.x, cell.y)[0];
    double sum = 0;
    for (int y = 0; y < cell.height; ++y)
        for (int x = 0; x < cell.width; ++x) sum += (double{image.at(cell.x + x, cell.y + y)[0]} - paper) / (1 - paper);
    return sum;
}

TEST(Turntable, CellsShowTheLevelsAsLargeAsTheyAre) {
    std::unique_ptr<GlContext> context;
    try {
        context = createHeadlessContext();
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    ShrinkingSphere subject;
    const View view = turntableView(subject.scene.meshes[0], subject.object).view;
    const TurntableSheet sheet = turntableSheet(subject.world, subject.object, "sphere");
    ASSERT_EQ(sheet.cells.size(), radii.size());
    // A sphere of radius r at distance d projects to a disk. The tangent of the disk's angular radius is r / √(d² −
    // r²).
    const double distance = glm::length(glm::dvec3(view.worldFromCamera[3]));
    const double pixels = view.width / (2 * tanHalfHorizontalFov(view.lens));
    for (std::size_t l = 0; l < radii.size(); ++l)
        for (const TurntableCell& cell : sheet.cells[l]) {
            const double radius = pixels * radii[l] / std::sqrt(distance * distance - radii[l] * radii[l]);
            const double disk = std::numbers::pi * radius * radius;
            EXPECT_NEAR(coverage(sheet.image, cell), disk, 0.01 * disk) << "level " << l;
            EXPECT_LT(2 * radius, 0.95 * std::min(cell.width, cell.height));
        }
}

// The turntable shows an object from every side without cropping it. Seen from 60° off its normal, the width of a
// square board shrinks by the cosine.
TEST(TurntableView, FramesTheObjectFromEverySide) {
    Mesh mesh = flatGrid(4);
    for (glm::vec3& position : mesh.vertices.positions) position = 7.0f * position + glm::vec3(1e4f, -20, 3);
    Object object;
    object.mesh = 0;
    const TurntableView look = turntableView(mesh, object);
    ASSERT_EQ(look.worldTurn.size(), static_cast<std::size_t>(turntableViews));
    const double tangent = tanHalfHorizontalFov(look.view.lens);
    double widest = 0;
    for (const glm::dmat4& turn : look.worldTurn)
        for (const glm::vec3& position : mesh.vertices.positions) {
            const glm::dvec4 p = glm::inverse(look.view.worldFromCamera) * turn * glm::dvec4(position, 1);
            ASSERT_GT(-p.z, look.view.nearPlane);
            const double x = std::abs(p.x) / (-p.z * tangent);
            const double y = std::abs(p.y) / (-p.z * tangent) * look.view.width / look.view.height;
            widest = std::max({widest, x, y});
        }
    EXPECT_LE(widest, 0.9 + 1e-9);
    EXPECT_GT(widest, 0.89);
}

class TurntableCommand : public ProgramTest {};

TEST_F(TurntableCommand, WritesASheetForEachMesh) {
    Mesh mesh = sphere(12, 6);
    mesh.name = "Ball";
    writeGlb(folder() / "ball.glb", mesh);
    const Outcome outcome = run({"--quiet", "pyramid", "ball.glb", "--no-measure", "--turntable", "sheet.png"});
    if (outcome.exitCode != 0 && outcome.err.find("EGL") != std::string::npos) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("sheet.png"), std::string::npos);
    const Image sheet = readImage(folder() / "sheet.png");
    EXPECT_GT(sheet.width, turntableViews * 200);
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(TurntableCommand, FaultsAreOneLineBeforeTheWork) {
    writeGlb(folder() / "ball.glb", sphere(12, 6));
    expectOneLine(run({"--quiet", "pyramid", "ball.glb", "--turntable", "sheet.txt"}), 1);
    expectOneLine(run({"--quiet", "pyramid", "ball.glb", "--turntable", "nowhere/sheet.png"}), 1);
    expectOneLine(run({"--quiet", "pyramid", "nothing.glb", "--turntable", "sheet.png"}), 1);
    EXPECT_EQ(fileCount(), 1u);
}

}  // namespace
}  // namespace defocus::engine
