#pragma once
// Makes the converged image that methods are measured against: full detail, many lens samples of its own (they begin at
// an offset in their sequence), 32-bit float layers. It is kept as an EXR with a hash of everything that it depends on,
// and with an estimate of its own error.
//
// It is the mean of two halves, each of its own lens samples. Were their errors independent, the mean's would be half
// the difference between the two: the difference between the mean and either half. Neighbouring stretches of a Halton
// sequence fill each other's gaps, so that the mean is rather better than that.

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/progress.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus::engine {

// Where references begin in the sequence of lens samples: far beyond what others use.
inline constexpr std::uint32_t referenceOffset = 1u << 20;
// Whatever the methods sample with, so that a reference stays the truth for all of them.
inline constexpr Sequence referenceSequence = Sequence::halton;

struct ReferenceOptions {
    std::uint32_t samples = 4096;  // of both halves together, 2 … maxSamples
    RendererOptions renderer;      // its layer format is not used
    Shadows shadows = Shadows::automatic;
};

struct ReferenceImage {
    Image image;
    std::uint32_t samples = 0;
    std::uint64_t hash = 0;   // of the world, the view, the shaders and the samples
    Difference remaining;     // estimate of its own error: mae, rmse, psnr, ssim and flip
    double milliseconds = 0;  // what it took to render
    bool reused = false;      // read from the folder
};

// Returns a remark for a row whose PSNR, FLIP or both are below the reference's own error; empty if neither is.
std::string belowReferenceText(bool psnr, bool flip);

// Renders a reference without storing it. Needs a current GL context. Throws Error for an impossible number of samples.
ReferenceImage renderedReference(const World& world, const View& view, const ReferenceOptions& options,
                                 const Progress& progress = {});

// Returns what ReferenceImage::hash will be. Needs no pyramids.
std::uint64_t referenceHash(const World& world, const View& view, const ReferenceOptions& options);

// Returns whether the folder holds a reference, or half of one, with another hash, which referenceImage would replace.
// Files that can't be read as images don't count.
bool holdsOtherReference(const std::filesystem::path& folder, std::uint64_t hash);

// Reads `folder`/reference.exr if it has the hash and is whole. Else renders the image and writes it there, continuing
// from the half that a killed run may have left (reference-half.exr). Rendering needs a current GL context. Throws
// Error for an impossible number of samples and if the files can't be written.
ReferenceImage referenceImage(const World& world, const View& view, const ReferenceOptions& options,
                              const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace defocus::engine
