// Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization (C with the opposite
// sign).

#include "lens/circle_of_confusion.h"

#include <algorithm>
#include <cmath>

#include "lens/wavelengths.h"

namespace defocus {

namespace {

struct Interval {
    double least = 0;
    double most = 0;
};

Interval sum(const Interval& p, const Interval& q) {
    return {p.least + q.least, p.most + q.most};
}

Interval times(const Interval& p, double factor) {
    return factor >= 0 ? Interval{p.least * factor, p.most * factor} : Interval{p.most * factor, p.least * factor};
}

// Of a value and a factor ≥ 0.
Interval times(const Interval& p, const Interval& factor) {
    return {p.least * (p.least < 0 ? factor.most : factor.least), p.most * (p.most < 0 ? factor.least : factor.most)};
}

Interval squared(const Interval& p) {
    const double far = std::max(std::abs(p.least), std::abs(p.most));
    const double near = p.least <= 0 && p.most >= 0 ? 0 : std::min(std::abs(p.least), std::abs(p.most));
    return {near * near, far * far};
}

// What C is made of, over a box.
struct Parts {
    Interval radius2;  // r²
    Interval factor;   // scale·(1 + g·r²)
    Interval front;    // F
    Interval behind;   // B
};

Parts partsOver(const ClipCircleOfConfusion& coc, const CocBox& box) {
    const Interval x{box.ndcLeast.x, box.ndcMost.x};
    const Interval y{box.ndcLeast.y, box.ndcMost.y};
    const Interval inverseDepth{1 / box.zFar, 1 / box.zNear};
    Parts parts;
    if (coc.varies()) parts.radius2 = sum(squared(x), times(squared(y), 1 / (coc.aspect * coc.aspect)));
    Interval focus{1, 1};
    if (coc.curvature != 0) focus = sum(focus, times(parts.radius2, coc.curvature));
    if (coc.tilt.x != 0) focus = sum(focus, times(x, coc.tilt.x));
    if (coc.tilt.y != 0) focus = sum(focus, times(y, coc.tilt.y));
    parts.factor = sum({1, 1}, times(parts.radius2, coc.gain));
    parts.factor = {parts.factor.least * box.scaleLeast, parts.factor.most * box.scaleMost};
    parts.front = sum(times(inverseDepth, coc.a), times(focus, coc.front));
    parts.behind = sum(times(inverseDepth, coc.a), times(focus, coc.behind));
    if (coc.chromatic > 0) {
        const double spread = coc.chromatic * std::max(std::abs(focus.least), std::abs(focus.most));
        parts.front = sum(parts.front, {-spread, spread});
        parts.behind = sum(parts.behind, {-spread, spread});
    }
    return parts;
}

bool strictlyInside(const Interval& p, double value) {
    return p.least < value && value < p.most;
}

}  // namespace

bool ClipCircleOfConfusion::thinLens() const {
    return front == behind && !varies() && std::isinf(foregroundLimit) && std::isinf(backgroundLimit);
}

bool ClipCircleOfConfusion::varies() const {
    return tilt != glm::dvec2(0) || curvature != 0 || gain != 0;
}

ClipCircleOfConfusion clipCircleOfConfusion(const Lens& lens, int width, int height) {
    const double tanX = tanHalfHorizontalFov(lens);
    const double aspect = static_cast<double>(width) / height;
    ClipCircleOfConfusion coc;
    coc.a = -0.5 * apertureDiameter(lens) / tanX;
    coc.front = -coc.a / (lens.focusDistance - (std::isinf(lens.focusDistance) ? 0 : lens.focusRangeFront));
    coc.behind = -coc.a / (lens.focusDistance + lens.focusRangeBehind);
    coc.tilt = glm::dvec2(std::tan(lens.focusSwing) * tanX, std::tan(lens.focusTilt) * tanX / aspect);
    coc.curvature = lens.fieldCurvature;
    coc.gain = lens.radialBlurGain;
    coc.foregroundLimit = lens.foregroundLimit / width;
    coc.backgroundLimit = lens.backgroundLimit / width;
    coc.aspect = aspect;
    coc.chromatic = std::abs(chromaticShift(coc.a, lens.axialChromaticAberration, 1));
    return coc;
}

double circleOfConfusion(const ClipCircleOfConfusion& coc, double z, int width, const glm::dvec2& ndc, double scale) {
    const double radius2 = ndc.x * ndc.x + ndc.y * ndc.y / (coc.aspect * coc.aspect);
    const double focus = 1 + coc.curvature * radius2 + coc.tilt.x * ndc.x + coc.tilt.y * ndc.y;
    const double front = coc.a / z + coc.front * focus;
    const double behind = coc.a / z + coc.behind * focus;
    const double blur = scale * (1 + coc.gain * radius2) * (std::min(0.0, front) + std::max(0.0, behind));
    return std::clamp(blur, -coc.foregroundLimit, coc.backgroundLimit) * width;
}

CocRange circleOfConfusionRange(const ClipCircleOfConfusion& coc, const CocBox& box, int width) {
    const Parts parts = partsOver(coc, box);
    const Interval blur = times({std::min(0.0, parts.front.least) + std::max(0.0, parts.behind.least),
                                 std::min(0.0, parts.front.most) + std::max(0.0, parts.behind.most)},
                                parts.factor);
    CocRange range;
    range.nearest = std::clamp(blur.least, -coc.foregroundLimit, coc.backgroundLimit) * width;
    range.farthest = std::clamp(blur.most, -coc.foregroundLimit, coc.backgroundLimit) * width;
    const bool straddles = range.nearest <= 0 && range.farthest >= 0;
    range.smallest = straddles ? 0 : std::min(std::abs(range.nearest), std::abs(range.farthest));
    range.largest = std::max(std::abs(range.nearest), std::abs(range.farthest));
    return range;
}

double largestCocAtInfinity(const ClipCircleOfConfusion& coc, int width) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return circleOfConfusionRange(coc, {infinity, infinity, glm::dvec2(-1), glm::dvec2(1)}, width).largest;
}

