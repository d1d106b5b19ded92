// Tests the controls of the circle of confusion, such as a focus range or a blur limit. Each control has its documented
// effect on images. A surface of large triangles gives the same image as a surface of small triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "gl/context.h"
#include "gl_context_test.h"
#include "image/metrics.h"
#include "lens/circle_of_confusion.h"
#include "likeness.h"
#include "render/aov/aov.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using CocControls = GlContextTest;

Image rendered(const SmallWorld& small, std::uint32_t samples, double tolerance = 0.5,
               const char* method = "accumulation") {
    // keepAll: use the lens even if nothing is blurred, since a pinhole image has at most 16 samples
    const RenderSettings settings{
        .sampleCount = samples, .lod = LodMode::off, .cocTolerance = tolerance, .keepAll = true};
    return imageByMethod(method, small.world, planFrame(small.world, small.view, settings));
}

// Returns a checkered floor 0.5 m below the camera, from `begin` to `end` m in front of it. It has `cells` × `cells`
// squares of two triangles each.
std::unique_ptr<SmallWorld> checkeredFloor(int cells, double begin, double end) {
    auto small = std::make_unique<SmallWorld>();
    TextureImage image;
    image.width = image.height = 64;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const std::uint8_t value = (x + y) % 2 == 0 ? 255 : 20;
            image.rgba.insert(image.rgba.end(), {value, value, static_cast<std::uint8_t>(4 * x), 255});
        }
    small->scene.images.push_back(image);
    small->scene.imageNames.emplace_back("checkers");
    Texture texture;
    texture.image = 0;
    texture.magnification = Filter::nearest;
    small->scene.textures.push_back(texture);
    Material material = unlitMaterial(glm::vec4(1));
    material.baseColor.texture = 0;
    material.doubleSided = true;
    small->scene.materials.push_back(material);

    Mesh mesh;
    mesh.name = "floor";
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            const glm::dvec2 part = glm::dvec2(x, y) / double(cells);
            mesh.vertices.positions.emplace_back(-2.5 + 5 * part.x, -0.5, -(begin + (end - begin) * part.y));
            mesh.vertices.normals.emplace_back(0, 1, 0);
            mesh.vertices.uv0.emplace_back(part);
        }
    mesh.primitives.push_back({0, gridIndices(static_cast<std::uint32_t>(cells))});
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::dmat4(1));
    small->world.pyramids.push_back(fullDetail(small->scene.meshes[0]));
    small->world.environment = {EnvironmentType::uniform, {0.2f, 0.3f, 0.5f}, {}, {}, nullptr, 1};
    small->view.width = 160;
    small->view.height = 120;
    small->view.nearPlane = 0.05;
    small->view.lens.fStop = 0.7;
    small->view.lens.focusDistance = 2.5;
    return small;
}

// Returns a white floor of the same size as checkeredFloor(), in front of a black background. Its triangles have many
// shapes: corners are jittered, and diagonals run in both directions.
std::unique_ptr<SmallWorld> unevenWhiteFloor(int cells, double begin, double end) {
    auto small = checkeredFloor(cells, begin, end);
    small->scene.materials[0].baseColor.texture = -1;
    small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    Mesh& mesh = small->scene.meshes[0];
    std::minstd_rand random(7);
    // uniform random number in [−1, 1]
    const auto uniform = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
    const auto across = static_cast<std::size_t>(cells) + 1;
    const glm::vec2 cell(5.0 / cells, (end - begin) / cells);
    for (std::size_t i = 0; i < mesh.vertices.positions.size(); ++i) {
        glm::vec3& position = mesh.vertices.positions[i];
        const glm::vec2 step = 0.35f * cell * glm::vec2(uniform(), uniform());
        if (i % across > 0 && i % across < across - 1) position.x += step.x;
        if (i / across > 0 && i / across < across - 1) position.z += step.y;
    }
    std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    for (std::size_t i = 0; i < indices.size(); i += 6) {
        const std::uint32_t corners[4] = {indices[i], indices[i + 1], indices[i + 4], indices[i + 5]};
        if (uniform() < 0) continue;
        const std::uint32_t other[6] = {corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]};
        std::copy(std::begin(other), std::end(other), indices.begin() + static_cast<std::ptrdiff_t>(i));
    }
    small->world.pyramids = {};
    small->world.pyramids.push_back(fullDetail(mesh));
    return small;
}

