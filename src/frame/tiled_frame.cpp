#include "frame/tiled_frame.h"

#include "core/error.h"
#include "core/memory_limits.h"
#include "render/automatic_samples.h"
#include "render/frame_uniforms.h"

namespace defocus {

bool mustDrawInTiles(const World& world, const FramePlan& plan, const Request& request, const Method& method,
                     std::uint64_t limit) {
    if (!method.needsGl || (!method.drawsTiles && !request.memory)) return false;
    if (fitsInOnePiece(needsBeforeUpload(world, plan, request, limit))) return false;
    if (!method.drawsTiles)
        refuseTiles(plan, limit, fmt::format("method '{}' can't draw tiles; 'accumulation' can", method.name));
    if (request.stop.given())
        refuseTiles(plan, limit, "--target-error and --time-limit judge the whole image; give --samples");
    return true;
}

void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason) {
    fail("{} x {} px don't fit into {} in one piece, and {}", plan.view.width, plan.view.height, bytesText(limit),
         reason);
}

FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings) {
    if (settings.sampleCount != automaticSamples) return planFrame(world, view, settings);
    settings.sampleCount = blockSamples;
    settings.sampleCount = samplesForBlur(planFrame(world, view, settings));
    return planFrame(world, view, settings);
}

std::vector<std::string> tiledSamplesNote(const FramePlan& plan, bool automatic) {
    if (!automatic || plan.samples.size() <= blockSamples) return {};
    return {
        fmt::format("{} lens samples, as many as the blur may need: an image in one piece ends earlier where its "
                    "error is small, which tiles can't know before all are drawn",
                    plan.samples.size())};
}

TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const Request& request, Renderer& renderer,
                          std::uint64_t limit) {
    const RowRange all{0, plan.view.height};
    const TilingNeeds before = tilingNeeds(world, plan, all, request, limit);
    const Tile trial = trialTile(plan);
    const std::uint64_t drawn = trialBytes(before, trial);
    renderer.setWave(1);
    renderer.start(tileOf(plan, trial));
    renderer.advance();
    static_cast<void>(renderer.image());  // drivers hold on to layers until what was drawn of them is read
    const std::uint64_t held = renderer.stats().peakBytes;
    return tilingNeeds(world, plan, all, request, limit, drawn, held > drawn ? held - drawn : 0);
}

}  // namespace defocus
