#include "refocus/light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/error.h"
#include "core/memory_limits.h"
#include "lens/aperture.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

constexpr const char* countName = "defocus:lensImages";
constexpr const char* pixelsName = "defocus:pixelsPerDioptre";
constexpr const char* nearestName = "defocus:nearestFocusDioptres";
constexpr const char* farthestName = "defocus:farthestFocusDioptres";
constexpr const char* diskName = "defocus:apertureIsDisk";
constexpr const char* focusName = "defocus:focusDistance";
constexpr const char* fStopName = "defocus:fStop";
constexpr const char* pointNames[2] = {"defocus:lensU", "defocus:lensV"};
constexpr const char* pixelNames[2] = {"defocus:sampleRight", "defocus:sampleUp"};
constexpr const char* shiftNames[2] = {"defocus:pixelsRightPerDioptre", "defocus:pixelsUpPerDioptre"};

// Lens fields that must have their default values. With other values, a change of focus would not merely shift the
// image seen from a lens point (light_field.h), or the weights of the images would differ between pixels or colours.
constexpr std::array unsuited = {
    "focusBreathing",  "catEye",          "axialChromaticAberration", "astigmatism", "coma",       "foregroundLimit",
    "backgroundLimit", "focusRangeFront", "focusRangeBehind",         "focusTilt",   "focusSwing", "fieldCurvature",
    "radialBlurGain"};

void checkThinLens(const Lens& lens) {
    if (!(apertureDiameter(lens) > 0))
        fail("lens images need depth of field; leave out --no-dof, and set the blur scale above 0");
    for (const char* name : unsuited) {
        const LensField& field = *lensFieldNamed(name);
        if (lensFieldValue(lens, field) != lensFieldValue(Lens(), field))
            fail(
                "lens images cannot be combined with {}: refocusing shifts each image as a whole, which cannot "
                "reproduce this effect; leave it out",
                field.option);
    }
}

// Returns the maximum shift in px of a lens image, along each axis, over the focus range.
double largestMove(const LightFieldInfo& info) {
    return std::max(std::abs(info.shift(info.range.nearest)), std::abs(info.shift(info.range.farthest)));
}

// Returns the margin in px that lens images need so that they still cover the refocused image when they are shifted.
int marginOf(const LightFieldInfo& info) {
    return static_cast<int>(std::ceil(std::min(largestMove(info), 1e6) + 0.5));  // 0.5 px: integerMove() rounds
}

// Returns the number stored under `name` in a file's metadata; nullopt if it is missing, of another type, or not
// finite.
std::optional<double> numberIn(const Metadata& metadata, const char* name) {
    std::optional<double> value;
    if (const auto* number = attributeOf<double>(metadata, name)) value = *number;
    if (const auto* number = attributeOf<int>(metadata, name)) value = *number;
    return value && std::isfinite(*value) ? value : std::nullopt;
}

double needed(const Metadata& metadata, const char* attribute, const std::string& name, double min, double max) {
    const std::optional<double> value = numberIn(metadata, attribute);
    if (!value)
        fail(
            "{}: not a file of lens images: the attribute '{}' is missing; give a file from 'defocus render "
            "--lens-images'",
            name, attribute);
    if (*value < min || *value > max)
        fail("{}: the attribute '{}' is {}, but must be from {} to {}; render the file again", name, attribute, *value,
             min, max);
    return *value;
}

LightFieldInfo infoOf(const ImagePartReader& parts, const std::string& name) {
    const Metadata& first = parts.metadata(0);
    LightFieldInfo info;
    info.size = parts.size();
    const auto images = static_cast<std::size_t>(needed(first, countName, name, 1, maxImageParts));
    if (parts.count() < images)
        fail("{}: {} of {} lens images are missing; render the file again", name, images - parts.count(), images);
    info.focusDistance = needed(first, focusName, name, 1e-6, 1e12);
    info.fStop = needed(first, fStopName, name, 1e-3, 1e6);
    info.pixelsPerDioptre = needed(first, pixelsName, name, 0, 1e12);
    info.range = {1 / needed(first, nearestName, name, 1e-12, 1e12), 1 / needed(first, farthestName, name, 0, 1e12)};
    info.disk = needed(first, diskName, name, 0, 1) != 0;
    if (info.size.margin < marginOf(info))
        fail("{}: the margin of {} px around its lens images is too small for its focus range; render the file again",
             name, info.size.margin);
    for (std::size_t i = 0; i < images; ++i) {
        const auto pair = [&](const char* const names[2], double max) {
            return glm::dvec2(needed(parts.metadata(i), names[0], name, -max, max),
                              needed(parts.metadata(i), names[1], name, -max, max));
        };
        info.points.push_back(pair(pointNames, 1.001));
        info.pixels.push_back(pair(pixelNames, 0.5));
    }
    info.metadata = first;
    for (const char* own : {countName, pixelsName, nearestName, farthestName, diskName, pointNames[0], pointNames[1],
                            pixelNames[0], pixelNames[1], shiftNames[0], shiftNames[1]})
        info.metadata.erase(own);
    return info;
}

}  // namespace

