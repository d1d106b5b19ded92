// Source: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization. There, the
// circle of confusion has the opposite sign.

#include "lens/circle_of_confusion.h"

#include <algorithm>
#include <cmath>

#include "lens/aberrations.h"
#include "lens/wavelengths.h"

namespace defocus::engine {

namespace {

struct Interval {
    double min = 0;
    double max = 0;
};

Interval sum(const Interval& p, const Interval& q) {
    return {p.min + q.min, p.max + q.max};
}

Interval times(const Interval& p, double factor) {
    return factor >= 0 ? Interval{p.min * factor, p.max * factor} : Interval{p.max * factor, p.min * factor};
}

// Returns the product of two intervals; `factor` must be ≥ 0.
Interval times(const Interval& p, const Interval& factor) {
    return {p.min * (p.min < 0 ? factor.max : factor.min), p.max * (p.max < 0 ? factor.min : factor.max)};
}

Interval squared(const Interval& p) {
    const double far = std::max(std::abs(p.min), std::abs(p.max));
    const double near = p.min <= 0 && p.max >= 0 ? 0 : std::min(std::abs(p.min), std::abs(p.max));
    return {near * near, far * far};
}

// Ranges of the terms of the circle of confusion (CoC) over a bounding box. circle_of_confusion.h gives the equations.
struct Parts {
    Interval radius2;  // r², squared distance from the image's centre
    Interval factor;   // surface's blur factor times the radial blur gain 1 + g·r²
    Interval front;    // F = a/w + b₁·q: signed CoC / image width of points in front of the focus plane
    Interval behind;   // B = a₂/w + b₂·q: signed CoC / image width of points behind the focus plane
};

Parts partsOver(const ClipCircleOfConfusion& coc, const CocBox& box) {
    const Interval x{box.ndcMin.x, box.ndcMax.x};
    const Interval y{box.ndcMin.y, box.ndcMax.y};
    const Interval inverseDepth{1 / box.zFar, 1 / box.zNear};
    Parts parts;
    if (coc.varies()) parts.radius2 = sum(squared(x), times(squared(y), 1 / (coc.aspect * coc.aspect)));
    Interval focus{1, 1};
    if (coc.curvature != 0) focus = sum(focus, times(parts.radius2, coc.curvature));
    if (coc.tilt.x != 0) focus = sum(focus, times(x, coc.tilt.x));
    if (coc.tilt.y != 0) focus = sum(focus, times(y, coc.tilt.y));
    parts.factor = sum({1, 1}, times(parts.radius2, coc.gain));
    parts.factor = {parts.factor.min * box.own.factorMin, parts.factor.max * box.own.factorMax};
    parts.front = sum(times(inverseDepth, coc.a), times(focus, coc.front));
    parts.behind = sum(times(inverseDepth, coc.aBehind), times(focus, coc.behind));
    if (coc.chromatic > 0) {
        const double spread = coc.chromatic * std::max(std::abs(focus.min), std::abs(focus.max));
        parts.front = sum(parts.front, {-spread, spread});
        parts.behind = sum(parts.behind, {-spread, spread});
    }
    return parts;
}

// Returns the range of the signed CoC diameter over the box, as a fraction of the image's width. The limits of
// foreground and background blur are not applied.
Interval unlimitedBlur(const Parts& parts, const OwnBlur& own) {
    const Interval ofLens = times({std::min(0.0, parts.front.min) + std::max(0.0, parts.behind.min),
                                   std::min(0.0, parts.front.max) + std::max(0.0, parts.behind.max)},
                                  parts.factor);
    return sum(ofLens, {own.addedMin, own.addedMax});
}

bool strictlyInside(const Interval& p, double value) {
    return p.min < value && value < p.max;
}

}  // namespace

bool ClipCircleOfConfusion::thinLens() const {
    return !hasFocusRange() && !varies() && std::isinf(foregroundLimit) && std::isinf(backgroundLimit);
}

bool ClipCircleOfConfusion::varies() const {
    return tilt != glm::dvec2(0) || curvature != 0 || gain != 0 || aberrates();
}

ClipCircleOfConfusion clipCircleOfConfusion(const Lens& lens, int width, int height) {
    const double tanX = tanHalfHorizontalFov(lens);
    const double aspect = static_cast<double>(width) / height;
    ClipCircleOfConfusion coc;
    coc.a = -0.5 * apertureDiameter(lens) / tanX;
    coc.front = -coc.a / (lens.focusDistance - (std::isinf(lens.focusDistance) ? 0 : lens.focusRangeFront));
    const bool refocuses = lens.focusRangeRefocuses;
    coc.aBehind = refocuses ? coc.a : coc.a * (1 + lens.focusRangeBehind / lens.focusDistance);
    coc.behind = -coc.a / (lens.focusDistance + (refocuses ? lens.focusRangeBehind : 0));
    coc.tilt = glm::dvec2(std::tan(lens.focusSwing) * tanX, std::tan(lens.focusTilt) * tanX / aspect);
    coc.curvature = lens.fieldCurvature;
    coc.gain = lens.radialBlurGain;
    coc.foregroundLimit = lens.foregroundLimit / width;
    coc.backgroundLimit = lens.backgroundLimit / width;
    coc.aspect = aspect;
    coc.shareOfMillimetre = lens.dofEnabled ? lens.blurScale / lens.horizontalAperture : 0;
    coc.astigmatism = lens.astigmatism * coc.shareOfMillimetre;
    coc.coma = comaOfTail(lens.coma * coc.shareOfMillimetre);
    coc.chromatic = std::abs(chromaticShift(coc.a, lens.axialChromaticAberration, 1));
    return coc;
}

double circleOfConfusion(const ClipCircleOfConfusion& coc, double z, int width, const glm::dvec2& ndc, double factor,
                         double added) {
    const double radius2 = ndc.x * ndc.x + ndc.y * ndc.y / (coc.aspect * coc.aspect);
    const double focus = 1 + coc.curvature * radius2 + coc.tilt.x * ndc.x + coc.tilt.y * ndc.y;
    const double front = coc.a / z + coc.front * focus;
    const double behind = coc.aBehind / z + coc.behind * focus;
    const double blur = factor * (1 + coc.gain * radius2) * (std::min(0.0, front) + std::max(0.0, behind)) + added;
    return std::clamp(blur, -coc.foregroundLimit, coc.backgroundLimit) * width;
}

OwnBlur ownBlur(const ClipCircleOfConfusion& coc, double factor, const VertexBlurBounds& vertices) {
    const double share = factor * coc.shareOfMillimetre;
    return {factor * vertices.factorMin, factor * vertices.factorMax, share * vertices.addedMin,
            share * vertices.addedMax};
}

CocRange circleOfConfusionRange(const ClipCircleOfConfusion& coc, const CocBox& box, int width) {
    const Parts parts = partsOver(coc, box);
    const Interval blur = unlimitedBlur(parts, box.own);
    const double aberration = aberrationReach(coc, std::sqrt(parts.radius2.max));
    CocRange range;
    range.nearest = (std::clamp(blur.min, -coc.foregroundLimit, coc.backgroundLimit) - aberration) * width;
    range.farthest = (std::clamp(blur.max, -coc.foregroundLimit, coc.backgroundLimit) + aberration) * width;
    const bool straddles = range.nearest <= 0 && range.farthest >= 0;
    range.smallest = straddles ? 0 : std::min(std::abs(range.nearest), std::abs(range.farthest));
    range.largest = std::max(std::abs(range.nearest), std::abs(range.farthest));
    return range;
}

ClipCircleOfConfusion refocused(const ClipCircleOfConfusion& coc, double focusDistance) {
    ClipCircleOfConfusion result = coc;
    result.front = result.behind = -coc.a / focusDistance;
    return result;
}

double largestCocAtInfinity(const ClipCircleOfConfusion& coc, int width) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return circleOfConfusionRange(coc, {infinity, infinity, glm::dvec2(-1), glm::dvec2(1)}, width).largest;
}

