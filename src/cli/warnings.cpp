#include <fmt/format.h>

#include <cstdio>

#include "cli/command.h"
#include "core/message.h"

namespace defocus {

void printWarnings(const std::vector<std::string>& lines, const GlobalOptions& global) {
    if (global.quiet) return;
    for (const std::string& line : lines) printMessage("warning: {}\n", line);
}

void printFrameWarnings(const PreparedFrame& frame, const GlobalOptions& global) {
    if (global.verbose && !frame.cacheFolder.empty())
        printMessage("{} of {} pyramids from the cache in {}\n", frame.pyramidsLoaded, frame.world.pyramids.size(),
                     frame.cacheFolder.string());
    printWarnings(frameWarnings(frame), global);
}

}  // namespace defocus
