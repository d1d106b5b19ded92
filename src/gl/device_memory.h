#pragma once
// How much memory the device of the current context still has, where its driver says.

#include <cstdint>
#include <functional>
#include <optional>

namespace defocus::engine {

// Bytes, by GL_NVX_gpu_memory_info or GL_ATI_meminfo. None on a software driver, which draws in main memory.
std::optional<std::uint64_t> freeDeviceMemory();

// The same of a driver that lists an extension where `has` says so, and answers glGetIntegerv(name) with `query(name)`,
// of which only the first number counts. None where it says nothing, or nothing sensible.
std::optional<std::uint64_t> freeDeviceMemoryOf(const std::function<bool(const char* extension)>& has,
                                                const std::function<int(unsigned name)>& query);

}  // namespace defocus::engine
