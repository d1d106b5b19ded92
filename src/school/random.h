#pragma once
// Generates the random numbers of the fish school: PCG32 (O'Neill 2014), and value noise based on an integer hash. The
// distributions of the standard library are not used, because they differ between implementations.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/hash.h"

namespace defocus::engine {

class FishRandom {
public:
    // Two generators give uncorrelated sequences if their seeds or their stream numbers differ in any bit.
    FishRandom(std::uint32_t seed, std::uint32_t stream) : increment_((std::uint64_t{stream} << 1u) | 1u) {
        next();
        state_ += 0x9e3779b97f4a7c15ull * (std::uint64_t{seed} + 1u);
        next();
    }

    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
    }

    // Returns a random value in [0, 1) with 24 random bits.
    float uniform() { return static_cast<float>(next() >> 8u) * 0x1p-24f; }
    float uniform(float low, float high) { return low + (high - low) * uniform(); }
    // Returns `value` times a random factor in 1 ± `relative`.
    float vary(float value, float relative) { return value * uniform(1.0f - relative, 1.0f + relative); }

private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

// Returns a pseudorandom value in [0, 1) for the lattice point (x, y).
inline float latticeValue(int x, int y, std::uint32_t seed) {
    const std::uint32_t hash =
        lowbias32(seed + 0x9e3779b9u * static_cast<std::uint32_t>(x) + 0x85ebca6bu * static_cast<std::uint32_t>(y));
    return static_cast<float>(hash >> 8u) * 0x1p-24f;
}

// Returns smooth value noise in [0, 1] at `p`; lattice cells have side 1.
inline float valueNoise(const glm::vec2& p, std::uint32_t seed) {
    const glm::vec2 cell = glm::floor(p);
    const glm::vec2 f = p - cell;
    const glm::vec2 s = f * f * (3.0f - 2.0f * f);
    const int x = static_cast<int>(cell.x);
    const int y = static_cast<int>(cell.y);
    return glm::mix(glm::mix(latticeValue(x, y, seed), latticeValue(x + 1, y, seed), s.x),
                    glm::mix(latticeValue(x, y + 1, seed), latticeValue(x + 1, y + 1, seed), s.x), s.y);
}

}  // namespace defocus::engine