// Triangles in which the circle of confusion is not linear are subdivided. A geometry shader also cuts triangles in
// which the slope of the circle of confusion jumps. Objects without such a jump skip this shader, which would not
// change their image.
TEST_F(CocControls, dividedTrianglesNeedNoCuts) {
    const auto floor = checkeredFloor(3, 2, 12);
    floor->view.lens.fieldCurvature = 0.5;
    const RenderSettings settings{.sampleCount = 16, .lod = LodMode::off};
    FramePlan plan = planFrame(floor->world, floor->view, settings);
    ASSERT_EQ(plan.objects.at(0).refinement, Refinement::subdivide);
    ASSERT_FALSE(plan.objects[0].cuts);
    const Image direct = imageInFloats(floor->world, plan);
    plan.objects[0].cuts = true;
    EXPECT_EQ(imageInFloats(floor->world, plan).pixels, direct.pixels);
}

TEST_F(CocControls, maxPartsBoundTheDivision) {
    const auto floor = checkeredFloor(3, 2, 12);
    floor->view.lens.fieldCurvature = 2;
    const RenderSettings settings{.sampleCount = 16, .lod = LodMode::off, .cocTolerance = 0.05};
    FramePlan plan = planFrame(floor->world, floor->view, settings);
    EXPECT_EQ(plan.objects.at(0).maxParts, maxEdgeParts);
    const Image whole = imageInFloats(floor->world, plan);
    plan.objects[0].maxParts = 1;
    const Image bounded = imageInFloats(floor->world, plan);
    plan.objects[0].refinement = Refinement::none;
    EXPECT_LT(rootMeanSquare(bounded, imageInFloats(floor->world, plan)), 1e-3) << "one part is no division";
    EXPECT_GT(rootMeanSquare(bounded, whole), 0.01);
}

struct Control {
    const char* name;
    std::function<void(Lens&)> set;
    double begin;  // near end of the floor, in m in front of the camera
};

void PrintTo(const Control& control, std::ostream* out) {
    *out << control.name;
}

class LargeTriangles : public CocControls, public testing::WithParamInterface<Control> {};

// The circle of confusion C is interpolated linearly inside a triangle. In a large triangle in which the slope of C
// jumps, the interpolated blur would vanish in the wrong place (Munkberg et al. 2012, Figures 2 and 10). The renderer
// divides large triangles, so that a floor of two triangles looks like a floor of many small triangles.
TEST_P(LargeTriangles, lookLikeSmallOnes) {
    const auto large = checkeredFloor(1, GetParam().begin, 12);
    const auto fine = checkeredFloor(200, GetParam().begin, 12);
    GetParam().set(large->view.lens);
    GetParam().set(fine->view.lens);
    const Image reference = rendered(*fine, 16, 1e6);
    const Image divided = rendered(*large, 16, 0.1);
    const double error = rootMeanSquare(divided, reference);
    // If the surface reaches the camera, its triangles are divided at any tolerance, so there is no undivided image.
    if (GetParam().begin < 0) {
        // GPUs clip and round differently from the software rasterizer llvmpipe: the error on an NVIDIA H100 is 0.0022.
        EXPECT_LT(error, currentIsSoftware() ? 0.002 : 0.003);
        return;
    }
    EXPECT_LT(error, 0.012);
    EXPECT_GT(rootMeanSquare(rendered(*large, 16, 1e6), reference), 2.5 * error) << "undivided triangles must differ";
}

// Neighbouring triangles divide their common edge at the same points. A white floor of uneven triangles therefore has
// no gaps that show the black background.
TEST_P(LargeTriangles, meetWithoutGaps) {
    const auto floor = unevenWhiteFloor(5, GetParam().begin, 12);
    GetParam().set(floor->view.lens);
    const Image image = rendered(*floor, 16, 0.2);
    // Only pixels nearer than 5 m are tested, where the blur of the floor's far edge does not reach. A hole in one of
    // the 16 samples would darken a pixel by 1/16; smaller differences are rounding.
    for (int y = 85; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) ASSERT_GT(image.at(x, y)[1], 0.99) << x << ", " << y;
}

