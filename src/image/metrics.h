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

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "image/flip.h"
#include "image/image.h"

namespace defocus {

struct Difference {
    double mae = 0;                // mean absolute error over pixels and colour channels
    double rmse = 0;               // root mean squared error over pixels and colour channels
    double psnr = 0;               // dB; infinity for equal images
    double ssim = 1;               // mean structural similarity
    double flip = 0;               // mean FLIP
    double maxError = 0;           // largest absolute difference of a channel
    glm::ivec2 maxErrorPixel{0};   // column, row from the top; the first one in reading order
    std::uint64_t pixelCount = 0;  // pixels that counted
    std::uint64_t nonFinite = 0;   // of these, with NaN or infinity in either image
};

struct CompareOptions {
    std::optional<HdrFlipOptions> hdrFlip;  // FLIP as HDR-FLIP (ACES) over these exposures instead of LDR-FLIP
    const Image* mask = nullptr;            // 1 channel: only pixels > 0 count (e.g. those that geometry touches)
    Image* flipMap = nullptr;               // receives FLIP per pixel (1 channel, the whole image)
};

// Compares two images of one size (throws Error otherwise). RGBA is composited over black; grey counts as RGB. A mask
// that lets no pixel count gives the values of equal images with a pixelCount of 0.
Difference compareImages(const Image& reference, const Image& test, const CompareOptions& options = {});

}  // namespace defocus
