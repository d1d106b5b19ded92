#include <fmt/format.h>

#include <cstdio>

#include "cli/command.h"

namespace defocus {

void printWarnings(const std::vector<std::string>& lines, const GlobalOptions& global) {
    if (global.quiet) return;
    for (const std::string& line : lines) fmt::print(stderr, "warning: {}\n", line);
}

void printFrameWarnings(const PreparedFrame& frame, const GlobalOptions& global) {
    if (global.verbose && !frame.cacheFolder.empty())
        fmt::print(stderr, "{} of {} pyramids from the cache in {}\n", frame.pyramidsLoaded,
                   frame.world.pyramids.size(), frame.cacheFolder.string());
    printWarnings(frameWarnings(frame), global);
}

}  // namespace defocus
