#pragma once
// How much memory the device of the current context still has, where its driver says.

#include <cstdint>
#include <optional>

namespace defocus {

// Bytes, by GL_NVX_gpu_memory_info or GL_ATI_meminfo. None on a software driver, which draws in main memory.
std::optional<std::uint64_t> freeDeviceMemory();

}  // namespace defocus
