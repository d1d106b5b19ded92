// Bentley 1975, Multidimensional Binary Search Trees Used for Associative Searching.

#include "plan/lens_cells/lens_groups.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace defocus::engine {

namespace {

int longerSide(std::span<const LensSample> samples, std::span<const std::uint32_t> members) {
    glm::vec2 min(std::numeric_limits<float>::infinity());
    glm::vec2 max = -min;
    for (const std::uint32_t index : members) {
        min = glm::min(min, samples[index].lens);
        max = glm::max(max, samples[index].lens);
    }
    return max.x - min.x >= max.y - min.y ? 0 : 1;
}

// Points may coincide in one coordinate: their number decides then, so that the order is the same everywhere.
void sortAlong(int side, std::span<const LensSample> points, std::span<std::uint32_t> members) {
    std::ranges::sort(members, [&](std::uint32_t a, std::uint32_t b) {
        const float atA = points[a].lens[side];
        const float atB = points[b].lens[side];
        return atA != atB ? atA < atB : a < b;
    });
}

struct Grouping {
    std::span<const LensSample> samples;
    std::span<const LensSample> images;
    std::uint32_t groupSize = 1;
    std::vector<std::vector<std::uint32_t>> groups;  // one an image: numbers of samples

    [[nodiscard]] std::size_t sizeOf(std::uint32_t image) const {
        const std::size_t before = std::size_t{image} * groupSize;
        return std::min<std::size_t>(groupSize, samples.size() - before);
    }

    // Gives each of the images as many of the members as its group has.
    void divide(std::span<std::uint32_t> members, std::span<std::uint32_t> of) {
        if (of.size() == 1) {
            groups[of[0]].assign(members.begin(), members.end());
            std::ranges::sort(groups[of[0]]);
            return;
        }
        const int side = longerSide(samples, members);
        sortAlong(side, samples, members);
        sortAlong(side, images, of);
        const std::size_t half = of.size() / 2;
        std::size_t share = 0;
        for (const std::uint32_t image : of.first(half)) share += sizeOf(image);
        divide(members.first(share), of.first(half));
        divide(members.subspan(share), of.subspan(half));
    }
};

std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> result(count);
    std::iota(result.begin(), result.end(), 0u);
    return result;
}

}  // namespace

std::vector<std::uint32_t> groupedOrder(std::span<const LensSample> samples, std::span<const LensSample> images,
                                        std::uint32_t groupSize) {
    assert(groupSize >= 1 && images.size() == (samples.size() + groupSize - 1) / groupSize);
    if (samples.empty()) return {};
    Grouping grouping{samples, images, groupSize, std::vector<std::vector<std::uint32_t>>(images.size())};
    std::vector<std::uint32_t> members = numbers(samples.size());
    std::vector<std::uint32_t> of = numbers(images.size());
    grouping.divide(members, of);
    std::vector<std::uint32_t> order;
    order.reserve(samples.size());
    for (const std::vector<std::uint32_t>& group : grouping.groups)
        order.insert(order.end(), group.begin(), group.end());
    return order;
}

}  // namespace defocus::engine