CocDeviation cocDeviation(const ClipCircleOfConfusion& coc, const CocBox& box, double longestEdge,
                          const glm::dvec2& tanHalf, int width) {
    CocDeviation deviation;
    if (coc.thinLens() && !box.own.varies()) return deviation;
    const Parts parts = partsOver(coc, box);
    const double pixels = width / box.zNear;
    const double factor = parts.factor.max;

    // Bound the error of interpolating the clip-space blur C (CoC · depth) at kinks, where its slope jumps: at the ends
    // of the focus range and at the blur limits. Along an edge of length L, the error is largest for a kink in the
    // middle: (change of slope)·L/4.
    const Interval added{box.own.addedMin, box.own.addedMax};
    const double maxAdded = std::max(std::abs(added.min), std::abs(added.max));
    const double unscaled =
        coc.front * (1 + std::abs(coc.tilt.x) / tanHalf.x + std::abs(coc.tilt.y) / tanHalf.y +
                     std::abs(coc.curvature) * parts.radius2.max * (1 + 2 / std::min(tanHalf.x, tanHalf.y)));
    const double slope = factor * unscaled;
    double change = 0;
    const auto kinkAt = [&](double limit) {
        if (strictlyInside(unlimitedBlur(parts, box.own), limit))
            change = std::max(change, slope + maxAdded + std::abs(limit));
    };
    kinkAt(-coc.foregroundLimit);
    kinkAt(coc.backgroundLimit);
    if (coc.hasFocusRange() && (strictlyInside(parts.front, 0) || strictlyInside(parts.behind, 0)))
        change = std::max(change, slope);
    // Blur modifiers (factor and added blur) that vary along an edge increase the error at a kink. `ownChange` bounds
    // the change of the CoC that they cause.
    const double base = std::max(std::abs(parts.front.min), std::abs(parts.behind.max));
    const double gained = 1 + coc.gain * parts.radius2.max;
    const double factors = box.own.factorMax - box.own.factorMin;
    const double ownChange = factors * gained * base + added.max - added.min;
    deviation.kinks = change * longestEdge / 4 * pixels;
    if (change > 0) deviation.kinks += ownChange / 4 * (width + longestEdge * pixels);

    // Bound the error where C is curved. A function with second derivatives of at most H deviates from a chord of
    // length L by at most H·L²/8. Field curvature, radial blur gain and astigmatism add terms in r²·w to C, where w is
    // the depth and r the distance from the image's centre. If lengths are measured in clip space relative to the
    // nearest depth, the second derivatives of r²·w are at most 2·(1 + r)².
    const double length = longestEdge / box.zNear * (1 + 1 / std::min(tanHalf.x, tanHalf.y));
    const double reach = 1 + std::sqrt(parts.radius2.max);
    const double second = 2 * reach * reach *
                          (box.own.factorMax * coc.front * std::abs(coc.curvature) * gained +
                           3 * box.own.factorMax * coc.gain * (base + coc.front * reach) + std::abs(coc.astigmatism));
    deviation.curved = second * length * length / 8 * width;

    // Bound the error of blur modifiers that vary along an edge. Inside a triangle, each modifier is linear: the factor
    // multiplies C, and the added blur multiplies the depth w. A product of two linear functions deviates from linear
    // interpolation along an edge by at most a quarter of the product of their changes. The curvature of C itself is
    // bounded above.
    const double ofGain = 2 * coc.gain * reach * base * (1 + 1 / std::min(tanHalf.x, tanHalf.y));
    const double products = factors * (gained * unscaled + ofGain) + added.max - added.min;
    deviation.curved += products * longestEdge / 4 * pixels;
    return deviation;
}

}  // namespace defocus::engine
