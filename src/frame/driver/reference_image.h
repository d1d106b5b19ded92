#pragma once
// Renders the converged image that methods are compared with: full detail, 32-bit float layers, many lens samples. The
// samples come from a part of their sequence that other images don't use. The image is kept as an EXR file with a hash
// of everything that it depends on, and with an estimate of its own error.
//
// The reference is the mean of two halves with different lens samples. If the errors of the halves were independent,
// the error of the mean would be half the difference between the halves. Half that difference is also the difference
// between the mean and either half. Neighbouring stretches of a Halton sequence fill each other's gaps, so the mean is
// more accurate than this estimate.

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/progress.h"
#include "image/metrics.h"
#include "plan/view.h"
#include "render/methods.h"

namespace defocus::engine {

// Index of a reference's first lens sample in its sequence, far beyond the samples of other images.
inline constexpr std::uint32_t referenceOffset = 1u << 20;
// Sequence of a reference's lens samples, independent of the methods' sequences: one reference serves all methods.
inline constexpr Sequence referenceSequence = Sequence::halton;

struct ReferenceOptions {
    std::uint32_t samples = 4096;  // of both halves together, 2 … maxSamples
    RendererOptions renderer;      // layerFormat is ignored
    Shadows shadows = Shadows::automatic;
};

struct ReferenceImage {
    Image image;
    std::uint32_t samples = 0;
    std::uint64_t hash = 0;   // hash of the world, the view, the shaders and the samples
    Difference remaining;     // estimate of the reference's own error: mae, rmse, psnr, ssim and flip
    double milliseconds = 0;  // render time
    bool reused = false;      // whether the image was read from the folder
};

// Returns a remark for a table row whose difference by PSNR, FLIP or both is smaller than the reference's own error;
// empty for neither.
std::string belowReferenceText(bool psnr, bool flip);

// Renders a reference without storing it. Needs a current GL context. Throws Error for a number of samples outside 2 …
// maxSamples.
ReferenceImage renderedReference(const World& world, const View& view, const ReferenceOptions& options,
                                 const Progress& progress = {});

// Returns the value that ReferenceImage::hash will have. Needs no pyramids.
std::uint64_t referenceHash(const World& world, const View& view, const ReferenceOptions& options);

// Returns whether the folder holds a reference, or half of a reference, with another hash; referenceImage would replace
// it. Files that cannot be read as images are ignored.
bool holdsOtherReference(const std::filesystem::path& folder, std::uint64_t hash);

// Returns the image in `folder`/reference.exr if that file is complete and has the right hash. Otherwise renders the
// image and writes that file. A killed run may leave reference-half.exr; rendering then continues from that half.
// Rendering needs a current GL context. Throws Error for a number of samples outside 2 … maxSamples, and if the files
// cannot be written.
ReferenceImage referenceImage(const World& world, const View& view, const ReferenceOptions& options,
                              const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace defocus::engine
