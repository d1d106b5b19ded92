#pragma once
// Checks EXR header attributes before OpenEXR reads them. OpenEXR ignores the stored size of most types, and allocates
// up to 2 GiB for a damaged size.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace defocus::engine {

// `head` is the start of a file of `fileBytes` bytes; it may be incomplete. Throws Error that names `name` if an
// attribute exceeds the file, has the wrong size for its type, or rows exceed 2²⁰ px. Other faults are left to OpenEXR.
void checkExrHeader(std::span<const std::byte> head, std::uint64_t fileBytes, const std::string& name);

}  // namespace defocus::engine
