#pragma once
// Differences between images, on display-encoded values in [0, 1] at EV 0 (sRGB, clipped) unless said otherwise.
// PSNR with peak 1. SSIM: Wang, Bovik, Sheikh, Simoncelli 2004 (Gaussian 11×11, σ 1.5, on Rec.709 luma, K1 0.01, K2 0.03).
// FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020; HDR: 2021.
// Non-finite values: a pixel that is NaN or infinite in exactly one image counts as the largest difference (1) there; in both,
// as equal. Their number is reported.

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>

#include "image/image.h"

namespace defocus {

struct Difference {
    double mae = 0;       // mean absolute error over pixels and colour channels
    double rmse = 0;      // root mean squared error
    double psnr = 0;      // dB; infinity for equal images
    double ssim = 1;      // mean structural similarity
    double flip = 0;      // mean FLIP at 67 pixels per degree
    double maxError = 0;  // largest absolute difference of a channel
    glm::ivec2 maxErrorPixel{0};  // column, row from the top
    std::uint64_t pixelCount = 0;
    std::uint64_t nonFinite = 0;  // pixels with NaN or infinity in either image
};

struct HdrFlipOptions {
    double startExposure = -4;  // EV
    double stopExposure = 2;    // EV
    int exposures = 4;
};

struct CompareOptions {
    std::optional<HdrFlipOptions> hdrFlip;  // FLIP as HDR-FLIP (ACES) over these exposures instead of LDR-FLIP
    const Image* mask = nullptr;            // 1 channel: only pixels > 0 count (e.g. those that geometry touches)
};

// Compares two images of one size (throws Error otherwise). RGBA is composited over black; grey counts as RGB.
Difference compareImages(const Image& reference, const Image& test, const CompareOptions& options = {});

// FLIP per pixel in [0, 1], 1 channel. `reference` and `test` are LINEAR images; LDR clips them to [0, 1].
Image flipErrorMap(const Image& reference, const Image& test, const std::optional<HdrFlipOptions>& hdr = {},
                   double pixelsPerDegree = 67.0);

// An error map coloured for people (black to white through magma), values in [0, 1] → linear RGB for writeImage.
Image colourMapped(const Image& values);

}  // namespace defocus
