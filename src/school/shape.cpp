// Evaluates the outline, the skin relief and the bent spine of a fish. The outline is interpolated with the method of
// Fritsch and Carlson, Monotone Piecewise Cubic Interpolation (1980), which does not overshoot the knots.

#include "school/shape.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "school/random.h"

namespace defocus::engine {
namespace {

constexpr float originA = 0.45f;  // body position, 0 (snout) to 1 (tail), of the point that bending leaves in place

float monotoneCubic(const std::array<float, 9>& x, const std::array<float, 9>& y, float at) {
    const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    const auto tangent = [&](std::size_t i) {
        if (i == 0) return slope(0);
        if (i + 1 == x.size()) return slope(i - 1);
        const float before = slope(i - 1);
        const float after = slope(i);
        return before * after <= 0.0f ? 0.0f : 2.0f * before * after / (before + after);
    };
    std::size_t i = 0;
    while (i + 2 < x.size() && at > x[i + 1]) ++i;
    const float width = x[i + 1] - x[i];
    const float t = glm::clamp((at - x[i]) / width, 0.0f, 1.0f);
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2.0f * t3 - 3.0f * t2 + 1.0f) * y[i] + (t3 - 2.0f * t2 + t) * width * tangent(i) +
           (3.0f * t2 - 2.0f * t3) * y[i + 1] + (t3 - t2) * width * tangent(i + 1);
}

const std::array<float, 9>& knotRoots() {
    static const std::array<float, 9> roots = [] {
        std::array<float, 9> values{};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sqrt(fishKnots[i]);
        return values;
    }();
    return roots;
}

float bell(float distance, float width) {
    const float x = distance / width;
    return std::exp(-x * x);
}

float distanceToSegment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 ab = b - a;
    const float t = glm::clamp(glm::dot(p - a, ab) / std::max(glm::dot(ab, ab), 1e-12f), 0.0f, 1.0f);
    return glm::length(p - a - t * ab);
}

// Adds the fish's scales to the relief. They overlap like roof tiles: each scale covers the front of the scale behind
// it. Scales are disks; at each point of the skin, the foremost disk that contains it is visible.
void addScales(const FishShape& shape, float a, float alongGirth, float detail, FishRelief& relief) {
    const float behindGill = glm::smoothstep(shape.gillA * 0.97f, shape.gillA * 1.12f, a);
    const float beforeTail = 1.0f - glm::smoothstep(0.93f, 1.0f, a);
    const float held = 1.0f - glm::smoothstep(0.22f, 0.5f, detail / shape.scaleSize);
    const float strength = behindGill * beforeTail * held;
    if (strength <= 0.0f) return;
    constexpr float radius = 0.66f;  // radius of a scale, relative to the distance between scales (scaleSize)
    constexpr float rowHeight = 0.56f;
    const glm::vec2 p(a / shape.scaleSize, alongGirth / shape.scaleSize);
    const int row = static_cast<int>(std::floor(p.y / rowHeight + 0.5f));
    glm::vec2 centre(1e9f, 0.0f);
    glm::ivec2 cell(0);
    for (int k = row - 1; k <= row + 1; ++k) {
        const float y = rowHeight * static_cast<float>(k);
        const float stagger = (k & 1) != 0 ? 0.5f : 0.0f;
        const float reach = std::sqrt(std::max(radius * radius - (p.y - y) * (p.y - y), 0.0f));
        const float x = std::ceil(p.x - reach - stagger) + stagger;
        if (std::abs(p.x - x) <= reach && x < centre.x) {
            centre = {x, y};
            cell = {static_cast<int>(std::floor(x)), k};
        }
    }
    const float inside = 1.0f - glm::length(p - centre) / radius;
    const float backwards = glm::clamp(0.5f + 0.5f * (p.x - centre.x) / radius, 0.0f, 1.0f);
    const float edge = glm::smoothstep(0.0f, 0.2f, inside);
    relief.displacement += 0.075f * shape.scaleSize * strength * (backwards * backwards * edge - 0.4f);
    relief.groove = std::max(relief.groove, 0.5f * strength * (1.0f - edge));
    relief.scaleEdge = strength * edge * (1.0f - glm::smoothstep(0.15f, 0.55f, inside)) * backwards;
    relief.scaleTone = strength * (2.0f * latticeValue(cell.x, cell.y, 17u) - 1.0f);
}

