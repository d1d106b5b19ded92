#pragma once
// The attributes in the header of an EXR file, checked before OpenEXR sees them: it reads values of most types without
// a look at the size that the file says, and makes room for what a damaged one claims, up to 2 GiB.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace defocus::engine {

// `head` is the beginning of a file of `fileBytes`, as far as it was read. Throws Error, naming `name`, where an
// attribute claims more bytes than the file has, or others than its type takes, or rows have more than 2²⁰ px. Other
// faults are left to who reads on.
void checkExrHeader(std::span<const std::byte> head, std::uint64_t fileBytes, const std::string& name);

}  // namespace defocus::engine
