#pragma once
// Queries the free memory of the current context's device, if the driver reports it.

#include <cstdint>
#include <functional>
#include <optional>

namespace defocus::engine {

// Returns free bytes from GL_NVX_gpu_memory_info or GL_ATI_meminfo. Returns nullopt for software drivers, which use
// main memory.
std::optional<std::uint64_t> freeDeviceMemory();

// Same as freeDeviceMemory, but with callbacks instead of the driver: `has` tests for an extension; `query` returns the
// first value of glGetIntegerv(name). Returns nullopt if `query` returns no plausible value.
std::optional<std::uint64_t> freeDeviceMemoryOf(const std::function<bool(const char* extension)>& has,
                                                const std::function<int(unsigned name)>& query);

}  // namespace defocus::engine