void addHead(const FishShape& shape, const glm::vec2& p, float detail, FishRelief& relief) {
    const float fine = std::max(0.007f, 1.4f * detail);
    // Add the mouth: a groove between two lips.
    const FishSection snout = fishSection(shape, 0.01f);
    const glm::vec2 corner(shape.mouthLength, snout.centre - shape.mouthDrop);
    const float mouth = distanceToSegment(p, glm::vec2(-0.05f, snout.centre), corner);
    const float grooveMouth = bell(mouth, fine);
    relief.displacement += 0.006f * bell(mouth - 2.2f * fine, 1.3f * fine) - 0.009f * grooveMouth;
    // Add the eye socket: a soft ridge around the eye, with a groove inside it.
    const FishSection eyeSection = fishSection(shape, shape.eyeA);
    const glm::vec2 eye(shape.eyeA, eyeSection.centre + shape.eyeHeight * eyeSection.halfHeight);
    const float toEye = glm::length(p - eye);
    relief.displacement += 0.006f * bell(toEye - 1.15f * shape.eyeRadius, std::max(0.3f * shape.eyeRadius, fine));
    const float grooveEye = 0.6f * bell(toEye - 0.95f * shape.eyeRadius, std::max(0.16f * shape.eyeRadius, fine));
    // Add the gill cover: a plate with a step at its rear edge and a fold of the cheek in front of it.
    const FishSection gill = fishSection(shape, shape.gillA * 0.8f);
    const glm::vec2 hinge(shape.gillA * 0.52f, gill.centre + 0.05f * gill.halfHeight);
    const glm::vec2 reach(shape.gillA * 0.48f, 0.68f * gill.halfHeight);
    const glm::vec2 q = (p - hinge) / reach;
    const float rho = glm::length(q);
    const float rear = glm::smoothstep(-0.15f, 0.35f, q.x);
    const float soft = fine / reach.x;
    const float plate = glm::smoothstep(0.55f, 0.97f, rho) * (1.0f - glm::smoothstep(1.0f, 1.0f + 1.6f * soft, rho));
    const float grooveGill = rear * bell(rho - 1.0f - 1.5f * soft, 1.2f * soft);
    const float grooveCheek = 0.45f * rear * bell(rho - 0.62f, soft);
    relief.displacement += rear * 0.011f * plate - 0.007f * grooveGill - 0.003f * grooveCheek;
    relief.groove = std::max({relief.groove, grooveMouth, grooveEye, grooveGill, grooveCheek});
}

}  // namespace

FishSection fishSection(const FishShape& shape, float a) {
    const float root = std::sqrt(glm::clamp(a, 0.0f, 1.0f));
    float top = monotoneCubic(knotRoots(), shape.outline.top, root);
    float bottom = monotoneCubic(knotRoots(), shape.outline.bottom, root);
    float width = monotoneCubic(knotRoots(), shape.outline.width, root);
    // The body gets thinner towards the tail fin. The body's end, hidden inside the fin, is rounded.
    width *= 1.0f - 0.62f * glm::smoothstep(0.86f, 0.98f, a);
    constexpr float roundFrom = 0.975f;
    if (a > roundFrom) {
        const float t = std::min((a - roundFrom) / (1.0f - roundFrom), 1.0f);
        const float shrink = std::sqrt(std::max(1.0f - t * t, 0.0f));
        top *= shrink;
        bottom *= shrink;
        width *= shrink;
    }
    return {.centre = 0.5f * (top - bottom), .halfHeight = 0.5f * (top + bottom), .halfWidth = width};
}

FishRelief fishRelief(const FishShape& shape, const FishSkinPoint& point, float detail) {
    FishRelief relief;
    addScales(shape, point.a, point.alongGirth, detail, relief);
    if (point.a < 1.4f * shape.gillA) addHead(shape, {point.a, point.y}, detail, relief);
    // Add the lateral line: a fine groove along the flank that rises towards the head.
    const float rise = 0.34f - 0.34f * glm::smoothstep(0.35f, 0.9f, point.a);
    const float held =
        glm::smoothstep(shape.gillA, shape.gillA + 0.08f, point.a) * (1.0f - glm::smoothstep(0.9f, 0.98f, point.a));
    const float groove = held * bell((point.height - rise) * point.halfHeight, std::max(0.004f, 1.2f * detail));
    relief.displacement -= 0.0022f * groove;
    relief.groove = std::max(relief.groove, 0.5f * groove);
    return relief;
}

FishSpine::FishSpine(const FishShape& shape) {
    // Returns the heading along the spine in radians. The swimming wave grows from head to tail. The uniform bend adds
    // an angle that is zero at the body position originA.
    const auto heading = [&](float a) {
        const float envelope = glm::smoothstep(0.1f, 1.25f, a) + 0.08f;
        return shape.turn * (a - originA) +
               shape.swimAmplitude * envelope * std::sin(5.2f * std::min(a, 1.7f) - shape.swimPhase);
    };
    constexpr float step = (last - first) / static_cast<float>(steps);
    glm::vec2 position(0.0f);
    for (int i = 0; i <= steps; ++i) {
        const float a = first + step * static_cast<float>(i);
        table_[static_cast<std::size_t>(i)] = {position, heading(a)};
        const float middle = heading(a + 0.5f * step);
        position += step * glm::vec2(-std::cos(middle), std::sin(middle));
    }
    const glm::vec3 origin = bend({-originA, 0.0f, 0.0f});
    for (Station& station : table_) station.position -= glm::vec2(origin.x, origin.z);
}

glm::vec3 FishSpine::bend(const glm::vec3& straight) const {
    const float at = (-straight.x - first) / (last - first) * static_cast<float>(steps);
    const float index = glm::clamp(std::floor(at), 0.0f, static_cast<float>(steps - 1));
    const Station& before = table_[static_cast<std::size_t>(index)];
    const Station& after = table_[static_cast<std::size_t>(index) + 1];
    const float t = at - index;  // beyond the table's ends, the spine continues straight
    const glm::vec2 position = glm::mix(before.position, after.position, t);
    const float heading = glm::mix(before.heading, after.heading, glm::clamp(t, 0.0f, 1.0f));
    return {position.x + straight.z * std::sin(heading), straight.y, position.y + straight.z * std::cos(heading)};
}

}  // namespace defocus::engine
