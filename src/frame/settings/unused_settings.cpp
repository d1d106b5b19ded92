#include "frame/settings/unused_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "frame/settings/settings.h"

namespace defocus::engine {

std::vector<std::string> unusedSettings(const Request& request, const Scene& scene, const Lens& lens) {
    const SettingContext context{request, *chosenMethod(request).method, scene, lens};
    std::vector<std::pair<std::string, std::vector<std::string>>> optionsByReason;
    for (const Setting& setting : settings()) {
        if (!setting.unused || !changedText(setting, request)) continue;
        const std::string reason = setting.unused(context);
        if (reason.empty()) continue;
        auto found = std::ranges::find(optionsByReason, reason, [](const auto& entry) { return entry.first; });
        if (found == optionsByReason.end()) found = optionsByReason.insert(found, {reason, {}});
        found->second.push_back(setting.option);
    }
    std::vector<std::string> lines;
    for (const auto& [reason, options] : optionsByReason)
        lines.push_back(
            fmt::format("{} {} no effect: {}", fmt::join(options, ", "), options.size() > 1 ? "have" : "has", reason));
    return lines;
}

}  // namespace defocus::engine
