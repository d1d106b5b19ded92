// Sources: Jeong, Kim and Lee 2011, Multi-Resolution Depth-of-Field Rendering; Munkberg, Toth and Akenine-Möller 2012,
// Per-Vertex Defocus Blur for Stochastic Rasterization. In the latter, the circle of confusion has the opposite sign.

#include "lens/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double maxTilt = 89.95 * std::numbers::pi / 180;  // at 90°, the focus plane passes through the camera
constexpr double maxAberration = 100;                       // max length of aberration streaks in mm

void requireWithin(double value, double min, double max, const char* name) {
    if (!(value >= min && value <= max)) fail("lens: {} must be from {} to {}, not {}", name, min, max, value);
}

void requirePositive(double value, const char* name, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
        fail("lens: {} must be a finite number above 0{}, not {}", name, unit, value);
}

// Returns the distance from the lens to the sensor in mm. It is the focal length, or the thin lens's image distance
// f·s/(s − f) with focus breathing.
double imageDistance(const Lens& lens) {
    if (!lens.focusBreathing || std::isinf(lens.focusDistance)) return lens.focalLength;
    const double f = lens.focalLength * millimetre;
    return lens.focalLength * lens.focusDistance / (lens.focusDistance - f);
}

}  // namespace

void checkLens(const Lens& lens) {
    requirePositive(lens.focalLength, "the focal length", " mm");
    requirePositive(lens.fStop, "the f-number", "");
    requirePositive(lens.horizontalAperture, "the horizontal aperture (sensor width)", " mm");
    requirePositive(lens.anamorphicRatio, "the anamorphic ratio", "");
    if (!(lens.focusDistance > 0)) fail("lens: the focus distance must be above 0 m, not {}", lens.focusDistance);
    if (!(lens.blurScale >= 0) || !std::isfinite(lens.blurScale))
        fail("lens: the blur scale must be finite and at least 0, not {}", lens.blurScale);
    requireWithin(lens.exposureTime, 0, 1e6, "the exposure time (s)");
    requireWithin(lens.iso, 1, 1e7, "the ISO sensitivity");
    if (!std::isfinite(lens.bladeRotation)) fail("lens: the blade rotation must be finite, not {}", lens.bladeRotation);
    if (lens.bladeCount != 0 && (lens.bladeCount < 3 || lens.bladeCount > 64))
        fail("lens: the blade count must be 0 (a disk) or 3 to 64, not {}", lens.bladeCount);
    requireWithin(lens.bladeCurvature, 0, 1, "the blade curvature");
    requireWithin(lens.obstruction, 0, 0.999, "the obstruction");
    requireWithin(lens.sphericalAberration, -1, 1, "the spherical aberration");
    requireWithin(lens.catEye, 0, 1, "the strength of the cat's-eye bokeh");
    requireWithin(lens.axialChromaticAberration, -100, 100, "the axial chromatic aberration (dioptres)");
    requireWithin(lens.astigmatism, -maxAberration, maxAberration, "the astigmatism (mm)");
    requireWithin(lens.coma, -maxAberration, maxAberration, "the coma (mm)");
    requireWithin(lens.foregroundLimit, 0, infinity, "the foreground limit (px)");
    requireWithin(lens.backgroundLimit, 0, infinity, "the background limit (px)");
    requireWithin(lens.focusRangeFront, 0, infinity, "the sharp range in front of the focus distance (m)");
    requireWithin(lens.focusRangeBehind, 0, infinity, "the sharp range behind the focus distance (m)");
    requireWithin(lens.focusTilt, -maxTilt, maxTilt, "the focus tilt (radians)");
    requireWithin(lens.focusSwing, -maxTilt, maxTilt, "the focus swing (radians)");
    requireWithin(lens.fieldCurvature, -1e3, 1e3, "the field curvature");
    requireWithin(lens.radialBlurGain, 0, 1e3, "the radial blur gain");
    if (lens.focusRangeFront >= lens.focusDistance)
        fail(
            "lens: the sharp range begins {:.6g} m in front of the focus distance of {:.6g} m, at or behind the "
            "camera; give a smaller --focus-range-front",
            lens.focusRangeFront, lens.focusDistance);
    if (lens.focusBreathing && lens.focusDistance <= lens.focalLength * millimetre)
        fail("lens: with focus breathing, the focus distance ({:.6g} m) must exceed the focal length ({:.6g} mm)",
             lens.focusDistance, lens.focalLength);
}

double tanHalfHorizontalFov(const Lens& lens) {
    return lens.horizontalAperture / (2 * imageDistance(lens));
}

double apertureDiameter(const Lens& lens) {
    return lens.dofEnabled ? lens.blurScale * lens.focalLength * millimetre / lens.fStop : 0;
}

double focalLengthFromFov(double tanHalfHorizontal, double horizontalAperture) {
    return horizontalAperture / (2 * tanHalfHorizontal);
}

}  // namespace defocus::engine
