#include "frame/driver/reference_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <system_error>

#include "core/error.h"
#include "core/hash.h"
#include "frame/setup/world_hash.h"
#include "image/image_io.h"
#include "render/accumulation/accumulation.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

constexpr const char* referenceName = "reference.exr";
constexpr const char* referenceHalfName = "reference-half.exr";

// An image with its render time.
struct Part {
    Image image;
    double milliseconds = 0;
};

std::uint64_t pixelHash(const Image& image) {
    return hashBytes(std::as_bytes(std::span(image.pixels)));
}

std::string hexadecimal(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

double numberIn(const Metadata& metadata, const char* name) {
    const double* number = attributeOf<double>(metadata, name);
    return number == nullptr ? 0 : *number;
}

bool holds(const Metadata& metadata, const char* name, const std::string& text) {
    const std::string* found = attributeOf<std::string>(metadata, name);
    return found != nullptr && *found == text;
}

// Returns the image stored at `path`; nullopt if the file is missing or damaged, or its hash is not `hash`.
std::optional<Part> stored(const fs::path& path, std::uint64_t hash, Metadata& metadata) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return {};
    try {
        Part part{readImage(path, metadata), 0};
        if (!holds(metadata, "defocus:referenceHash", hexadecimal(hash))) return {};
        if (!holds(metadata, "defocus:pixelHash", hexadecimal(pixelHash(part.image)))) return {};
        part.milliseconds = numberIn(metadata, "defocus:milliseconds");
        return part;
    } catch (const Error&) {
        return {};
    }
}

void store(const fs::path& path, const Part& part, std::uint64_t hash, Metadata metadata) {
    metadata["defocus:referenceHash"] = hexadecimal(hash);
    metadata["defocus:pixelHash"] = hexadecimal(pixelHash(part.image));
    metadata["defocus:milliseconds"] = part.milliseconds;
    writeImage(path, part.image, metadata);
}

Metadata metadataOf(const ReferenceImage& reference) {
    return {{"defocus:samples", static_cast<int>(reference.samples)},
            {"defocus:firstSample", static_cast<int>(referenceOffset)},
            {"defocus:remainingMae", reference.remaining.mae},
            {"defocus:remainingRmse", reference.remaining.rmse},
            {"defocus:remainingSsim", reference.remaining.ssim},
            {"defocus:remainingFlip", reference.remaining.flip}};
}

Difference remainingIn(const Metadata& metadata) {
    Difference remaining;
    remaining.mae = numberIn(metadata, "defocus:remainingMae");
    remaining.rmse = numberIn(metadata, "defocus:remainingRmse");
    remaining.psnr = -20 * std::log10(remaining.rmse);
    remaining.ssim = numberIn(metadata, "defocus:remainingSsim");
    remaining.flip = numberIn(metadata, "defocus:remainingFlip");
    return remaining;
}

// First or second half of the lens samples of a reference image.
struct Half {
    std::uint32_t first = 0;  // index of the half's first lens sample, counted from referenceOffset
    std::uint32_t count = 0;
};

Part rendered(const World& world, const View& view, const ReferenceOptions& options, const Half& half,
              const Progress& progress) {
    RenderSettings settings;
    settings.sampleCount = half.count;
    settings.sequence = referenceSequence;
    settings.firstSample = referenceOffset + half.first;
    settings.lod = LodMode::off;
    settings.shadows = options.shadows;
    settings.keepAll = true;  // disable culling, which could cause errors
    RendererOptions precise = options.renderer;
    precise.layerFormat = LayerFormat::rgba32f;
    precise.settings.clear();
    const auto renderer = makeAccumulationRenderer(world, precise);
    renderer->start(planFrame(world, view, settings));
    do {
        report(progress, "reference", half.first + renderer->samples(), options.samples);
    } while (renderer->advance());
    return {renderer->image(), renderer->stats().renderMilliseconds};
}

