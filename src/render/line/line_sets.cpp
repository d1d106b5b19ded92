#include "render/line/line_sets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr int angleSteps = 4096;  // size of the table of lightUpToAngles()

// Returns the area of a narrow circular sector with this radius, up to a constant factor.
double areaAt(double radius) {
    return radius * radius;
}

// Returns a table whose entry i is the fraction of the aperture's light on lines with angles from 0 to i·π/angleSteps.
std::vector<double> lightUpToAngles(const Aperture& aperture) {
    std::vector<double> sums(angleSteps + 1, 0.0);
    for (std::size_t i = 0; i < angleSteps; ++i) {
        const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / angleSteps;
        sums[i + 1] =
            sums[i] + areaAt(apertureRim(aperture, angle)) + areaAt(apertureRim(aperture, angle + std::numbers::pi));
    }
    for (double& sum : sums) sum /= sums.back();
    sums.back() = 1;
    return sums;
}

double angleOfShare(const std::vector<double>& sums, double share) {
    const auto found = std::upper_bound(sums.begin() + 1, sums.end() - 1, share);
    const double before = *(found - 1);
    const double place = (share - before) / (*found - before);
    return std::numbers::pi * (static_cast<double>(found - 1 - sums.begin()) + place) / angleSteps;
}

// For one line of a wagon wheel: the line's position in the pixel, and the positions of its shading points.
struct WheelPoint {
    glm::dvec2 pixel{0};  // position in the pixel, [0, 1)
    double shading = 0;   // GpuRay::values.z, [0, 1); see line_sets.h
};

// Returns one point per line of the wagon wheel (line_sets.h). Two coordinates of the low-discrepancy sequence are the
// positions in the pixel. A third coordinate assigns positions to lines, so that they are also well distributed over
// the wheel. Shading positions advance by the golden ratio from line to line.
std::vector<WheelPoint> wheelPoints(const RenderSettings& settings, std::uint32_t variant, std::uint32_t lines) {
    std::vector<SequencePoint> points;
    for (std::uint32_t line = 0; line < lines; ++line)
        points.push_back(sequencePoint(settings.sequence,
                                       std::uint64_t{settings.firstSample} + std::uint64_t{variant} * lines + line,
                                       settings.seed));
    const double start = points.front().time;
    std::ranges::sort(points, {}, [](const SequencePoint& point) { return point.pixel.x; });
    std::vector<WheelPoint> wheel;
    for (const SequencePoint& point : points) {
        const double shading = start + static_cast<double>(wheel.size()) * (std::numbers::phi - 1);
        wheel.push_back({point.lens, shading - std::floor(shading)});
    }
    return wheel;
}

}  // namespace

double apertureRim(const Aperture& aperture, double angle) {
    if (aperture.bladeCount < 3) return 1;
    const double blade = 2 * std::numbers::pi / aperture.bladeCount;  // angle between corners; one corner is at angle 0
    const double fromMiddle = angle - (std::floor(angle / blade) + 0.5) * blade;
    return (1 - aperture.bladeCurvature) * std::cos(blade / 2) / std::cos(fromMiddle) + aperture.bladeCurvature;
}

LineSets lineSets(const FramePlan& plan, bool turned, std::uint32_t linesPerPosition) {
    const Aperture aperture = plan.usesLens ? makeAperture(plan.view.lens) : Aperture{};
    if (aperture.image.rows > 0)
        fail("method line: aperture images are not supported; use --blades instead, or method stochastic");
    const std::vector<double> sums = lightUpToAngles(aperture);
    const auto count = static_cast<std::uint32_t>(plan.samples.size());
    const auto aspect = static_cast<float>(plan.view.width) / static_cast<float>(plan.view.height);
    LineSets lines;
    RaySets& sets = lines.sets;
    sets.rays = count;
    sets.variants = turned ? variantCount(count) : 1;
    sets.table.resize(std::size_t{count} * sets.variants);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    sets.lensBounds.assign(count, {infinity, infinity, -infinity, -infinity});
    const std::vector<std::uint32_t> order = spreadOrder(count);
    std::vector<glm::vec2> ways(sets.variants);
    std::vector<std::vector<WheelPoint>> wheels;
    for (std::uint32_t variant = 0; variant < sets.variants; ++variant)
        wheels.push_back(wheelPoints(plan.settings, variant, count));
    const std::uint32_t positions = (count + linesPerPosition - 1) / linesPerPosition;
    // Take every n-th point. wheelPoints() sorts by one coordinate of the sequence, so its first points cover only a
    // part of this coordinate's range.
    const auto positionOf = [&](std::uint32_t variant, std::uint32_t angle) {
        return wheels[variant][angle % positions * count / positions].pixel;
    };
    for (std::uint32_t line = 0; line < count; ++line) {
        float longest = 0;
        for (std::uint32_t variant = 0; variant < sets.variants; ++variant) {
            const double turn = (variant + 0.5) / sets.variants;
            const double angle = angleOfShare(sums, (order[line] + turn) / count);
            const double ahead = apertureRim(aperture, angle);
            const double behind = apertureRim(aperture, angle + std::numbers::pi);
            const double direction = angle + aperture.bladeRotation;
            glm::dvec2 way = ahead * glm::dvec2(std::cos(direction), std::sin(direction));
            if (aperture.anamorphicRatio > 1) way.x /= aperture.anamorphicRatio;
            if (aperture.anamorphicRatio < 1) way.y *= aperture.anamorphicRatio;
            if (!plan.usesLens) way = glm::dvec2(0);
            const WheelPoint& point = wheels[variant][order[line]];
            const auto backward = static_cast<float>(behind / ahead);
            const glm::vec2 lens(way.x, aspect * way.y);
            sets.table[std::size_t{line} * sets.variants + variant] = {
                glm::vec4(lens, glm::vec2(positionOf(variant, order[line])) - 0.5f),
                glm::vec4(backward, areaAt(ahead) / (areaAt(ahead) + areaAt(behind)), point.shading, 0)};
            glm::vec4& bounds = sets.lensBounds[line];
            for (const glm::vec2& end : {lens, -backward * lens})
                bounds = {std::min(bounds.x, end.x), std::min(bounds.y, end.y), std::max(bounds.z, end.x),
                          std::max(bounds.w, end.y)};
            ways[variant] = way;
            longest = std::max(longest, std::max(1.0f, backward));
        }
        glm::vec2 mean(0);
        for (const glm::vec2& way : ways) mean += way;
        const glm::vec2 across = glm::length(mean) > 0 ? glm::normalize(glm::vec2(-mean.y, mean.x)) : glm::vec2(1, 0);
        float leaves = 0;
        for (const glm::vec2& way : ways) leaves = std::max(leaves, std::abs(glm::dot(way, across)));
        lines.strips.emplace_back(across, leaves * longest, 0);
    }
    return lines;
}

}  // namespace defocus::engine
