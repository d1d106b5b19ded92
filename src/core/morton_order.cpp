#include "core/morton_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace defocus::engine {

namespace {

// Inserts two zero bits between consecutive bits of the low 10 bits.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000ffu;
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    return (bits | bits << 2) & 0x09249249u;
}

std::uint32_t cellAt(double coordinate) {
    return coordinate > 0 ? static_cast<std::uint32_t>(std::min(coordinate, maxMortonCell)) : 0;
}

}  // namespace

std::uint32_t mortonCode(const glm::dvec3& point) {
    return spread(cellAt(point.x)) | spread(cellAt(point.y)) << 1 | spread(cellAt(point.z)) << 2;
}

void sortByMortonCode(LargeVector<std::uint64_t>& keys) {
    constexpr std::uint64_t digits = 1024;
    LargeVector<std::uint64_t> sorted(keys.size());
    for (int shift = 32; shift < 62; shift += 10) {
        const auto digit = [&](std::uint64_t key) { return (key >> shift) % digits; };
        std::array<std::size_t, digits + 1> starts{};
        for (const std::uint64_t key : keys) ++starts[digit(key) + 1];
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        for (const std::uint64_t key : keys) sorted[starts[digit(key)]++] = key;
        keys.swap(sorted);
    }
}

}  // namespace defocus::engine
