// Tests motion blur against closed forms, and against the mean of images without motion.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "gl_context_test.h"
#include "image/metrics.h"
#include "lens/lens_samples.h"
#include "likeness.h"
#include "models.h"
#include "plan/sample_range.h"
#include "posed_world.h"
#include "render/methods.h"
#include "render/rendered.h"

namespace defocus::engine {
namespace {

using Motion = GlContextTest;

RenderSettings fullDetailFor(std::uint32_t samples) {
    return {.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
}

Image renderedInFloat(const World& world, const View& view, const RenderSettings& settings) {
    return imageInFloats(world, planFrame(world, view, settings));
}

// Returns the time of a sample within the exposure, as the plan chooses it.
double timeOf(const View& view, std::uint32_t index) {
    return static_cast<double>(lensSamples(view.lens, RenderSettings{}.sequence, index, 1, 0).front().time);
}

double sumOf(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y)[0]);
    return sum;
}

// A white square on black in an image of 128 × 96 px. A pixel is `pixelSize` m wide at the square's depth of 4 m.
struct WhiteSquare : SmallWorld {
    static constexpr double depth = 4;
    double pixelSize = 0;
    explicit WhiteSquare(double halfSizePixels) {
        scene.materials.push_back(unlitMaterial({1, 1, 1, 1}));
        scene.meshes.push_back(quad(0));
        world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, true, 1};
        view.width = 128;
        view.height = 96;
        view.lens.dofEnabled = false;
        pixelSize = 2 * tanHalfHorizontalFov(view.lens) * depth / view.width;
        place(*this, 0, at({0, 0}, halfSizePixels));
        finish(*this);
    }
    // Returns the square's matrix with its centre moved by `pixels` right and up from the image's centre.
    [[nodiscard]] glm::dmat4 at(const glm::dvec2& pixels, double halfSizePixels) const {
        return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(pixelSize * pixels, -depth)),
                          glm::dvec3(halfSizePixels * pixelSize));
    }
};

// A square that moves by D over the exposure covers a pixel for a fraction of the time. Along a row, these fractions
// form a trapezoid: a square of width 2a covers pixel x at the times t in [0, 1] with |x − D(t − 1/2)| < a.
TEST_F(Motion, aSquareThatGoesByLeavesATrapezoid) {
    constexpr double a = 8, way = 40;
    WhiteSquare square(a);
    square.world.shutter.poses.assign(2, square.world.pose);
    square.world.shutter.poses[0].objects[0].worldFromObject = square.at({-way / 2, 0}, a);
    square.world.shutter.poses[1].objects[0].worldFromObject = square.at({way / 2, 0}, a);
    const Image image = renderedInFloat(square.world, square.view, fullDetailFor(1024));
    for (int x = 0; x < 128; ++x) {
        const double place = x + 0.5 - 64;
        const double from = std::max((place - a) / way + 0.5, 0.0);
        const double to = std::min((place + a) / way + 0.5, 1.0);
        // The tolerance covers half a pixel's width and the uneven spacing of the sample times.
        ASSERT_NEAR(image.at(x, 48)[0], std::max(to - from, 0.0), 0.02) << "column " << x;
    }
}

TEST_F(Motion, keepsTheEnergyOfWhatMoves) {
    WhiteSquare square(6);
    const double still = sumOf(renderedInFloat(square.world, square.view, fullDetailFor(64)));
    square.world.shutter.poses.assign(2, square.world.pose);
    square.world.shutter.poses[0].objects[0].worldFromObject = square.at({-30, -11}, 6);
    square.world.shutter.poses[1].objects[0].worldFromObject = square.at({25, 20}, 6);
    square.view.lens.dofEnabled = true;
    square.view.lens.fStop = 0.8;
    square.view.lens.focusDistance = 2;
    EXPECT_NEAR(sumOf(renderedInFloat(square.world, square.view, fullDetailFor(64))), still, 0.01 * still);
}

TEST_F(Motion, anOpenShutterChangesNoBitOfAStillScene) {
    const auto small = fiveSpheres();
    const Image still = renderedInFloat(small->world, small->view, fullDetailFor(16));
    small->world.shutter.poses.assign(5, small->world.pose);
    small->view.shutterCameras.assign(5, small->view.worldFromCamera);
    EXPECT_TRUE(sameBits(renderedInFloat(small->world, small->view, fullDetailFor(16)), still));
}

