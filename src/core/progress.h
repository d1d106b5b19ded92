#pragma once
// How long work reports where it stands. An empty function means nobody listens. May be called from several threads'
// work, but never from two threads at once.

#include <cstdint>
#include <functional>
#include <string_view>

namespace defocus {

using Progress = std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total) {
    if (progress) progress(stage, done, total);
}

}  // namespace defocus