Image meanOf(const Image& a, const Half& first, const Image& b, const Half& second) {
    Image mean = a;
    const double share = static_cast<double>(second.count) / (first.count + second.count);
    std::ranges::transform(a.pixels, b.pixels, mean.pixels.begin(), [share](float x, float y) {
        return static_cast<float>(x + share * (static_cast<double>(y) - x));
    });
    return mean;
}

Half firstHalf(std::uint32_t samples) {
    return {0, samples / 2};
}

Half secondHalf(std::uint32_t samples) {
    return {samples / 2, samples - samples / 2};
}

// Sets the reference's image to the mean of its two halves `one` and `other`, and its estimated error to the difference
// between this mean and `one`.
void complete(ReferenceImage& reference, const Part& one, const Part& other) {
    reference.image = meanOf(one.image, firstHalf(reference.samples), other.image, secondHalf(reference.samples));
    reference.remaining = compareImages(reference.image, one.image);
    reference.milliseconds = one.milliseconds + other.milliseconds;
}

// Returns a reference without an image: only its number of samples and its hash are set.
ReferenceImage askedFor(const World& world, const View& view, const ReferenceOptions& options) {
    if (options.samples < 2 || options.samples > maxSamples)
        fail("a reference of {} samples is not possible; choose 2 to {}", options.samples, maxSamples);
    ReferenceImage reference;
    reference.samples = options.samples;
    reference.hash = referenceHash(world, view, options);
    return reference;
}

}  // namespace

std::string belowReferenceText(bool psnr, bool flip) {
    if (!psnr && !flip) return {};
    return fmt::format("  {} below the reference's own error", psnr && flip ? "PSNR and FLIP" : psnr ? "PSNR" : "FLIP");
}

std::uint64_t referenceHash(const World& world, const View& view, const ReferenceOptions& options) {
    const std::array<std::uint64_t, 3> samples = {options.samples, referenceOffset,
                                                  static_cast<std::uint64_t>(options.shadows)};
    return hashBytes(std::as_bytes(std::span(samples)), worldHash(world, view, options.renderer.shaderFolder));
}

bool holdsOtherReference(const fs::path& folder, std::uint64_t hash) {
    return std::ranges::any_of(std::array{referenceName, referenceHalfName}, [&](const char* name) {
        std::error_code ignored;
        if (!fs::exists(folder / name, ignored)) return false;
        try {
            Metadata metadata;
            readImage(folder / name, metadata);
            return !holds(metadata, "defocus:referenceHash", hexadecimal(hash));
        } catch (const Error&) {
            return false;
        }
    });
}

ReferenceImage renderedReference(const World& world, const View& view, const ReferenceOptions& options,
                                 const Progress& progress) {
    ReferenceImage reference = askedFor(world, view, options);
    const Part one = rendered(world, view, options, firstHalf(options.samples), progress);
    complete(reference, one, rendered(world, view, options, secondHalf(options.samples), progress));
    return reference;
}

ReferenceImage referenceImage(const World& world, const View& view, const ReferenceOptions& options,
                              const fs::path& folder, const Progress& progress) {
    ReferenceImage reference = askedFor(world, view, options);

    // Return the stored reference if its hash matches.
    const fs::path path = folder / referenceName;
    Metadata metadata;
    if (std::optional<Part> part = stored(path, reference.hash, metadata)) {
        reference.image = std::move(part->image);
        reference.milliseconds = part->milliseconds;
        reference.remaining = remainingIn(metadata);
        reference.reused = true;
        return reference;
    }

    // Render two halves with different samples. The file of the first half is kept until the complete reference is
    // stored.
    const fs::path halfPath = folder / referenceHalfName;
    std::optional<Part> one = stored(halfPath, reference.hash, metadata);
    if (!one) {
        one = rendered(world, view, options, firstHalf(options.samples), progress);
        store(halfPath, *one, reference.hash, {});
    }
    complete(reference, *one, rendered(world, view, options, secondHalf(options.samples), progress));
    store(path, {reference.image, reference.milliseconds}, reference.hash, metadataOf(reference));
    std::error_code ignored;
    fs::remove(halfPath, ignored);
    return reference;
}

}  // namespace defocus::engine
