#include "refocus/light_field_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace defocus::engine {

namespace {

// Returns the range from the nearest to the farthest surface in an image of depths; nullopt if there is no surface.
std::optional<FocusRange> visibleRange(const Image& depth) {
    FocusRange range{std::numeric_limits<double>::infinity(), 0};
    for (const float value : depth.pixels) {
        if (!(value > 0) || std::isinf(value)) continue;
        range.nearest = std::min(range.nearest, static_cast<double>(value));
        range.farthest = std::max(range.farthest, static_cast<double>(value));
    }
    return range.farthest > 0 ? std::optional(range) : std::nullopt;
}

}  // namespace

LightFieldOutput::LightFieldOutput(SceneDriver& driver, std::filesystem::path path, std::optional<FocusRange> range)
    : driver_(driver), path_(std::move(path)), range_(range) {
    if (range && !(range->nearest > 0 && range->nearest <= range->farthest))
        throw UsageError(fmt::format(
            "the focus range must begin above 0 m and must not end before it begins, but it is {:g} to {:g} m",
            range->nearest, range->farthest));
}

void LightFieldOutput::checkPath(const std::filesystem::path& path) {
    if (!isExr(path))
        throw UsageError(fmt::format("--lens-images writes an EXR file; give a file name that ends with .exr, not '{}'",
                                     path.string()));
}

Request LightFieldOutput::suited(Request request) {
    if (request.method != automaticMethod && request.method != "accumulation")
        throw UsageError(
            fmt::format("--lens-images requires --method accumulation, not '{}'; leave out --method", request.method));
    if (request.targetError || request.timeLimit)
        throw UsageError(
            "--lens-images needs a fixed number of images; give --samples instead of --target-error and "
            "--time-limit");
    request.method = "accumulation";
    if (!request.samples) request.samples = defaultSamples;
    if (*request.samples > maxImageParts)
        throw UsageError(fmt::format("--lens-images writes one image per sample, at most {}; --samples {} is too many",
                                     maxImageParts, *request.samples));
    return request;
}

void LightFieldOutput::start(const Progress& progress) {
    const Request& request = driver_.firstRequest();
    // First begin a frame without a margin, to get the metadata and the visible depths, from which the margin is
    // derived.
    FrameParts parts{.untiledReason = "--lens-images cannot write images that are drawn in tiles"};
    driver_.start(request, parts, progress);
    const double own = driver_.frame().view.lens.focusDistance;
    FocusRange range = range_ ? *range_ : visibleRange(driver_.aovs().depth).value_or(FocusRange{own, own});
    range = {std::min(range.nearest, own), std::max(range.farthest, own)};
    info_ = lightFieldInfo(driver_.frame().view, range);
    info_.metadata = driver_.metadata();
    info_.metadata["defocus:samples"] = static_cast<int>(*request.samples);
    info_.metadata.erase("defocus:seconds");

    FrameMoment drawn = momentOf(driver_.frame(), request);
    drawn.view = withMargin(drawn.view, info_.size.margin);
    drawn.settings.refocus = info_.range;
    parts.takeSample = [this](std::uint32_t, Image&& colour, Image&& depth) { writer_->write(colour, depth); };
    driver_.pose(request, drawn);
    driver_.start(parts);
    addSamples(info_, driver_.driver().plan());
    writer_.emplace(path_, info_.size, partMetadata(info_));
}

bool LightFieldOutput::advance() {
    return driver_.advance();
}

void LightFieldOutput::finish() {
    writer_->finish();
    writer_.reset();
}

}  // namespace defocus::engine