INSTANTIATE_TEST_SUITE_P(
    , LargeTriangles,
    testing::Values(
        Control{"foregroundLimit", [](Lens& lens) { lens.foregroundLimit = 3; }, 0.7},
        Control{"backgroundLimit", [](Lens& lens) { lens.backgroundLimit = 1; }, 0.7},
        Control{"bothLimits", [](Lens& lens) { lens.foregroundLimit = 2, lens.backgroundLimit = 1; }, 0.7},
        Control{"focusRange", [](Lens& lens) { lens.focusRangeFront = 1.2, lens.focusRangeBehind = 2; }, 0.7},
        Control{"refocusedRange",
                [](Lens& lens) {
                    lens.focusRangeFront = 1.2, lens.focusRangeBehind = 2;
                    lens.focusRangeRefocuses = true;
                },
                0.7},
        Control{"rangeAndLimits",
                [](Lens& lens) {
                    lens.focusRangeFront = 0.5, lens.focusRangeBehind = 1;
                    lens.foregroundLimit = 4, lens.backgroundLimit = 1;
                },
                0.7},
        Control{"tiltAndLimit", [](Lens& lens) { lens.focusTilt = -1, lens.backgroundLimit = 1; }, 0.7},
        Control{"fieldCurvature", [](Lens& lens) { lens.fieldCurvature = 1.5; }, 0.7},
        Control{"radialBlurGain", [](Lens& lens) { lens.radialBlurGain = 1; }, 0.7},
        Control{"astigmatism", [](Lens& lens) { lens.astigmatism = 6; }, 0.7},
        Control{"curvedAndLimit", [](Lens& lens) { lens.fieldCurvature = 1, lens.foregroundLimit = 3; }, 0.7},
        Control{"limitThroughTheCamera", [](Lens& lens) { lens.foregroundLimit = 6; }, -4},
        Control{"rangeThroughTheCamera", [](Lens& lens) { lens.focusRangeFront = 1.5, lens.foregroundLimit = 6; }, -4}),
    [](const testing::TestParamInfo<Control>& control) { return std::string(control.param.name); });

// Returns three patches side by side at 1, 2.5 and 8 m, in front of a black background.
std::unique_ptr<SmallWorld> threePatches() {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({0.9f, 0.8f, 0.6f, 1}));
    small->scene.meshes.push_back(quad(0));
    const double depths[3] = {1, 2.5, 8};
    for (int i = 0; i < 3; ++i) {
        const double size = 0.05 * depths[i];
        const glm::dvec3 at((i - 1) * 0.2 * depths[i], 0, -depths[i]);
        place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), at), glm::dvec3(size)));
    }
    small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    small->view.width = 160;
    small->view.height = 120;
    small->view.lens.fStop = 1.4;
    small->view.lens.focusDistance = 2.5;
    finish(*small);
    return small;
}

Image part(const Image& image, int third) {
    const int width = image.width / 3;
    Image result(width, image.height, image.channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) std::copy_n(image.at(third * width + x, y), image.channels, result.at(x, y));
    return result;
}

// Sets a foreground limit of zero. Expects that only the patch in front changes, and that it has no blur. Returns the
// pinhole image.
Image expectLimitInFront(SmallWorld& small) {
    const Image before = rendered(small, 64);
    small.view.lens.foregroundLimit = 0;
    const Image after = rendered(small, 64);
    EXPECT_LT(rootMeanSquare(part(before, 1), part(after, 1)), 1e-6);
    EXPECT_LT(rootMeanSquare(part(before, 2), part(after, 2)), 1e-6);
    EXPECT_GT(rootMeanSquare(part(before, 0), part(after, 0)), 0.02);
    small.view.lens.dofEnabled = false;
    Image pinhole = rendered(small, 64);
    EXPECT_LT(rootMeanSquare(part(after, 0), part(pinhole, 0)), 1e-5) << "no blur is left in front";
    return pinhole;
}

TEST_F(CocControls, limitInFrontLeavesFocusAndBackground) {
    expectLimitInFront(*threePatches());
}

TEST_F(CocControls, limitBehindLeavesFocusAndForeground) {
    const auto small = threePatches();
    const Image before = rendered(*small, 64);
    small->view.lens.backgroundLimit = 0;
    const Image after = rendered(*small, 64);
    EXPECT_LT(rootMeanSquare(part(before, 0), part(after, 0)), 1e-6);
    EXPECT_LT(rootMeanSquare(part(before, 1), part(after, 1)), 1e-6);
    EXPECT_GT(rootMeanSquare(part(before, 2), part(after, 2)), 0.01);
}

