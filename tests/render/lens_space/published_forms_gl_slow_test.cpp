// Tests the lens-space methods with the settings of the papers that introduced them, and with alternative settings.

#include <set>

#include "likeness.h"
#include "render/lens_space/lens_space_images.h"
#include "render/line/line_sets.h"

namespace defocus::engine {
namespace {

using CocInterpolation = LensSpace;

// Returns planks of two long triangles each that lead from beside the camera into the distance.
std::unique_ptr<SmallWorld> planks() {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh;
    mesh.name = "planks";
    Primitive primitive{0, {}};
    for (const int i : {-1, 1}) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.positions.size());
        const float x = 0.3f * static_cast<float>(i);
        for (const float z : {-1.0f, -9.0f})
            for (const float side : {0.0f, 0.12f}) mesh.vertices.positions.emplace_back(x + side, -0.3f, z);
        for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) primitive.indices.push_back(first + corner);
    }
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 1, 0});
    mesh.primitives.push_back(primitive);
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::dmat4(1));
    small->world.environment.type = EnvironmentType::none;
    small->view.width = 48;
    small->view.height = 36;
    small->view.lens.fStop = 0.3;
    small->view.lens.focusDistance = 1.5;
    finish(*small);
    return small;
}

// A focus range makes the circle of confusion C nonlinear inside the planks' triangles. Dividing the triangles
// reproduces the image of method "accumulation"; linear interpolation of C between the corners does not.
TEST_P(CocInterpolation, bendsOnlyInDividedTriangles) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = planks();
    small->view.lens.focusRangeFront = 0.2;
    small->view.lens.focusRangeBehind = 3;
    const std::string method = GetParam();
    const std::uint32_t rays = method == "line" ? 8 : 32;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(256)));
    const double divided = psnrAgainst(reference, lensSpaceImage(GetParam(), *small, rays));
    const double linear =
        psnrAgainst(reference, lensSpaceImage((method + ":coc-interpolation=linear").c_str(), *small, rays));
    EXPECT_GE(divided, 30);
    EXPECT_LT(linear, divided - 6);
}
INSTANTIATE_TEST_SUITE_P(Methods, CocInterpolation, testing::Values("stochastic", "line"));

// The scene does not change along y, so pixels of a column differ only by their sample points.
TEST_F(LensSpaceAlone, stochasticPixelsHaveTheirOwnPoints) {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh = quad(0);
    mesh.vertices.colors.clear();
    for (const glm::vec3& position : mesh.vertices.positions)
        mesh.vertices.colors.emplace_back(position.x > 0 ? 1.0f : 0.0f, 0, 0, 1);
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -4}), glm::dvec3(4, 400, 1)));
    small->view.width = 4;
    small->view.height = 256;
    small->view.lens.fStop = 0.5;
    small->view.lens.focusDistance = 1;
    finish(*small);
    const Image image = lensSpaceImage("stochastic", *small, 4);
    std::set<float> values;
    for (int y = 0; y < image.height; ++y) values.insert(image.at(2, y)[0]);
    EXPECT_GT(values.size(), 200u);  // if pixels shared 64 sets of sample points, they would have at most 64 colours
}

// Returns twoSpheres(), one of which moves during the exposure.
std::unique_ptr<SmallWorld> movingSpheres(bool doubleSided) {
    auto small = twoSpheres();
    small->scene.materials[0].doubleSided = doubleSided;
    small->world.shutter.poses.assign(2, small->world.pose);
    small->world.shutter.poses[0].objects[0].worldFromObject =
        glm::scale(glm::translate(glm::dmat4(1), {-0.3, -0.1, -1.4}), glm::dvec3(0.2));
    return small;
}

// Triangles that face away from the entire lens during the entire exposure are culled before visibility is computed.
// The image does not change.
TEST_F(LensSpaceAlone, movingBacksAreCulled) {
    RenderStats front, both;
    const Image culled = lensSpaceImage("stochastic", *movingSpheres(false), 16, &front);
    const Image complete = lensSpaceImage("stochastic", *movingSpheres(true), 16, &both);
    EXPECT_LT(figureOf(front, "triangles in all tiles"), 0.75 * figureOf(both, "triangles in all tiles"));
    EXPECT_GE(psnrAgainst(complete, culled), 60);
}

// Method "stochastic" supports astigmatism and coma, under which the circle of confusion depends on the lens point.
TEST_F(LensSpaceAlone, stochasticPointsSeeAberrations) {
    const auto small = twoSpheres();
    const Image plain = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    small->view.lens.astigmatism = 2;
    small->view.lens.coma = 2;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    const double psnr = psnrAgainst(reference, lensSpaceImage("stochastic", *small, 256));
    EXPECT_GE(psnr, 38);
    EXPECT_LT(psnrAgainst(reference, plain), psnr - 6);
    expectRefusal("line", *small, "astigmatism and coma");
}

// Returns a small bright quad far out of focus, whose image is a disk.
std::unique_ptr<SmallWorld> brightSpot() {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({3000, 3000, 3000, 1})};
    small->scene.meshes = {quad(0)};
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -6}), glm::dvec3(0.03)));
    small->world.environment.type = EnvironmentType::none;
    small->view.width = small->view.height = 64;
    small->view.lens.fStop = 0.05;
    small->view.lens.focusDistance = 1.5;
    finish(*small);
    return small;
}

