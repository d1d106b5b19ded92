#pragma once
// Checks PNG files before libpng reads them, since libpng prints its errors to stderr. Source: W3C, "Portable Network
// Graphics (PNG) Specification, Second Edition".

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace defocus::engine {

// Returns a copy of the PNG file `encoded` with only the chunks for pixels and text. Colour profiles are dropped
// because libpng prints warnings about them. Throws Error, with `name` in its message, for a truncated file, a wrong
// checksum, an invalid header or palette, or missing or misplaced chunks.
std::vector<unsigned char> checkedPng(std::span<const std::byte> encoded, const std::string& name);

// Decompresses the pixels of a file that checkedPng() returned, row by row. Throws Error, with `name` in its message,
// if the pixels are damaged or incomplete.
void checkPngPixels(std::span<const unsigned char> checked, const std::string& name);

}  // namespace defocus::engine
