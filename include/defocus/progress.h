#pragma once
// How long work reports where it stands.

#include <cstdint>
#include <functional>
#include <string_view>

namespace defocus {

// Called with the name of the stage ("fish", "pyramids", "samples" …) and how much of it is done. An empty function
// means that nobody listens. Several threads may call it, but never two at once. What it throws ends the work and
// reaches the caller: this is how work is cancelled.
using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

}  // namespace defocus
