#pragma once
// How much memory there is, and how much this process has.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Bytes that the machine, and the control group that the process is in, would still give. 0 where nobody says.
std::uint64_t freeMemory();

// Bytes that the control group of this folder leaves under its limit, pages of files that may be dropped not counted as
// used; none without a limit. `unified`: cgroup v2, whose files have other names.
std::optional<std::uint64_t> leftByControlGroup(const std::string& folder, bool unified);

// Bytes of the process that are in main memory now.
std::uint64_t residentMemory();

// "2GiB", "1500 MB": a whole or decimal number of B, kB, MB, GB, TB (powers of 1000), KiB, MiB, GiB or TiB (of 1024).
// Throws Error for other text and for what is below 1 byte or above 2⁶².
std::uint64_t parseBytes(std::string_view text);

// "2 GiB", "1.5 MiB"
std::string bytesText(std::uint64_t bytes);

}  // namespace defocus::engine
