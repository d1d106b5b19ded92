#pragma once
// The chunks of a PNG file, checked before libpng sees them: it would print its complaints to stderr by itself.
// W3C: "Portable Network Graphics (PNG) Specification", section 5.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace defocus::engine {

// A copy of the PNG file `encoded` with the chunks that its pixels and texts need (colour profiles, which libpng
// comments on, are left out). Throws Error with `name` for a truncated file, a wrong checksum or a missing chunk.
std::vector<unsigned char> checkedPng(std::span<const std::byte> encoded, const std::string& name);

}  // namespace defocus::engine
