// Sources: Bentley 1975, Multidimensional Binary Search Trees Used for Associative Searching (bisection of the lens);
// van der Corput 1935 (order of the rays).

#include "render/lens_space/ray_sets.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <span>

namespace defocus::engine {

namespace {

constexpr std::uint32_t maxVariants = 64;
constexpr std::uint32_t minVariants = 4;
constexpr std::uint32_t maxRays = 1u << 18;  // max total number of rays in all variants (sets of rays)

float coordinate(const LensSample& sample, int axis) {
    return axis == 0 ? sample.lens.x : axis == 1 ? sample.lens.y : sample.time;
}

// Sorts samples by recursive bisection along alternating axes, until each part of the lens contains one sample.
void sortIntoParts(std::span<LensSample> samples, int axis, int axes) {
    if (samples.size() < 2) return;
    const std::size_t half = samples.size() / 2;
    std::nth_element(
        samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(half), samples.end(),
        [axis](const LensSample& a, const LensSample& b) { return coordinate(a, axis) < coordinate(b, axis); });
    sortIntoParts(samples.first(half), (axis + 1) % axes, axes);
    sortIntoParts(samples.subspan(half), (axis + 1) % axes, axes);
}

}  // namespace

std::uint32_t variantCount(std::uint32_t rays) {
    return std::clamp(std::bit_floor(std::max(maxRays / std::max(rays, 1u), 1u)), minVariants, maxVariants);
}

std::vector<std::uint32_t> spreadOrder(std::uint32_t count) {
    std::vector<std::uint32_t> order;
    const std::uint32_t whole = std::bit_ceil(std::max(count, 1u));
    const int bits = std::countr_zero(whole);
    for (std::uint32_t i = 0; i < whole; ++i) {
        std::uint32_t reversed = 0;
        for (int bit = 0; bit < bits; ++bit) reversed |= ((i >> bit) & 1u) << (bits - 1 - bit);
        if (reversed < count) order.push_back(reversed);
    }
    return order;
}

std::uint32_t firstRayOfPart(std::uint32_t part, std::uint32_t parts, std::uint32_t total) {
    return static_cast<std::uint32_t>((std::uint64_t{part} * total + parts - 1) / parts);
}

RaySets pointRaySets(const FramePlan& plan, std::uint32_t parts) {
    const auto count = static_cast<std::uint32_t>(plan.samples.size());
    const auto aspect = static_cast<float>(plan.view.width) / static_cast<float>(plan.view.height);
    RaySets sets;
    sets.rays = count;
    sets.variants = variantCount(count);
    sets.table.resize(std::size_t{count} * sets.variants);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    sets.lensBounds.assign(count, {infinity, infinity, -infinity, -infinity});
    std::vector<LensSample> samples = lensSamples(plan.view.lens, plan.settings.sequence, plan.settings.firstSample,
                                                  count * sets.variants, plan.settings.seed);
    if (!plan.usesLens)
        for (LensSample& sample : samples) sample.lens = glm::vec2(0);
    const int axes = plan.moments.empty() ? 2 : 3;
    for (std::uint32_t variant = 0; variant < sets.variants; ++variant) {
        const std::span<LensSample> set = std::span(samples).subspan(std::size_t{variant} * count, count);
        if (parts > 1) std::ranges::sort(set, {}, &LensSample::time);
        for (std::uint32_t part = 0; part < parts; ++part) {
            const std::uint32_t first = firstRayOfPart(part, parts, count);
            const std::span<LensSample> own = set.subspan(first, firstRayOfPart(part + 1, parts, count) - first);
            sortIntoParts(own, 0, axes);
            const std::vector<std::uint32_t> order = spreadOrder(static_cast<std::uint32_t>(own.size()));
            for (std::uint32_t i = 0; i < own.size(); ++i) {
                const LensSample& sample = own[order[i]];
                const std::uint32_t ray = first + i;
                const glm::vec2 lens(sample.lens.x, aspect * sample.lens.y);
                const float time =
                    std::clamp(sample.time * static_cast<float>(parts) - static_cast<float>(part), 0.0f, 1.0f);
                sets.table[std::size_t{ray} * sets.variants + variant] = {glm::vec4(lens, sample.pixel),
                                                                          glm::vec4(time, 0, 0, 0)};
                glm::vec4& bounds = sets.lensBounds[ray];
                bounds = {std::min(bounds.x, lens.x), std::min(bounds.y, lens.y), std::max(bounds.z, lens.x),
                          std::max(bounds.w, lens.y)};
            }
        }
    }
    return sets;
}

}  // namespace defocus::engine
