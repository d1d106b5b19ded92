#include <fmt/format.h>

#include "cli/command.h"
#include "core/message.h"

namespace defocus::engine {

void WarningPrinter::print(const std::vector<std::string>& lines) {
    if (quiet_) return;
    for (const std::string& line : lines)
        if (printed_.insert(line).second) printMessage("warning: {}\n", line);
}

void printCacheUse(const PreparedFrame& frame, const GlobalOptions& global) {
    if (!global.verbose || frame.cacheFolder.empty()) return;
    printMessage("{} of {} pyramids read from the cache in {}\n", frame.pyramidsLoaded, frame.world.pyramids.size(),
                 frame.cacheFolder.string());
}

}  // namespace defocus::engine
