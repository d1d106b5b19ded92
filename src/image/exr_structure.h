#pragma once
// Checks the attributes of an EXR header before OpenEXR reads them. OpenEXR ignores the stored byte count of most
// attribute types, and allocates up to 2 GiB if a byte count is damaged.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace defocus::engine {

// Throws Error, with `name` in its message, if an attribute exceeds the file or has the wrong size for its type, or if
// the rows are wider than 2²⁰ px. `head` is the start of a file of `fileBytes` bytes and may end within the header.
// OpenEXR detects other faults.
void checkExrHeader(std::span<const std::byte> head, std::uint64_t fileBytes, const std::string& name);

inline constexpr std::size_t usualHeadBytes = std::size_t{1} << 16;

// Checks the EXR header in the first `headBytes` bytes of the file `path`, or in the complete file if it is shorter.
void checkExrHeader(const std::filesystem::path& path, std::size_t headBytes = usualHeadBytes);

}  // namespace defocus::engine
