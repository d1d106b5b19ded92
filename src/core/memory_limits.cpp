#include "core/memory_limits.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr auto units = std::to_array<std::pair<std::string_view, double>>({{"B", 1},
                                                                           {"kB", 1e3},
                                                                           {"MB", 1e6},
                                                                           {"GB", 1e9},
                                                                           {"TB", 1e12},
                                                                           {"K", 0x1p10},
                                                                           {"M", 0x1p20},
                                                                           {"G", 0x1p30},
                                                                           {"T", 0x1p40},
                                                                           {"KiB", 0x1p10},
                                                                           {"MiB", 0x1p20},
                                                                           {"GiB", 0x1p30},
                                                                           {"TiB", 0x1p40}});

// Returns the number in a file; nullopt if the file is missing or contains other text, such as "max".
std::optional<std::uint64_t> numberIn(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    return file >> number ? std::optional(number) : std::nullopt;
}

std::optional<std::uint64_t> availableOfMachine() {
    std::ifstream file("/proc/meminfo");
    std::string name, unit;
    for (std::uint64_t kibibytes = 0; file >> name >> kibibytes; std::getline(file, unit))
        if (name == "MemAvailable:") return kibibytes * 1024;
    return {};
}

// Returns the bytes of a control group's inactive file cache, which the kernel drops under memory pressure.
std::uint64_t droppable(const std::string& statisticsFile, std::string_view name) {
    std::ifstream file(statisticsFile);
    std::string word;
    for (std::uint64_t bytes = 0; file >> word >> bytes;)
        if (word == name) return bytes;
    return 0;
}

}  // namespace

std::optional<std::uint64_t> leftByControlGroup(const std::string& folder, bool unified) {
    const auto limit = numberIn(folder + (unified ? "/memory.max" : "/memory.limit_in_bytes"));
    const auto used = numberIn(folder + (unified ? "/memory.current" : "/memory.usage_in_bytes"));
    if (!limit || !used) return {};
    const std::uint64_t dropped = droppable(folder + "/memory.stat", unified ? "inactive_file" : "total_inactive_file");
    const std::uint64_t kept = *used - std::min(dropped, *used);
    return *limit - std::min(kept, *limit);
}

namespace {

// Returns the bytes left under the tightest memory limit of the process's control group and its ancestors.
std::uint64_t leftByControlGroups() {
    std::uint64_t min = std::numeric_limits<std::uint64_t>::max();
    std::ifstream file("/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.rfind(':');
        if (colon == std::string::npos) continue;
        const bool unified = line.starts_with("0::");
        if (!unified && line.find(":memory:") == std::string::npos) continue;
        const std::string root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        for (std::string group = line.substr(colon + 1);; group.erase(group.rfind('/'))) {
            if (const auto left = leftByControlGroup(root + group, unified)) min = std::min(min, *left);
            if (group.empty() || group.rfind('/') == std::string::npos) break;
        }
    }
    return min;
}

}  // namespace

std::uint64_t freeMemory() {
    return std::min(availableOfMachine().value_or(0), leftByControlGroups());
}

std::uint64_t residentMemory() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t size = 0, resident = 0;
    file >> size >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t parseBytes(std::string_view text) {
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    while (unit.starts_with(' ')) unit.remove_prefix(1);
    const auto found = std::ranges::find(units, unit, &std::pair<std::string_view, double>::first);
    if (fault != std::errc() || found == units.end()) fail("'{}' is not a memory size such as 2GiB", text);
    const double bytes = std::floor(number * found->second);
    if (!(bytes >= 1 && bytes <= 0x1p62)) fail("'{}' is out of range; give a memory size from 1 B to 4 EiB", text);
    return static_cast<std::uint64_t>(bytes);
}

std::string bytesText(std::uint64_t bytes) {
    std::string_view unit = "B";
    double size = 1;
    for (const auto& [name, factor] : units)
        if (name.size() == 3 && static_cast<double>(bytes) >= factor) std::tie(unit, size) = std::pair(name, factor);
    const double value = static_cast<double>(bytes) / size;
    return value < 999.5 ? fmt::format("{:.3g} {}", value, unit) : fmt::format("{:.0f} {}", value, unit);
}

}  // namespace defocus::engine