CocDeviation cocDeviation(const ClipCircleOfConfusion& coc, const CocBox& box, double longestEdge,
                          const glm::dvec2& tanHalf, int width) {
    CocDeviation deviation;
    if (coc.thinLens()) return deviation;
    const Parts parts = partsOver(coc, box);
    const double pixels = width / box.zNear;
    const double factor = parts.factor.most;

    // Two linear pieces that meet at a kink differ by at most the change of slope times the distance from it; an edge
    // of length L across it deviates most if it lies in the middle: slope·L/4.
    const double slope = factor * coc.front *
                         (1 + std::abs(coc.tilt.x) / tanHalf.x + std::abs(coc.tilt.y) / tanHalf.y +
                          std::abs(coc.curvature) * parts.radius2.most * (1 + 2 / std::min(tanHalf.x, tanHalf.y)));
    double change = 0;
    if (strictlyInside(times(parts.front, parts.factor), -coc.foregroundLimit)) change = slope + coc.foregroundLimit;
    if (strictlyInside(times(parts.behind, parts.factor), coc.backgroundLimit))
        change = std::max(change, slope + coc.backgroundLimit);
    if (coc.front != coc.behind && (strictlyInside(parts.front, 0) || strictlyInside(parts.behind, 0)))
        change = std::max(change, slope);
    deviation.kinks = change * longestEdge / 4 * pixels;

    // A function with second derivatives of at most H deviates from its chord by at most H·L²/8. Lengths here are those
    // of clip positions, divided by the nearest depth: then r²·w has second derivatives of at most 2·(1 + r)².
    const double length = longestEdge / box.zNear * (1 + 1 / std::min(tanHalf.x, tanHalf.y));
    const double reach = 1 + std::sqrt(parts.radius2.most);
    const double base = std::max(std::abs(parts.front.least), std::abs(parts.behind.most));
    const double second = 2 * reach * reach *
                          (box.scaleMost * coc.front * std::abs(coc.curvature) * (1 + coc.gain * parts.radius2.most) +
                           3 * box.scaleMost * coc.gain * (base + coc.front * reach));
    deviation.curved = second * length * length / 8 * width;
    return deviation;
}

}  // namespace defocus
