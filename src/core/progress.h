#pragma once
#include "defocus/progress.h"

namespace defocus::engine {

inline void report(const Progress& progress, std::string_view stage, std::uint64_t done, std::uint64_t total) {
    if (progress) progress(stage, done, total);
}

}  // namespace defocus::engine
