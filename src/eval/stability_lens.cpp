// Lenses at their limits: what is blurred, and by how much.

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "eval/board_scene.h"
#include "eval/stability.h"
#include "image/metrics.h"
#include "image/moments.h"

namespace defocus {

namespace {

constexpr double pixelLimit = 0.5;  // of a diameter, px
constexpr std::uint32_t manySamples = 1024;
struct LensSetting {
    double fStop = 1;
    double focusDistance = 2;  // m
    double depth = 6;          // m
    double nearPlane = 0.01;   // m
    int width = 96;            // px; 64 high
};

// The diameter of a point's disk by its second moment against the formula, px.
double diameterError(const LensSetting& setting) {
    View view = boardView(setting.width, 64);
    view.lens.fStop = setting.fStop;
    view.lens.focusDistance = setting.focusDistance;
    view.nearPlane = setting.nearPlane;
    BoardScene boards(view, {squareAt(view, setting.depth, 3, glm::vec3(8))});
    boards.settings.sampleCount = manySamples;
    const double measured = 2 * radiusBySecondMoment(momentsOf(rendered(boards)), 0, 3);
    return std::abs(measured - blurDiameter(view, setting.depth));
}

// Aperture zero by each way to say it, against no depth of field at all.
double pinholeError(double fStop, double blurScale) {
    View view = boardView();
    view.lens.fStop = fStop;
    view.lens.blurScale = blurScale;
    BoardScene boards(view, threeBoards(view, 1, 7), glm::vec3(0.4f));
    const Image image = rendered(boards);
    boards.view.lens.dofEnabled = false;
    return largestError(image, rendered(boards));
}

// A wall that fills the frame and far more, blurred by more than the image is wide.
double macroError() {
    View view = boardView();
    view.lens.fStop = 0.7;
    view.lens.focusDistance = 0.06;
    BoardScene boards(view, {{3, {0, 0}, {1e3, 1e3}, glm::vec3(0.3f, 0.6f, 0.9f)}});
    if (blurDiameter(view, 3) < view.width) return infinite;  // not the case that was meant
    const Image image = rendered(boards);
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(image.at(x, y)[c] - 0.3 * (c + 1)));
    return largest;
}

double farFocusError() {
    View view = boardView();
    view.lens.focusDistance = 1e9;
    BoardScene boards(view, threeBoards(view, 1, 7), glm::vec3(0.4f));
    const Image image = rendered(boards);
    boards.view.lens.focusDistance = infinite;
    return largestError(image, rendered(boards));
}

// The centre of a square that lies `offset` px from the image's middle, for a field of view in degrees.
double projectionError(double fieldOfView) {
    View view = boardView(192, 128);
    view.lens.focalLength = view.lens.horizontalAperture / (2 * std::tan(fieldOfView * std::acos(-1.0) / 360));
    view.lens.dofEnabled = false;
    const glm::dvec2 offset(70.3, -41.7);
    BoardScene boards(view, {squareAt(view, 5, 7, glm::vec3(1), offset)});
    boards.settings.sampleCount = 256;
    const Moments moments = momentsOf(rendered(boards));
    return std::hypot(moments.mean.x - (96 + offset.x), moments.mean.y - (64 - offset.y));
}

}  // namespace

void addLensCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string truth, double limit,
                         std::function<double()> error) {
        cases.push_back({"lens", std::move(name), std::move(measured), std::move(truth), limit, std::move(error)});
    };
    const auto addDiameter = [&](std::string name, const LensSetting& setting) {
        add(std::move(name), "disk diameter, px", "closed form", pixelLimit,
            [setting] { return diameterError(setting); });
    };
    add("f/1,000,000", "largest difference", "no depth of field", 2e-3, [] { return pinholeError(1e6, 1); });
    add("blur scale 0", "largest difference", "no depth of field", 0, [] { return pinholeError(1, 0); });
    addDiameter("f/8", {.fStop = 8, .width = 960});
    addDiameter("f/0.1", {.fStop = 0.1});
    addDiameter("f/0.1 in front", {.fStop = 0.1, .depth = 1.2});
    addDiameter("f/0.7, 3 mm behind a focus at 0.1 m",
                {.fStop = 0.7, .focusDistance = 0.1, .depth = 0.103, .width = 192});
    addDiameter("f/0.7, 3 mm before a focus at 0.1 m",
                {.fStop = 0.7, .focusDistance = 0.1, .depth = 0.097, .width = 192});
    addDiameter("focus at the near plane", {.fStop = 50, .focusDistance = 0.01, .depth = 1});
    addDiameter("focus at 1,000 km", {.fStop = 0.7, .focusDistance = 1e6, .depth = 1});
    addDiameter("focus at infinity", {.fStop = 0.7, .focusDistance = infinite, .depth = 1});
    add("focus at 1e9 m", "largest difference", "focus at infinity", 2e-3, farFocusError);
    add("macro: blur wider than the image", "largest error", "the wall's radiance", 1e-3, macroError);
    add("field of view 1 degree", "place, px", "closed form", 0.1, [] { return projectionError(1); });
    add("field of view 170 degrees", "place, px", "closed form", 0.1, [] { return projectionError(170); });
    addDiameter("image 8,192 px wide", {.fStop = 16, .width = 8192});
}

}  // namespace defocus
