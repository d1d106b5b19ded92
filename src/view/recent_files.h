#pragma once
// The scenes that were opened last, in $XDG_STATE_HOME/defocus/recent.json (or ~/.local/state).

#include <filesystem>
#include <vector>

namespace defocus {

inline constexpr std::size_t mostRecentFiles = 12;

// Empty where neither variable says where to store it.
std::filesystem::path recentFilesPath();

// The latest first, only those that are still there; none where the list can't be read.
std::vector<std::filesystem::path> readRecentFiles(const std::filesystem::path& list);

// Puts a scene first. Throws Error where the list can't be written.
void rememberRecentFile(const std::filesystem::path& list, const std::filesystem::path& scene);

}  // namespace defocus
