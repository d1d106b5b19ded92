#pragma once
// Checks PNG chunks before libpng reads them, since libpng prints its errors to stderr. Source: W3C, "Portable Network
// Graphics (PNG) Specification", section 5.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace defocus::engine {

// Returns a copy of the PNG file `encoded` with only the chunks for pixels and text. Colour profiles are dropped
// because libpng prints warnings about them. Throws Error, with `name` in its message, for a truncated file, a wrong
// checksum or a missing chunk.
std::vector<unsigned char> checkedPng(std::span<const std::byte> encoded, const std::string& name);

}  // namespace defocus::engine
