#include "refocus/refocus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "lens/aperture.h"
#include "lens/lens_fields.h"
#include "refocus/gap_filling.h"
#include "refocus/shifted_sum.h"

namespace defocus::engine {

namespace {

constexpr double tolerance = 1e-6;  // relative tolerance for values that were written as text and read again

constexpr std::size_t imagesAtOnce = 8;

void checkRanges(const LightFieldInfo& info, const Refocusing& refocusing, const std::string& name) {
    const double dioptres = 1 / refocusing.focusDistance;
    const double nearest = 1 / info.range.nearest;
    const double farthest = 1 / info.range.farthest;
    if (!(dioptres <= nearest * (1 + tolerance) && dioptres >= farthest * (1 - tolerance)))
        fail(
            "{}: the focus distance of {:.4g} m is outside the rendered range of {:.4g} to {:.4g} m; render the file "
            "again with --focus-range",
            name, refocusing.focusDistance, info.range.nearest, info.range.farthest);
    if (!(refocusing.fStop >= info.fStop * (1 - tolerance)))
        fail("{}: f/{:g} is wider than the rendered aperture of f/{:g}; render the file again with --fstop {:g}", name,
             refocusing.fStop, info.fStop, refocusing.fStop);
    if (!info.disk && (refocusing.shape || refocusing.fStop > info.fStop * (1 + tolerance)))
        fail(
            "{}: the aperture was not rendered as a full disk, so its size and shape are fixed; render the file again "
            "without --blades, --aperture-image or other options that set its shape",
            name);
}

}  // namespace

Refocusing asRendered(const LightFieldInfo& info) {
    return {info.focusDistance, info.fStop, {}};
}

glm::ivec2 integerMove(const LightFieldInfo& info, std::size_t image, double shift) {
    constexpr double farthest = 1e6;  // max shift in px, so that the result fits into an int
    const double within = std::clamp(shift, -farthest, farthest);
    return glm::ivec2(glm::floor(within * info.points[image] + info.pixels[image] + 0.5));
}

std::vector<ShiftedImage> shiftedImages(const LightFieldInfo& info, const Refocusing& refocusing,
                                        const std::string& name) {
    checkRanges(info, refocusing, name);
    const Aperture aperture = makeAperture(refocusing.shape.value_or(Lens()));
    const double shift = info.shift(refocusing.focusDistance);
    const double scale = std::max(refocusing.fStop / info.fStop, 1.0);
    std::vector<ShiftedImage> images;
    for (std::size_t i = 0; i < info.points.size(); ++i) {
        const double weight = info.disk ? lightDensity(aperture, scale * info.points[i]) : 1;
        if (weight > 0) images.push_back({i, integerMove(info, i, shift), weight});
    }
    if (images.empty())
        fail(
            "{}: none of its {} lens points lies within the aperture at f/{:g}; render the file again with more "
            "--samples",
            name, info.points.size(), refocusing.fStop);
    return images;
}

Image sharpSum(LensImages& lensImages, const Refocusing& refocusing, const Progress& progress) {
    const std::vector<ShiftedImage> images = shiftedImages(lensImages.info(), refocusing, lensImages.name());
    ShiftedSum sum(lensImages.info().size);
    for (std::size_t first = 0; first < images.size(); first += imagesAtOnce) {
        const std::size_t end = std::min(first + imagesAtOnce, images.size());
        std::vector<std::shared_ptr<const HalfImage>> colours;
        std::vector<MovedImage> moved;
        for (std::size_t i = first; i < end; ++i) {
            colours.push_back(lensImages.colour(images[i].image));
            moved.push_back({colours.back().get(), images[i].move, static_cast<float>(images[i].weight)});
        }
        sum.add(moved);
        report(progress, "lens images", end, images.size());
    }
    return sum.mean();
}

namespace {

Image withoutGaps(LightField& field, const Refocusing& refocusing, const Progress& progress) {
    const LightFieldInfo& info = field.info();
    const std::vector<ShiftedImage> images = shiftedImages(info, refocusing, field.name());
    GapFilling filling(info.size, {diameterPerDioptre(info, refocusing), 1 / refocusing.focusDistance}, images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::shared_ptr<const HalfImage> colour = field.colour(images[i].image);
        const Image depth = field.depth(images[i].image);
        const DeepMovedImage moved{colour.get(), &depth, images[i].move, static_cast<float>(images[i].weight)};
        filling.add({&moved, 1});
        report(progress, "lens images", i + 1, images.size());
    }
    return filling.mean();
}

}  // namespace

Image refocused(LightField& field, const Refocusing& refocusing, const Progress& progress) {
    return refocusing.fillGaps ? withoutGaps(field, refocusing, progress) : sharpSum(field, refocusing, progress);
}

double diameterPerDioptre(const LightFieldInfo& info, const Refocusing& refocusing) {
    return 2 * info.pixelsPerDioptre * info.fStop / refocusing.fStop;
}

double focusAtPixel(LightField& field, const Pixel& pixel) {
    const PartSize& size = field.info().size;
    if (pixel.column < 0 || pixel.row < 0 || pixel.column >= size.width || pixel.row >= size.height)
        fail("--focus-pixel {},{} is outside the image of {}x{} px", pixel.column, pixel.row, size.width, size.height);
    const Image depth = field.depth(field.central());
    const double metres = static_cast<double>(*depth.at(pixel.column + size.margin, pixel.row + size.margin));
    if (!(metres > 0) || std::isinf(metres))
        fail("--focus-pixel {},{}: no surface is visible at this pixel", pixel.column, pixel.row);
    return metres;
}

Metadata refocusedMetadata(const LightFieldInfo& info, const Refocusing& refocusing) {
    Metadata metadata = info.metadata;
    metadata["focus"] = metadata["defocus:focusDistance"] = refocusing.focusDistance;
    metadata["aperture"] = metadata["defocus:fStop"] = refocusing.fStop;
    if (refocusing.shape)
        for (const LensField& field : lensFields())
            if (field.feature == LensFeature::shape || field.name == std::string_view("anamorphicRatio"))
                metadata[std::string("defocus:") + field.name] = lensFieldValue(*refocusing.shape, field);
    return metadata;
}

double refocusedExposure(const LightFieldInfo& info, const Refocusing& refocusing) {
    const double rendered = info.number("defocus:exposure", 0);
    const bool timed = info.number("defocus:exposureTime", 0) > 0;
    return timed ? rendered + 2 * std::log2(info.fStop / refocusing.fStop) : rendered;
}

}  // namespace defocus::engine
