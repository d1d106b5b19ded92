#include "cli/commands/capture_refocus.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/memory_limits.h"
#include "refocus/light_field_output.h"

namespace defocus::engine {

namespace {

// Returns the number of lens samples that each frame needs if it is rendered on its own.
std::uint32_t samplesOf(const FilmSettings& settings) {
    return settings.request.samples.value_or(LightFieldOutput::defaultSamples);
}

std::string savingText(std::uint64_t frames, std::uint64_t images, std::uint32_t samples) {
    return fmt::format("{} frame{} from {} lens images instead of {} lens samples", frames, frames == 1 ? "" : "s",
                       images, frames * samples);
}

}  // namespace

RefocusRuns chosenRuns(const Shot& shot, const SequenceBase& base, const FilmSettings& settings) {
    RefocusRuns runs = refocusRuns(shot, base, settings, shot.range, samplesOf(settings));
    const std::uint64_t limit = std::min(settings.request.memory.value_or(freeMemory()), freeMemory()) / 2;
    for (const RefocusRun& run : runs.runs)
        if (const std::uint64_t bytes = memoryOf(run, base.view); bytes > limit)
            fail(
                "--refocus needs {} of memory for {} lens images, but may use only {}; give fewer --samples or "
                "a smaller --size",
                bytesText(bytes), run.samples, bytesText(limit));
    return runs;
}

std::string savedText(const FilmSettings& settings, const FilmFigures& figures) {
    if (figures.refocused == 0)
        return "--refocus has no effect: it needs consecutive frames that differ only in focus, f-number or aperture "
               "shape";
    return "refocused " +
           savingText(static_cast<std::uint64_t>(figures.refocused), figures.lensImages, samplesOf(settings));
}

std::string possibleSaving(const Shot& shot, const SequenceBase& base, const FilmSettings& settings,
                           const std::vector<FilmFrame>& film) {
    if (shot.request.targetError) return {};  // --refocus needs a fixed number of samples
    std::uint64_t frames = 0;
    std::uint64_t images = 0;
    for (const RefocusRun& run : refocusRuns(shot, base, settings, shot.range, samplesOf(settings)).runs) {
        const auto within = static_cast<std::uint64_t>(std::ranges::count_if(film, [&](const FilmFrame& frame) {
            return run.frames.first <= frame.frame && frame.frame <= run.frames.last;
        }));
        if (within * samplesOf(settings) <= run.samples) continue;
        frames += within;
        images += run.samples;
    }
    if (frames == 0) return {};
    return "--refocus would compute " + savingText(frames, images, samplesOf(settings));
}

}  // namespace defocus::engine
