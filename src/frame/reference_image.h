#pragma once
// The converged image that methods are measured against: full detail, many lens samples of its own (an offset into
// their sequence), 32-bit float layers. It is kept as an EXR with a hash of all that it depends on, and it knows how
// far it may still be from the limit.
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

namespace defocus {

// Where references begin in the sequence of lens samples: far beyond what others use.
inline constexpr std::uint32_t referenceOffset = 1u << 20;
// Whatever the methods sample with, so that a reference stays the truth for all of them.
inline constexpr Sequence referenceSequence = Sequence::halton;

struct ReferenceOptions {
    std::uint32_t samples = 4096;  // of both halves together, 2 … 65,536
    RendererOptions renderer;      // its layer format is not used
};

struct ReferenceImage {
    Image image;
    std::uint32_t samples = 0;
    std::uint64_t hash = 0;   // of the world, the view, the shaders and the samples
    Difference remaining;     // estimate of its own error: mae, rmse, psnr, ssim and flip
    double milliseconds = 0;  // what it took to render
    bool reused = false;      // read from the folder
};

// For a row whose PSNR or FLIP from the reference says nothing but that it is below the reference's own error: that, in
// words; else empty.
std::string belowReferenceText(bool psnr, bool flip);

// Rendered, and kept nowhere. Needs a current GL context. Throws Error for an impossible number of samples.
ReferenceImage renderedReference(const World& world, const View& view, const ReferenceOptions& options,
                                 const Progress& progress = {});

// What ReferenceImage::hash will be. Needs no pyramids.
std::uint64_t referenceHash(const World& world, const View& view, const ReferenceOptions& options);

// Does the folder hold a reference, or the half of one, of another hash, which referenceImage would replace? Files that
// can't be read as images are worth nothing.
bool holdsOtherReference(const std::filesystem::path& folder, std::uint64_t hash);

// Takes `folder`/reference.exr where it has the hash and is whole, else renders it and writes it there; a half that a
// killed run has left (reference-half.exr) is used. Needs a current GL context for the rendering. Throws Error for an
// impossible number of samples and where the files can't be written.
ReferenceImage referenceImage(const World& world, const View& view, const ReferenceOptions& options,
                              const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace defocus
