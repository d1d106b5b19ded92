#pragma once
// Encodes bytes as base64 (RFC 4648).

#include <cstddef>
#include <span>
#include <string>

namespace defocus::engine {

std::string base64(std::span<const std::byte> bytes);

}  // namespace defocus::engine
