#pragma once
// Measures available and used memory, and parses and formats memory sizes.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Returns the bytes that the process can still allocate, limited by the machine's available memory and by the process's
// control groups (cgroups); 0 if unknown.
std::uint64_t freeMemory();

// Returns the bytes left under the memory limit of the control group in `folder`; nullopt without a limit. Inactive
// file cache counts as free. `unified`: true for cgroup v2, false for v1.
std::optional<std::uint64_t> leftByControlGroup(const std::string& folder, bool unified);

// Returns the resident memory of this process in bytes.
std::uint64_t residentMemory();

// Parses a memory size such as "2GiB" or "1500 MB". Units: B, kB, MB, GB, TB (powers of 1000), K, M, G, T or
// KiB, MiB, GiB, TiB (powers of 1024). Throws Error for other text, and for sizes below 1 byte or above 2⁶² bytes.
std::uint64_t parseBytes(std::string_view text);

// Formats a size as "2 GiB" or "1.5 MiB".
std::string bytesText(std::uint64_t bytes);

}  // namespace defocus::engine