double LightFieldInfo::number(const char* name, double fallback) const {
    return numberIn(metadata, name).value_or(fallback);
}

LightFieldInfo lightFieldInfo(const View& view, const FocusRange& range) {
    const Lens& lens = view.lens;
    checkThinLens(lens);
    LightFieldInfo info;
    info.focusDistance = lens.focusDistance;
    info.fStop = lens.fStop;
    info.pixelsPerDioptre = apertureDiameter(lens) * view.width / (4 * tanHalfHorizontalFov(lens));
    info.range = range;
    info.disk = isUniformDisk(makeAperture(lens));
    const int longer = std::max(view.width, view.height);
    if (!(largestMove(info) <= longer))
        fail(
            "to refocus between {:.3g} and {:.3g} m, lens images need a margin of {:.0f} px around the image, more "
            "than its longer side of {} px; give a narrower --focus-range or a larger --fstop",
            range.nearest, range.farthest, largestMove(info), longer);
    info.size = {view.width, view.height, marginOf(info)};
    return info;
}

void addSamples(LightFieldInfo& info, const FramePlan& plan) {
    if (plan.usesOwnBlur)
        fail(
            "lens images cannot show objects or vertices with their own blur (--node-blur, vertex attributes): "
            "refocusing shifts each image as a whole, which cannot reproduce this effect");
    for (const LensSample& sample : plan.samples) {
        info.points.emplace_back(sample.lens);
        info.pixels.emplace_back(sample.pixel);
    }
}

std::vector<Metadata> partMetadata(const LightFieldInfo& info) {
    std::vector<Metadata> parts(info.points.size());
    parts.front() = info.metadata;
    parts.front()[countName] = static_cast<int>(info.points.size());
    parts.front()[focusName] = info.focusDistance;
    parts.front()[fStopName] = info.fStop;
    parts.front()[pixelsName] = info.pixelsPerDioptre;
    parts.front()[nearestName] = 1 / info.range.nearest;
    parts.front()[farthestName] = 1 / info.range.farthest;
    parts.front()[diskName] = info.disk ? 1 : 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (glm::length_t axis = 0; axis < 2; ++axis) {
            parts[i][pointNames[axis]] = info.points[i][axis];
            parts[i][pixelNames[axis]] = info.pixels[i][axis];
            parts[i][shiftNames[axis]] = info.pixelsPerDioptre * info.points[i][axis];
        }
    return parts;
}

LightField::LightField(const std::filesystem::path& path)
    : name_(path.string()), parts_(path), info_(infoOf(parts_, name_)) {}

std::shared_ptr<const HalfImage> LightField::colour(std::size_t i) {
    if (kept_.empty()) return std::make_shared<const HalfImage>(parts_.colour(i));
    if (!kept_[i]) kept_[i] = std::make_shared<const HalfImage>(parts_.colour(i));
    return kept_[i];
}

void LightField::keepImages() {
    const PartSize& size = info_.size;
    const std::uint64_t bytes =
        std::uint64_t(size.fullWidth()) * std::uint64_t(size.fullHeight()) * 4 * sizeof(std::uint16_t);
    if (bytes * info_.points.size() < freeMemory() / 2) kept_.resize(info_.points.size());
}

std::size_t LightField::central() const {
    const auto nearest = std::ranges::min_element(info_.points, {}, [](const glm::dvec2& p) { return glm::dot(p, p); });
    return static_cast<std::size_t>(nearest - info_.points.begin());
}

}  // namespace defocus::engine