// Post-process methods render the scene at the middle of the exposure.
TEST_F(Motion, postProcessMethodsDrawTheMiddle) {
    const auto small = fiveSpheres();
    const auto circular = [&] {
        const auto renderer = methodNamed("circular").make(small->world, {});
        return imageOf(*renderer, planFrame(small->world, small->view, fullDetailFor(4)));
    };
    const Image still = circular();
    small->world.shutter.poses.assign(2, small->world.pose);
    for (const double side : {-1.0, 1.0}) {
        glm::dmat4& matrix = small->world.shutter.poses[side < 0 ? 0 : 1].objects[1].worldFromObject;
        matrix = glm::translate(glm::dmat4(1), glm::dvec3(0.2 * side, 0, 0)) * matrix;
    }
    EXPECT_TRUE(sameBits(circular(), still));
}

// Motion segments follow a rotation. Over many segments, the corners of a rotating square move along arcs; over a
// single segment, they move along chords.
TEST_F(Motion, segmentsFollowARotation) {
    WhiteSquare square(16);
    const glm::dmat4 middle = square.world.pose.objects[0].worldFromObject;
    const auto turnedBy = [&](double share) {
        return glm::rotate(middle, (share - 0.5) * std::numbers::pi, glm::dvec3(0, 0, 1));
    };
    constexpr std::uint32_t samples = 64;
    const auto image = [&](const std::vector<double>& shares, bool perSample) {
        square.world.shutter.poses.assign(shares.size(), square.world.pose);
        square.world.shutter.perSample = perSample;
        for (std::size_t i = 0; i < shares.size(); ++i)
            square.world.shutter.poses[i].objects[0].worldFromObject = turnedBy(shares[i]);
        return renderedInFloat(square.world, square.view, fullDetailFor(samples));
    };
    std::vector<double> exactShares, sixteenShares;
    for (std::uint32_t i = 0; i < samples; ++i) exactShares.push_back(timeOf(square.view, i));
    for (int i = 0; i <= 16; ++i) sixteenShares.push_back(i / 16.0);
    const Image exact = image(exactShares, true);
    const Image sixteen = image(sixteenShares, false);
    const Image one = image({0, 1}, false);
    // 16 segments of 11.25° deviate from the arc by 0.5 % of the radius, a tenth of a pixel.
    EXPECT_GT(compareImages(exact, sixteen).psnr, 35);
    EXPECT_LT(compareImages(exact, one).psnr, 20);
    // Over a single motion segment, a rotation by 180° moves the corners along straight lines through the centre. The
    // square shrinks to a point halfway, so the sum of pixels is smaller than with exact motion.
    EXPECT_LT(sumOf(one), 0.5 * sumOf(exact));
    EXPECT_NEAR(sumOf(exact), 32 * 32, 10);
}

// Returns the mean of images of one sample each. Each image shows the scene and the camera at rest, in their poses at
// the sample's time.
Image meanOfMoments(const World& world, const View& view, std::uint32_t samples) {
    Image sum;
    for (std::uint32_t i = 0; i < samples; ++i) {
        World still = world;
        still.pose = world.shutter.poses[i];
        still.shutter = {};
        View from = view;
        from.worldFromCamera = view.shutterCameras[i];
        from.shutterCameras.clear();
        const FramePlan moment = planFrame(still, from, fullDetailFor(samples));
        const Image one = imageInFloats(still, samplesOf(moment, i, 1));
        if (sum.empty()) sum = Image(one.width, one.height, one.channels);
        for (std::size_t p = 0; p < sum.pixels.size(); ++p)
            sum.pixels[p] += one.pixels[p] / static_cast<float>(samples);
    }
    return sum;
}