// Between the camera and the focus range, the blur equals that of a lens focused at the near end. Behind the range, the
// blur equals that of a lens focused at the far end. With focusRangeRefocuses, the latter lens has the same aperture.
// Otherwise its aperture is multiplied by the far end's distance over the focus distance.
TEST_F(CocControls, focusRangePreservesNearAndFarBlur) {
    for (const bool refocuses : {false, true}) {
        const auto small = threePatches();
        Lens& lens = small->view.lens;
        lens.focusRangeFront = 0.5;
        lens.focusRangeBehind = 2;
        lens.focusRangeRefocuses = refocuses;
        const Image range = rendered(*small, 64);
        lens.focusRangeFront = lens.focusRangeBehind = 0;
        lens.focusDistance = 2;
        EXPECT_LT(rootMeanSquare(part(range, 0), part(rendered(*small, 64), 0)), 1e-4) << refocuses;
        lens.focusDistance = 4.5;
        if (!refocuses) lens.fStop /= 4.5 / 2.5;
        EXPECT_LT(rootMeanSquare(part(range, 2), part(rendered(*small, 64), 2)), 1e-4) << refocuses;
    }
}

TEST_F(CocControls, focusRangeIsSharpAsAPinhole) {
    const auto small = threePatches();
    const Image blurred = rendered(*small, 64);
    small->view.lens.focusRangeFront = 1.6;  // the focus range begins at 2.5 − 1.6 = 0.9 m
    small->view.lens.focusRangeBehind = 2;   // the focus range ends at 2.5 + 2 = 4.5 m
    const Image range = rendered(*small, 64);
    small->view.lens.dofEnabled = false;
    const Image pinhole = rendered(*small, 64);
    EXPECT_LT(rootMeanSquare(part(range, 0), part(pinhole, 0)), 1e-5);
    EXPECT_LT(rootMeanSquare(part(range, 1), part(pinhole, 1)), 1e-5);
    EXPECT_GT(rootMeanSquare(part(range, 2), part(pinhole, 2)), 1e-3) << "beyond the range, blur remains";
    EXPECT_GT(rootMeanSquare(part(blurred, 0), part(pinhole, 0)), 0.02);
}

// A foreground limit of zero removes the defocus of a moving object in front of the focal plane, but not its motion
// blur. The rest of the image stays the same (Munkberg et al. 2012, Figure 4).
TEST_F(CocControls, limitInFrontLeavesTheMotion) {
    const auto small = threePatches();
    small->world.shutter.poses.assign(2, small->world.pose);
    for (std::size_t i = 0; i < 2; ++i)
        for (const std::size_t object : {0, 2}) {
            glm::dmat4& matrix = small->world.shutter.poses[i].objects[object].worldFromObject;
            matrix[3] += glm::dvec4((i == 0 ? -0.015 : 0.015) * -matrix[3].z, 0, 0, 0);
        }
    const Image pinhole = expectLimitInFront(*small);
    small->world.shutter.poses.clear();
    EXPECT_GT(rootMeanSquare(part(rendered(*small, 64), 0), part(pinhole, 0)), 0.02) << "the patch moves";
}

// With any aperture shape, an object whose blur is scaled to zero has the same edges as in a pinhole image. The other
// objects keep their bokeh (Munkberg et al. 2012, Figure 8).
TEST_F(CocControls, scaleOfAnObjectHoldsForPolygonsToo) {
    const auto small = threePatches();
    const Image circular = rendered(*small, 256);
    small->view.lens.bladeCount = 6;
    const Image hexagonal = rendered(*small, 256);
    small->world.pose.objects[2].cocScale = 0;
    const Image selected = rendered(*small, 256);
    EXPECT_LT(rootMeanSquare(part(selected, 0), part(hexagonal, 0)), 1e-6);
    EXPECT_GT(rootMeanSquare(part(hexagonal, 0), part(circular, 0)), 0.002) << "a hexagon must differ from a disk";
    small->view.lens.dofEnabled = false;
    EXPECT_LT(rootMeanSquare(part(selected, 2), part(rendered(*small, 256), 2)), 1e-5);
}

TEST_F(CocControls, scaleOfAnObjectIsItsOwn) {
    const auto small = threePatches();
    const Image before = rendered(*small, 64);
    small->world.pose.objects[0].cocScale = 0;
    small->world.pose.objects[2].cocScale = 2;
    const Image after = rendered(*small, 64);
    EXPECT_LT(rootMeanSquare(part(before, 1), part(after, 1)), 1e-6);
    small->world.pose.objects[0].cocScale = small->world.pose.objects[2].cocScale = 1;
    small->view.lens.blurScale = 2;
    EXPECT_LT(rootMeanSquare(part(rendered(*small, 64), 2), part(after, 2)), 1e-4) << "equals the lens's blur scale";
    small->view.lens.dofEnabled = false;
    EXPECT_LT(rootMeanSquare(part(rendered(*small, 64), 0), part(after, 0)), 1e-5);
}

