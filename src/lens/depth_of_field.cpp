#include "lens/depth_of_field.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace defocus::engine {

namespace {

constexpr double diagonalShare = 1500;

}  // namespace

DepthOfField depthOfField(const Lens& lens, double acceptable) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double aperture = apertureDiameter(lens);
    if (!(aperture > 0)) return {0, 0, infinity};
    const double f = lens.focalLength * millimetre;
    const double imageDistance = lens.horizontalAperture * millimetre / (2 * tanHalfHorizontalFov(lens));
    const double inFocus = acceptable * millimetre / (aperture * imageDistance);  // half the range of 1/z in focus, 1/m
    DepthOfField result;
    result.hyperfocal = aperture * f / (acceptable * millimetre) + (lens.focusBreathing ? f : 0);
    result.near = 1 / (1 / lens.focusDistance + inFocus);
    const double far = 1 / lens.focusDistance - inFocus;
    // Treat rounding errors as 0: the far limit of a lens focused at its hyperfocal distance is infinite.
    result.far = far > 1e-12 * inFocus ? 1 / far : infinity;
    return result;
}

glm::dvec2 sensorSize(const Lens& lens, int width, int height) {
    return {lens.horizontalAperture, lens.horizontalAperture * height / width};
}

double customaryCircleOfConfusion(const Lens& lens, int width, int height) {
    return glm::length(sensorSize(lens, width, height)) / diagonalShare;
}

}  // namespace defocus::engine
