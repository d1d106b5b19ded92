#include "core/hash.h"

#include <bit>
#include <cstring>

namespace defocus {

namespace {

// Odd numbers without structure: the first 64 bits after the point of the golden ratio, √2 and √3.
constexpr std::uint64_t goldenRatio = 0x9e3779b97f4a7c15ull;
constexpr std::uint64_t rootOfTwo = 0x6a09e667f3bcc909ull;
constexpr std::uint64_t rootOfThree = 0xbb67ae8584caa73bull;

// One to one; every bit of the result depends on every bit of the word.
std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 32)) * goldenRatio;
    word = (word ^ (word >> 29)) * rootOfTwo;
    return word ^ (word >> 32);
}

// One to one in the hash and in the word. The chain from word to word is short: mixing runs beside it.
std::uint64_t chained(std::uint64_t hash, std::uint64_t word) {
    return std::rotl(hash ^ mixed(word), 27) * rootOfThree;
}

}  // namespace

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    const std::uint64_t size = bytes.size();
    std::uint64_t hash = seed;
    while (bytes.size() >= sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), sizeof word);
        hash = chained(hash, word);
        bytes = bytes.subspan(sizeof word);
    }
    if (!bytes.empty()) {
        std::uint64_t rest = 0;
        std::memcpy(&rest, bytes.data(), bytes.size());
        hash = chained(hash, rest);
    }
    return mixed(chained(hash, size));
}

}  // namespace defocus
