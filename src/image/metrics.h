#pragma once
// Computes metrics of image differences. Unless stated otherwise, they use display-encoded values in [0, 1] at EV 0
// (sRGB, clipped).
//
// PSNR: the peak value is 1.
//
// SSIM: Wang, Bovik, Sheikh, Simoncelli: "Image Quality Assessment: From Error Visibility to Structural Similarity",
// 2004. Gaussian window 11×11, σ 1.5, on Rec.709 luma; K1 0.01, K2 0.03, dynamic range 1. The mean covers the pixels
// whose window lies inside the image. If there are none (images under 11 px, masks at the edge), the mean covers all
// pixels, with repeated edge pixels outside the image.
//
// FLIP: see flip.h; 67 pixels per degree.
//
// Non-finite values: a pixel that is NaN or infinite in only one image counts as the maximum difference (1 per channel,
// SSIM 0, FLIP 1). A pixel that is non-finite in both images counts as equal. Such pixels do not affect the windows of
// their neighbours. Difference::nonFinite is their number.

#include <cstdint>
#include <functional>
#include <optional>

#include "image/flip.h"
#include "image/image.h"

namespace defocus::engine {

struct CompareOptions {
    std::optional<HdrFlipOptions> hdrFlip;  // if set: HDR-FLIP over these exposures instead of LDR-FLIP
    const Image* mask = nullptr;            // mask with 1 channel; only pixels with a value > 0 are compared
    Image* flipMap = nullptr;               // if set: receives FLIP per pixel (1 channel), regardless of the mask
    std::function<void(const ImageView& rows)> takeFlip =
        {};  // if set: called with the FLIP map in strips from the top
};

// Image that is read in strips of rows, from the top. rows(first, count) returns rows of linear values, which are valid
// until the next call. Strips may overlap, but must not skip rows, and `first` must not decrease.
struct ImageStrips {
    int width = 0;
    int height = 0;
    std::function<ImageView(int first, int count)> rows;
};

inline constexpr std::uint64_t defaultCompareBytes = std::uint64_t{512} << 20;

// Returns the same values as compareImages below, bit for bit. Needs only about `maxBytes` of memory in addition to the
// strips, or as much as 30 rows need if that is more. Both images must have the same size.
Difference compareStrips(const ImageStrips& reference, const ImageStrips& test, const CompareOptions& options,
                         std::uint64_t maxBytes = defaultCompareBytes);

// Compares images like compareImages of the public API, but with options. If no mask pixel is > 0, returns the values
// for identical images, and pixelCount 0.
Difference compareImages(const ImageView& reference, const ImageView& test, const CompareOptions& options);

}  // namespace defocus::engine
