#pragma once
// Free memory of the current context's device, if its driver reports it.

#include <cstdint>
#include <functional>
#include <optional>

namespace defocus::engine {

// Returns free bytes from GL_NVX_gpu_memory_info or GL_ATI_meminfo. Returns nullopt for software drivers, which use
// main memory.
std::optional<std::uint64_t> freeDeviceMemory();

// Same as freeDeviceMemory, with the driver's answers from callbacks: `has` tests for an extension; `query` returns the
// first value of glGetIntegerv(name). Returns nullopt if the driver reports no plausible value.
std::optional<std::uint64_t> freeDeviceMemoryOf(const std::function<bool(const char* extension)>& has,
                                                const std::function<int(unsigned name)>& query);

}  // namespace defocus::engine