// Expects motion blur to equal the mean of images without motion at the samples' times. The scene has a skinned figure,
// a camera that rotates in place, defocus, and a fixed lamp at the camera's position. Choose `fStop` and `candela` to
// suit the size of the figure.
void expectMeanOfMoments(const std::filesystem::path& path, int clip, double fStop, float candela) {
    constexpr std::uint32_t samples = 16;
    const auto small = posedWorld(path, 0.3, clip);
    View& view = small->view;
    view.lens.fStop = fStop;
    PlacedLight lamp;
    lamp.light.type = LightType::point;
    lamp.light.intensity = candela;
    lamp.position = glm::dvec3(view.worldFromCamera[3]);
    small->world.lights.push_back(lamp);
    small->world.environment = {EnvironmentType::uniform, {0.2f, 0.3f, 0.4f}, {}, {}, nullptr, true, 1};
    small->world.shutter.perSample = true;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const auto time = timeOf(view, i);
        small->world.shutter.poses.push_back(unmeasuredPoseAt(small->scene, 0.3 + 0.1 * (time - 0.5), clip));
        view.shutterCameras.push_back(glm::rotate(view.worldFromCamera, 0.1 * (time - 0.5), glm::dvec3(0, 1, 0.5)));
    }
    const Image blurred = renderedInFloat(small->world, view, fullDetailFor(samples));
    const Image mean = meanOfMoments(small->world, view, samples);
    EXPECT_GT(compareImages(mean, blurred).psnr, 60);
    small->world.shutter = {};
    view.shutterCameras.clear();
    EXPECT_LT(compareImages(mean, renderedInFloat(small->world, view, fullDetailFor(samples))).psnr, 35);
}

TEST_F(Motion, aBendingReedBeforeAMovingCameraIsTheMeanOfItsMoments) {
    expectMeanOfMoments(modelPath("meshes/reed.glb"), 0, 1.4, 20);
}

TEST_F(Motion, aRunningFoxBeforeAMovingCameraIsTheMeanOfItsMoments) {
    DEFOCUS_MODEL_OR_SKIP(path, "Fox.glb");
    // a wide lens (f/0.02) and a bright lamp (20,000 cd), since the fox is 100 m long
    expectMeanOfMoments(path, 2, 0.02, 20'000);
}

// Returns five spheres with a morph target. openShutter() moves them along straight lines and moves the camera.
std::unique_ptr<SmallWorld> straightWays() {
    auto small = fiveSpheres();
    small->world.environment = {EnvironmentType::uniform, {0.2f, 0.3f, 0.4f}, {}, {}, nullptr, true, 1};
    small->scene.materials[0].unlit = true;
    Mesh& mesh = small->scene.meshes[0];
    mesh.morphTargets.resize(1);
    for (const glm::vec3& p : mesh.vertices.positions) mesh.morphTargets[0].positions.push_back({0.3f * p.y, 0, 0});
    changePyramids(small->world, [&](Pyramid& pyramid) { measureDeformations(pyramid, mesh); });
    return small;
}

void openShutter(SmallWorld& small, const std::vector<double>& shares) {
    small.world.shutter.poses.clear();
    small.view.shutterCameras.clear();
    for (const double share : shares) {
        Pose pose = small.world.pose;
        for (std::size_t i = 0; i < pose.objects.size(); ++i) {
            const double side = i % 2 == 0 ? 1 : -0.5;
            pose.objects[i].worldFromObject[3] += glm::dvec4(0.2 * side * share, 0.1 * share, 0.4 * side * share, 0);
            pose.objects[i].morphWeights = {share * side};
        }
        small.world.shutter.poses.push_back(pose);
        small.view.shutterCameras.push_back(
            glm::translate(small.view.worldFromCamera, glm::dvec3(0.05 * share, 0, -0.1 * share)));
    }
}

// Translation is linear in time, so one motion segment between two poses is exact. The same holds for morph targets,
// with and without blur controls.
TEST_F(Motion, oneSegmentIsExactForTranslationAndMorphs) {
    constexpr std::uint32_t samples = 16;
    for (const bool controlled : {false, true}) {
        const auto small = straightWays();
        if (controlled) {
            small->view.lens.foregroundLimit = 4;
            small->view.lens.focusTilt = 0.3;
        }
        std::vector<double> times;
        for (std::uint32_t i = 0; i < samples; ++i) times.push_back(timeOf(small->view, i));
        openShutter(*small, {0, 1});
        const Image linear = renderedInFloat(small->world, small->view, fullDetailFor(samples));
        openShutter(*small, times);
        const Image mean = meanOfMoments(small->world, small->view, samples);
        EXPECT_GT(compareImages(mean, linear).psnr, 55) << controlled;
    }
}

}  // namespace
}  // namespace defocus::engine
