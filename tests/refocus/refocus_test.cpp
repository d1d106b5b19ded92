// Tests which lens images (views from points of the lens) a refocused image combines, and how it shifts them.

#include "refocus/refocus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/error.h"
#include "lens/lens_samples.h"
#include "plan/frame_plan.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns the metadata of 256 lens images (views from lens points) of a 50 mm lens at f/2, focused at 2 m.
LightFieldInfo describedImages() {
    LightFieldInfo info;
    info.size = {1000, 500, 20};
    info.focusDistance = 2;
    info.fStop = 2;
    info.pixelsPerDioptre = 0.025 * 1000 / (4 * 0.36);
    info.range = {1, std::numeric_limits<double>::infinity()};
    for (const LensSample& sample : lensSamples(Lens(), Sequence::sobol, 0, 256, 0)) {
        info.points.emplace_back(sample.lens);
        info.pixels.emplace_back(sample.pixel);
    }
    return info;
}

std::string faultOf(const LightFieldInfo& info, const Refocusing& refocusing) {
    try {
        shiftedImages(info, refocusing, "a.exr");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Refocus, asRenderedMovesNothing) {
    const LightFieldInfo info = describedImages();
    const std::vector<ShiftedImage> images = shiftedImages(info, asRendered(info), "");
    ASSERT_EQ(images.size(), 256u);
    for (const ShiftedImage& image : images) {
        EXPECT_EQ(image.move, glm::ivec2(0));
        EXPECT_EQ(image.weight, 1);
    }
}

// At the rendered focus, a point at distance z has a circle of confusion of diameter c. The view from lens point (u, v)
// shows the point displaced by c/2·(u, v) from its pinhole position; in front of the focus plane, the direction is
// reversed. Refocusing at z shifts the views so that all of them show the point within the same pixel.
TEST(Refocus, bringsThePointInFocusTogether) {
    const LightFieldInfo info = describedImages();
    const double radius = 0.025 * (1 / 2.0 - 1 / 3.0) * 1000 / (2 * 0.36) / 2;
    Refocusing refocusing = asRendered(info);
    refocusing.focusDistance = 3;
    glm::dvec2 mean(0);
    for (const ShiftedImage& image : shiftedImages(info, refocusing, "")) {
        const glm::dvec2 place = info.pixels[image.image] - radius * info.points[image.image] - glm::dvec2(image.move);
        EXPECT_LE(std::max(std::abs(place.x), std::abs(place.y)), 0.5 + 1e-9);
        mean += place / 256.0;
    }
    EXPECT_LT(glm::length(mean), 0.03);  // the samples cover the pixel evenly
}

TEST(Refocus, stoppingDownKeepsTheLensPointsWithin) {
    const LightFieldInfo info = describedImages();
    Refocusing refocusing = asRendered(info);
    refocusing.fStop = 4;
    const std::vector<ShiftedImage> images = shiftedImages(info, refocusing, "");
    EXPECT_NEAR(static_cast<double>(images.size()), 64, 3);
    for (const ShiftedImage& image : images) EXPECT_LE(glm::length(info.points[image.image]), 0.5 + 1e-6);
}

TEST(Refocus, weighsByTheApertureShape) {
    const LightFieldInfo info = describedImages();
    Refocusing refocusing = asRendered(info);
    refocusing.shape.emplace();
    refocusing.shape->bladeCount = 4;
    for (const ShiftedImage& image : shiftedImages(info, refocusing, "")) {
        const glm::dvec2 p = glm::abs(info.points[image.image]);
        EXPECT_LE(p.x + p.y, 1 + 1e-6);
    }
}

// An object that is sharp at some focus distance of the range has levels of detail as fine as an object in focus.
TEST(Refocus, levelsSuitTheSharpestFocusOfTheRange) {
    const auto small = fiveSpheres();
    const auto lambdaOfFarSphere = [&](double focus, std::optional<FocusRange> range) {
        small->view.lens.focusDistance = focus;
        const RenderSettings settings{.refocus = range};
        const FramePlan plan = planFrame(small->world, small->view, settings);
        return std::ranges::find(plan.objects, "Object 3", &ObjectPlan::name)->lambda;
    };
    const double blurred = lambdaOfFarSphere(1, {});
    const double focused = lambdaOfFarSphere(9, {});
    EXPECT_GT(blurred, focused + 0.5);
    EXPECT_LE(lambdaOfFarSphere(1, FocusRange{1, 10}), focused);
    EXPECT_NEAR(lambdaOfFarSphere(1, FocusRange{1, 1}), blurred, 1e-9);
    const double between = lambdaOfFarSphere(1, FocusRange{1, 2});
    EXPECT_GT(between, focused);
    EXPECT_LT(between, blurred);
}

TEST(Refocus, refusesWhatWasNotRendered) {
    LightFieldInfo info = describedImages();
    EXPECT_EQ(faultOf(info, {0.5, 2, {}}),
              "a.exr: the focus distance of 0.5 m is outside the rendered range of 1 to inf m; render the file again "
              "with --focus-range");
    EXPECT_EQ(faultOf(info, {1e6, 2, {}}), "");
    EXPECT_EQ(faultOf(info, {2, 1.4, {}}),
              "a.exr: f/1.4 is wider than the rendered aperture of f/2; render the file again with --fstop 1.4");
    info.points = {{0.5, 0.5}};
    info.pixels = {{0, 0}};
    EXPECT_EQ(faultOf(info, {2, 22, {}}),
              "a.exr: none of its 1 lens points lies within the aperture at f/22; render the file again with more "
              "--samples");
    info.disk = false;
    EXPECT_EQ(faultOf(info, {2, 2, {}}), "");
    EXPECT_EQ(faultOf(info, {2, 4, {}}),
              "a.exr: the aperture was not rendered as a full disk, so its size and shape are fixed; render the file "
              "again without --blades, --aperture-image or other options that set its shape");
}

// Returns the message with which lens images (views from lens points) of `lens`, focused at 2 m, are rejected; empty if
// they are accepted.
std::string refusalOf(const Lens& lens, double nearest = 1.5) {
    View view;
    view.lens = lens;
    view.lens.focusDistance = 2;
    try {
        lightFieldInfo(view, {nearest, 3});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(LensImages, needALensThatOnlyMovesThem) {
    EXPECT_EQ(refusalOf({}), "");
    const auto refused = [&](auto change, const std::string& option) {
        Lens lens;
        change(lens);
        EXPECT_NE(refusalOf(lens).find(option), std::string::npos) << option << ": " << refusalOf(lens);
    };
    refused([](Lens& lens) { lens.focusBreathing = true; }, "--focus-breathing");
    refused([](Lens& lens) { lens.fieldCurvature = 0.1; }, "--field-curvature");
    refused([](Lens& lens) { lens.focusTilt = 0.1; }, "--focus-tilt");
    refused([](Lens& lens) { lens.focusSwing = 0.1; }, "--focus-swing");
    refused([](Lens& lens) { lens.foregroundLimit = 5; }, "--foreground-limit");
    refused([](Lens& lens) { lens.backgroundLimit = 5; }, "--background-limit");
    refused([](Lens& lens) { lens.focusRangeFront = 0.1; }, "--focus-range-front");
    refused([](Lens& lens) { lens.focusRangeBehind = 0.1; }, "--focus-range-behind");
    refused([](Lens& lens) { lens.radialBlurGain = 1; }, "--radial-blur-gain");
    refused([](Lens& lens) { lens.catEye = 0.5; }, "--cat-eye");
    refused([](Lens& lens) { lens.axialChromaticAberration = 0.5; }, "--axial-chromatic-aberration");
    refused([](Lens& lens) { lens.astigmatism = 0.1; }, "--astigmatism");
    refused([](Lens& lens) { lens.coma = 0.1; }, "--coma");
    refused([](Lens& lens) { lens.dofEnabled = false; }, "--no-dof");
    EXPECT_NE(refusalOf({}, 1e-3).find("to refocus between 0.001 and 3 m, lens images need a margin of"),
              std::string::npos);
}

// The margin is at least the largest shift of a lens image (view from a lens point) over the focus range. Images are
// shifted by whole pixels.
TEST(LensImages, haveAMarginForTheFocusRange) {
    View view;
    view.lens.focusDistance = 2;
    view.lens.fStop = 2;
    const LightFieldInfo info = lightFieldInfo(view, {1, 4});
    const double pixelsPerDioptre = 0.025 * 1024 / (4 * 0.36);  // aperture × width / (4·tan(half field of view))
    EXPECT_NEAR(info.pixelsPerDioptre, pixelsPerDioptre, 1e-9);
    EXPECT_EQ(info.size.margin, static_cast<int>(std::ceil(0.5 * pixelsPerDioptre + 0.5)));
    for (const double sign : {-1, 1}) {
        LightFieldInfo full = info;
        full.points = {{sign, sign}};
        full.pixels = {{0.499 * sign, 0.5 * sign}};
        for (const double focus : {1.0, 4.0}) {
            const glm::ivec2 move = integerMove(full, 0, full.shift(focus));
            EXPECT_LE(std::max(std::abs(move.x), std::abs(move.y)), full.size.margin) << sign << ' ' << focus;
        }
    }
}

}  // namespace
}  // namespace defocus::engine
