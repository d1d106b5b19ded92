#pragma once
// Renders the converged image that methods are compared with: full detail, 32-bit float layers, many lens samples. The
// samples come from a range of the Halton sequence that other images don't use. The image is stored as an EXR file with
// a hash of all its inputs and an estimate of its own error.
//
// The reference is the mean of two halves, rendered with different lens samples. If the halves had independent errors,
// the error of the mean would be half the difference between the halves; this is also the difference between the mean
// and either half. Neighbouring ranges of a Halton sequence fill each other's gaps, so the true error is below this
// estimate.

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
// Sequence of a reference's lens samples. The sequence doesn't depend on the method, so one reference serves all
// methods.
inline constexpr Sequence referenceSequence = Sequence::halton;

struct ReferenceOptions {
    std::uint32_t samples = 4096;  // total number of lens samples in the reference's two halves, 2 … maxSamples
    RendererOptions renderer;      // RendererOptions::layerFormat is ignored
    Shadows shadows = Shadows::automatic;
};

struct ReferenceImage {
    Image image;
    std::uint32_t samples = 0;
    std::uint64_t hash = 0;   // hash of the world, the view, the shaders and the samples
    Difference remaining;     // estimated error of the reference itself: mae, rmse, psnr, ssim and flip are set
    double milliseconds = 0;  // render time
    bool reused = false;      // whether the image was read from a file
};

// Returns a remark for a row of an error table; empty if no remark is needed. `psnr` and `flip` state whether the row's
// error, measured by PSNR or FLIP, is below the error of the reference itself.
std::string belowReferenceText(bool psnr, bool flip);

// Renders a reference without storing it. Needs a current GL context. Throws Error if the number of samples is outside
// 2 … maxSamples.
ReferenceImage renderedReference(const World& world, const View& view, const ReferenceOptions& options,
                                 const Progress& progress = {});

// Computes ReferenceImage::hash without rendering the image. Needs no mesh pyramids.
std::uint64_t referenceHash(const World& world, const View& view, const ReferenceOptions& options);

// Returns whether the folder holds a reference with a hash other than `hash`: its complete image, or the image of the
// first half of its samples. referenceImage() would replace that file. Files that cannot be read as images are ignored.
bool holdsOtherReference(const std::filesystem::path& folder, std::uint64_t hash);

// Returns the image in `folder`/reference.exr if that file is complete and its hash equals referenceHash(). Otherwise
// renders the image and writes that file. Continues from reference-half.exr, the image of the first half of the
// samples, if a killed run left that file. Rendering needs a current GL context. Throws Error if the number of samples
// is outside 2 … maxSamples or if the files cannot be written.
ReferenceImage referenceImage(const World& world, const View& view, const ReferenceOptions& options,
                              const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace defocus::engine
