#include "plan/lens_cells/even_division.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace defocus::engine {

namespace {

int longerSide(std::span<const LensSample> points, std::span<const std::uint32_t> members) {
    glm::vec2 min(std::numeric_limits<float>::infinity());
    glm::vec2 max = -min;
    for (const std::uint32_t index : members) {
        min = glm::min(min, points[index].lens);
        max = glm::max(max, points[index].lens);
    }
    return max.x - min.x >= max.y - min.y ? 0 : 1;
}

// Sorts the indices `members` by their points' lens coordinate x (side 0) or y (side 1). Ties are sorted by index, so
// that the order is the same on all platforms.
void sortAlong(int side, std::span<const LensSample> points, std::span<std::uint32_t> members) {
    std::ranges::sort(members, [&](std::uint32_t a, std::uint32_t b) {
        const float atA = points[a].lens[side];
        const float atB = points[b].lens[side];
        return atA != atB ? atA < atB : a < b;
    });
}

struct Division {
    std::span<const LensSample> points;
    std::span<const LensSample> centres;
    std::uint32_t share = 1;
    std::vector<std::uint32_t> order;

    // Assigns `share` points to each centre. `members` are the indices of the points, `among` the indices of the
    // centres.
    void divide(std::span<std::uint32_t> members, std::span<std::uint32_t> among) {
        if (among.size() == 1) {
            std::ranges::sort(members);
            std::ranges::copy(members, order.begin() + std::ptrdiff_t{among[0]} * share);
            return;
        }
        const int side = longerSide(points, members);
        sortAlong(side, points, members);
        sortAlong(side, centres, among);
        const std::size_t half = among.size() / 2;
        divide(members.first(half * share), among.first(half));
        divide(members.subspan(half * share), among.subspan(half));
    }
};

std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> result(count);
    std::iota(result.begin(), result.end(), 0u);
    return result;
}

}  // namespace

std::vector<std::uint32_t> evenDivision(std::span<const LensSample> points, std::span<const LensSample> centres,
                                        std::uint32_t share) {
    assert(share >= 1 && points.size() == centres.size() * share);
    if (points.empty()) return {};
    Division division{points, centres, share, std::vector<std::uint32_t>(points.size())};
    std::vector<std::uint32_t> members = numbers(points.size());
    std::vector<std::uint32_t> among = numbers(centres.size());
    division.divide(members, among);
    return division.order;
}

}  // namespace defocus::engine