TEST_F(CocControls, scaleOfAVertexIsThatOfItsObject) {
    const auto small = threePatches();
    small->world.pose.objects[2].cocScale = 0.25;
    const Image expected = rendered(*small, 64);
    small->world.pose.objects[2].cocScale = 1;
    // The third patch gets a mesh with a blur scale of 0.25 at its vertices.
    Mesh scaled = quad(0);
    scaled.vertices.blurs.assign(4, {0.25f, 0, 0});
    scaled.blurBounds = boundsOf(scaled.vertices.blurs);
    small->scene.meshes.push_back(scaled);
    small->world.pose.objects[2].mesh = 1;
    small->world.pyramids.push_back(buildPyramid(scaled));
    EXPECT_LT(rootMeanSquare(rendered(*small, 64), expected), 1e-6);
}

// All points of the tilted focus plane w + m·X = s are sharp. w is the depth, X the horizontal camera-space position, m
// the slope and s the focus distance.
TEST_F(CocControls, tiltedPlaneIsSharpAllAlong) {
    const auto small = threePatches();
    Lens& lens = small->view.lens;
    lens.fStop = 0.5;
    // The patches at (X, depth) lie on the plane depth = s − tan(swing)·X, with the focus distance s.
    const double m = std::tan(0.9);
    lens.focusSwing = 0.9;
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = (static_cast<double>(i) - 1) * 0.7;
        const glm::dmat4 at = glm::translate(glm::dmat4(1), glm::dvec3(x, 0, -(2.5 - m * x)));
        small->world.pose.objects[i].worldFromObject =
            glm::scale(glm::rotate(at, -std::atan(m), glm::dvec3(0, 1, 0)), glm::dvec3(0.12));
    }
    const Image tilted = rendered(*small, 64);
    lens.dofEnabled = false;
    EXPECT_LT(rootMeanSquare(tilted, rendered(*small, 64)), 0.001);
    lens.dofEnabled = true;
    lens.focusSwing = 0;
    EXPECT_GT(rootMeanSquare(tilted, rendered(*small, 64)), 0.006) << "without the swing the sides are blurred";
}

// For any combination of controls, the AOV of the circle of confusion equals circleOfConfusion() with the frame plan's
// parameters.
TEST_F(CocControls, aovIsTheFunctionOfThePlan) {
    const auto small = checkeredFloor(4, 0.7, 12);
    Lens& lens = small->view.lens;
    lens.focusTilt = 0.3;
    lens.focusSwing = -0.2;
    lens.fieldCurvature = 0.5;
    lens.radialBlurGain = 0.8;
    lens.focusRangeFront = 0.3;
    lens.focusRangeBehind = 0.6;
    lens.foregroundLimit = 9;
    lens.backgroundLimit = 3;
    small->world.pose.objects[0].cocScale = 1.5;
    RenderSettings settings;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    const AovImages aovs = renderAovs(small->world, plan, {});
    const int width = small->view.width;
    const int height = small->view.height;
    for (int y = 0; y < height; y += 7)
        for (int x = 0; x < width; x += 7) {
            const double depth = aovs.depth.at(x, y)[0];
            if (!std::isfinite(depth)) continue;
            const glm::dvec2 ndc((x + 0.5) / width * 2 - 1, 1 - (y + 0.5) / height * 2);
            EXPECT_NEAR(aovs.coc.at(x, y)[0], circleOfConfusion(plan.coc, depth, width, ndc, 1.5), 2e-3)
                << "at pixel " << x << "," << y;
        }
}

// Post-process methods also apply the controls of the circle of confusion. If the controls limit all blur to zero,
// these methods give the pinhole image.
TEST_F(CocControls, postProcessMethodsFollow) {
    for (const char* method : {"circular", "scheuermann:coc=thin-lens"}) {
        const auto small = threePatches();
        const Image blurred = rendered(*small, 4, 0.5, method);
        small->world.pose.objects[0].cocScale = 0;
        small->view.lens.backgroundLimit = 0;
        const Image sharp = rendered(*small, 4, 0.5, method);
        small->view.lens.dofEnabled = false;
        const Image pinhole = rendered(*small, 4, 0.5, method);
        EXPECT_GT(rootMeanSquare(blurred, pinhole), 0.01) << method;
        EXPECT_LT(rootMeanSquare(sharp, pinhole), 1e-3) << method;
    }
}

}  // namespace
}  // namespace defocus::engine
