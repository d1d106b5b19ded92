#pragma once
// Progress callback for long operations.

#include <cstdint>
#include <functional>
#include <string_view>

namespace defocus {

// Called with the name of the current stage ("fish", "pyramids", "samples" …) and its progress: `done` of `total`. An
// empty function disables progress reports. Calls may come from different threads, but never concurrently. An exception
// from the callback cancels the operation and propagates to the caller.
using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

}  // namespace defocus
