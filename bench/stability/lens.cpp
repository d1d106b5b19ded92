// Tests lenses at their limits: diameter and position of the blur for extreme apertures, focus distances, fields of
// view and image sizes.

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "image/metrics.h"
#include "image/moments.h"
#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double pixelLimit = 0.5;  // limit on the error of a blur diameter, px
constexpr double placeLimit = 0.1;  // limit on the error of the position of a blur disk, px
constexpr std::uint32_t manySamples = 1024;
struct LensSetting {
    double fStop = 1;
    double focusDistance = 2;  // m
    double depth = 6;          // m
    double nearPlane = 0.01;   // m
    int width = 96;            // image width in px; the height is 64 px
};

// Returns the difference (px) between the blur diameter of a small light in the image and blurDiameter(). The former is
// derived from the second moment of the light's image.
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

// Returns the max difference between an image with a vanishing aperture (by f-number or blur scale) and one without
// depth of field.
double pinholeError(double fStop, double blurScale) {
    View view = boardView();
    view.lens.fStop = fStop;
    view.lens.blurScale = blurScale;
    BoardScene boards(view, threeBoards(view, 1, 7), glm::vec3(0.4f));
    const Image image = rendered(boards);
    boards.view.lens.dofEnabled = false;
    return largestError(image, rendered(boards));
}

double farFocusError() {
    View view = boardView();
    view.lens.focusDistance = 1e9;
    BoardScene boards(view, threeBoards(view, 1, 7), glm::vec3(0.4f));
    const Image image = rendered(boards);
    boards.view.lens.focusDistance = infinite;
    return largestError(image, rendered(boards));
}

// Returns the errors of the diameter and the position of a blurred light near the image's corner, for a horizontal
// field of view in degrees.
BlurredLight lightInField(double fieldOfView) {
    View view = boardView(192, 128);
    view.lens.focalLength = view.lens.horizontalAperture / (2 * std::tan(fieldOfView * std::acos(-1.0) / 360));
    setBlur(view, 5, 20);
    const glm::dvec2 place(70.3, -41.7);
    BoardScene boards(view, {squareAt(view, 5, 3, glm::vec3(8), place)});
    boards.settings.sampleCount = manySamples;
    return blurredLight(rendered(boards), view, {.depth = 5, .offset = place});
}

// Returns the max errors of the diameters and positions of blurred lights in the image's corners, at the middles of its
// edges and at its centre.
BlurredLight lightsInLargeImage(int width, int height) {
    View view = boardView(width, height);
    setBlur(view, 6, 10);
    // Offset from the image's centre, in px, at which the blur disks just fit into the image.
    const glm::dvec2 outermost(0.5 * width - 8.3, 0.5 * height - 8.7);
    std::vector<Board> lights;
    std::vector<glm::dvec2> places;
    for (const double up : {-1.0, 0.0, 1.0})
        for (const double right : {-1.0, 0.0, 1.0}) {
            places.push_back(outermost * glm::dvec2(right, up));
            lights.push_back(squareAt(view, 6, 3, glm::vec3(8), places.back()));
        }
    BoardScene boards(view, lights);
    boards.settings.sampleCount = 64;
    const Image image = rendered(boards);
    BlurredLight largest;
    for (const glm::dvec2& place : places) {
        const BlurredLight light = blurredLight(image, view, {.depth = 6, .offset = place});
        largest.diameterError = std::max(largest.diameterError, light.diameterError);
        largest.placeError = std::max(largest.placeError, light.placeError);
    }
    return largest;
}

// Returns a function that measures `light` on its first call and later returns the same result, so that two cases can
// share one measurement.
std::function<BlurredLight()> measuredOnce(const std::function<BlurredLight()>& light) {
    return [light, known = std::make_shared<std::optional<BlurredLight>>()] {
        if (!*known) *known = light();
        return **known;
    };
}

}  // namespace

void addLensCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back({"lens", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
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
    addDiameter("f/0.7, 3 mm behind the focus distance of 0.1 m",
                {.fStop = 0.7, .focusDistance = 0.1, .depth = 0.103, .width = 192});
    addDiameter("f/0.7, 3 mm in front of the focus distance of 0.1 m",
                {.fStop = 0.7, .focusDistance = 0.1, .depth = 0.097, .width = 192});
    addDiameter("focus at the near plane", {.fStop = 50, .focusDistance = 0.01, .depth = 1});
    addDiameter("focus at 1,000 km", {.fStop = 0.7, .focusDistance = 1e6, .depth = 1});
    addDiameter("focus at infinity", {.fStop = 0.7, .focusDistance = infinite, .depth = 1});
    add("focus at 1e9 m", "largest difference", "focus at infinity", 2e-3, farFocusError);
    using NamedLight = std::pair<const char*, std::function<BlurredLight()>>;
    std::vector<NamedLight> lights = {
        {"field of view 1 degree", [] { return lightInField(1); }},
        {"field of view 170 degrees", [] { return lightInField(170); }},
        {"9 lights spread over 8,192 × 256 px", [] { return lightsInLargeImage(8192, 256); }},
        {"9 lights spread over 256 × 8,192 px", [] { return lightsInLargeImage(256, 8192); }},
    };
    for (auto& [name, light] : lights) light = measuredOnce(light);
    for (const auto& [name, light] : lights)
        add(name, "disk diameter, px", "closed form", pixelLimit, [light = light] { return light().diameterError; });
    for (const auto& [name, light] : lights)
        add(name, "place, px", "closed form", placeLimit, [light = light] { return light().placeError; });
}

}  // namespace defocus::engine
