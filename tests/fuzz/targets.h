#pragma once
// What bytes of strangers reach, as functions of those bytes: the fuzzer calls them with bytes that it makes up (see
// scripts/fuzz), and a test with those that once did harm (tests/fuzz/corpus). Bytes that are refused with an Error are
// fine. Whatever else happens (another exception, a fault that a sanitizer finds, minutes of work) is a find.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace defocus::engine {

struct FuzzTarget {
    const char* name = "";
    void (*run)(std::span<const std::byte> bytes) = nullptr;
    std::vector<std::vector<std::byte>> (*seeds)() = nullptr;  // to begin from
    std::size_t maxBytes = 0;                                  // more than that finds nothing new
};

//   gltf      a scene's file, placed and planned for a small frame, without and with a ground and shadows
//   shot      a shot file
//   cache     a pyramid's file, with a checksum that fits
//   image     an image file as environment, aperture, tile, and what is compared and merged; the first byte picks the
//             format
//   settings  lines of "name=value" for the table of settings, the values also as those of options beside it
std::span<const FuzzTarget> fuzzTargets();

// Throws Error where there is none of this name.
const FuzzTarget& fuzzTargetNamed(const std::string& name);

}  // namespace defocus::engine