// Returns the mean radiance near the disk's centre, divided by the mean radiance farther out.
double middleOverRim(const Image& image) {
    double sums[2] = {0, 0};
    double counts[2] = {0, 0};
    double energy = 0;
    double moment = 0;
    const auto radiusAt = [&](int x, int y) {
        return std::hypot(x + 0.5 - image.width / 2.0, y + 0.5 - image.height / 2.0);
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            energy += image.at(x, y)[0];
            moment += image.at(x, y)[0] * radiusAt(x, y) * radiusAt(x, y);
        }
    const double radius = std::sqrt(2 * moment / energy);  // radius of a uniform disk
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double at = radiusAt(x, y) / radius;
            if (at > 0.85) continue;
            const int ring = at < 0.4 ? 0 : 1;
            sums[ring] += image.at(x, y)[0];
            ++counts[ring];
        }
    return sums[0] / counts[0] / (sums[1] / counts[1]);
}

// The factor κ weights the segments of lens lines, because the lines are denser near the lens's centre. With κ, a
// blurred point is a uniform disk. Without κ, the disk's centre is brighter (Figure 4 of Tzeng et al. 2012).
TEST_F(LensSpaceAlone, kappaMakesDisksUniform) {
    const auto small = brightSpot();
    EXPECT_NEAR(middleOverRim(lensSpaceImage("line", *small, 64)), 1, 0.15);
    EXPECT_GT(middleOverRim(lensSpaceImage("line:line-weights=length", *small, 64)), 1.5);
}

// Several lens lines share a position in the pixel (Figure 2 of Tzeng et al. 2012).
TEST_F(LensSpaceAlone, linesShareSpatialPositions) {
    const auto small = twoSpheres();
    const FramePlan plan = planFrame(small->world, small->view, raySettings(16));
    for (const std::uint32_t perPosition : {1u, 4u}) {
        const LineSets lines = lineSets(plan, false, perPosition);
        std::set<std::pair<float, float>> positions;
        std::set<std::pair<float, float>> directions;
        for (const GpuRay& ray : lines.sets.table) {
            positions.insert({ray.lensAndPixel.z, ray.lensAndPixel.w});
            directions.insert({ray.lensAndPixel.x, ray.lensAndPixel.y});
        }
        EXPECT_EQ(positions.size(), 16 / perPosition);
        EXPECT_EQ(directions.size(), 16u);
    }
}

// If the two ends of a segment of a lens line are stored in 8 bits each, they move by at most 1/510 of the line's
// length.
TEST_F(LensSpaceAlone, shortIntervalsChangeLittle) {
    const auto small = twoSpheres();
    const Image full = lensSpaceImage("line:resolve=published", *small, 16);
    const Image compact = lensSpaceImage("line:resolve=published,interval-bits=16", *small, 16);
    EXPECT_GT(largestDifference(full, compact), 1e-5);
    EXPECT_GE(psnrAgainst(full, compact), 40);
}

// A bin is a list of fixed size that keeps the nearest triangles of a tile and counts those that do not fit.
TEST_F(LensSpaceAlone, binsOfFixedSizeCountTheirOverflow) {
    const std::uint32_t side = 20;
    const auto small = gridInATile(side);
    RenderStats stats;
    const Image image = lensSpaceImage("line:bin-size=100", *small, 4, &stats);
    EXPECT_EQ(figureOf(stats, "triangles beyond the size of a bin"), 2 * side * side - 100);
    double covered = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) covered += image.at(x, y)[3];
    EXPECT_LT(covered, 36 * 0.5);
    lensSpaceImage("line:bin-size=800", *small, 4, &stats);
    EXPECT_EQ(figureOf(stats, "triangles beyond the size of a bin"), 0);
}

// With lighting at vertices, neighbouring segments of a lens line merge only if their colours agree.
TEST_F(LensSpaceAlone, segmentsOfDifferentColoursStayApart) {
    const auto mergedOf = [](float difference) {
        auto small = std::make_unique<SmallWorld>();
        Mesh mesh = quad(0);
        // The corners of each triangle have one colour, so the two triangles need separate vertices.
        const std::vector<glm::vec3> corners = mesh.vertices.positions;
        const std::vector<std::uint32_t> indices = mesh.primitives[0].indices;
        mesh.vertices = {};
        mesh.primitives[0].indices.clear();
        for (std::uint32_t i = 0; i < 6; ++i) {
            mesh.vertices.positions.push_back(corners[indices[i]]);
            mesh.vertices.normals.emplace_back(0, 0, 1);
            mesh.vertices.colors.emplace_back(glm::vec3(i < 3 ? 0.3f : 0.3f + difference), 1);
            mesh.primitives[0].indices.push_back(i);
        }
        small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
        small->scene.meshes.push_back(mesh);
        place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -4}), glm::dvec3(1.5)));
        small->view.width = small->view.height = 48;
        small->view.lens.fStop = 0.5;
        finish(*small);
        RenderStats stats;
        lensSpaceImage("line:resolve=published,shading=vertices", *small, 8, &stats);
        return figureOf(stats, "merged segments per line");
    };
    EXPECT_GT(mergedOf(0), 0);
    EXPECT_EQ(mergedOf(0.5f), 0);
}

}  // namespace
}  // namespace defocus::engine
