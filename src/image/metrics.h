#pragma once
// Differences between images, on display-encoded values in [0, 1] at EV 0 (sRGB, clipped) unless said otherwise.
//   PSNR: peak 1.
//   SSIM: Wang, Bovik, Sheikh, Simoncelli: "Image Quality Assessment: From Error Visibility to Structural Similarity",
//   2004.
//         Gaussian 11×11, σ 1.5, on Rec.709 luma, K1 0.01, K2 0.03, dynamic range 1; the mean over the pixels whose
//         window lies inside the image, or, where there are none (images under 11 px, masks at the edge), over all with
//         edges repeated.
//   FLIP: see flip.h; at 67 pixels per degree.
// Non-finite values: a pixel that is NaN or infinite in exactly one image counts as the largest difference there (1 in
// every channel, SSIM 0, FLIP 1), in both as equal; it takes no part in the windows of its neighbours. Their number is
// reported.

#include <optional>

#include "image/flip.h"
#include "image/image.h"

namespace defocus::engine {

struct CompareOptions {
    std::optional<HdrFlipOptions> hdrFlip;  // FLIP as HDR-FLIP (ACES) over these exposures instead of LDR-FLIP
    const Image* mask = nullptr;            // 1 channel: only pixels > 0 count (e.g. those that geometry touches)
    Image* flipMap = nullptr;               // receives FLIP per pixel (1 channel, the whole image)
};

// compareImages of the public API with options. A mask that lets no pixel count gives the values of equal images with a
// pixelCount of 0.
Difference compareImages(const ImageView& reference, const ImageView& test, const CompareOptions& options);

}  // namespace defocus::engine
