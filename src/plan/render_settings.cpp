#include "plan/render_settings.h"

namespace defocus::engine {

int positionsPerAxis(const RenderSettings& settings) {
    return settings.positions == 4 ? 2 : 1;
}

std::uint32_t positionCount(const RenderSettings& settings) {
    return settings.sampleCount * settings.positions;
}

void fixThresholds(RenderSettings& settings, std::uint32_t sampleCount, double factor) {
    const LodThresholds defaults = chosenThresholds(settings.thresholds, settings.metric, sampleCount);
    settings.metric = chosenMetric(settings.metric, settings.thresholds);
    if (settings.metric == LodMetric::measured)
        settings.thresholds.light = factor * defaults.light;
    else if (settings.metric == LodMetric::score || settings.metric == LodMetric::proportional)
        settings.thresholds.blur = factor * defaults.blur;
    else
        settings.thresholds = {.blur = factor * defaults.blur, .size = factor * defaults.size};
}

}  // namespace defocus::engine
