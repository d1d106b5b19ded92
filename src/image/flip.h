#pragma once
// FLIP: the difference that a viewer perceives when alternating between two images.
//
// LDR: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating
// Images", HPG 2020.
//
// HDR: Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics Short Papers 2021. HDR-FLIP is the maximum of LDR-FLIP over several exposures, tone-mapped with the ACES
// curve of K. Narkowicz. Exposures are given by the caller, because the paper's automatic exposures fail on mostly
// black images.

#include <optional>

#include "image/image.h"

namespace defocus::engine {

struct HdrFlipOptions {
    double startExposure = -4;  // first exposure in EV
    double stopExposure = 2;    // last exposure in EV, ≥ startExposure
    int exposures = 4;          // number of exposures, evenly spaced; 1 (startExposure only) to 64
};

// Default of the FLIP papers: a monitor of 3840 px and 0.7 m width, seen from a distance of 0.7 m.
inline constexpr double defaultPixelsPerDegree = 67.0;

// Returns the radius in px of the largest filter: the FLIP value of a pixel depends only on pixels within this distance
// in each direction.
int flipRadius(double pixelsPerDegree = defaultPixelsPerDegree);

// Returns FLIP per pixel in [0, 1] with 1 channel: HDR-FLIP if `hdr` is set, else LDR-FLIP, which clips colours to [0,
// 1]. Images are linear, of equal size, with 1, 3 or 4 channels; alpha is ignored. A pixel that is NaN or infinite in
// only one image gets 1; in both, 0. Such pixels do not affect their neighbours. Throws Error if sizes differ or
// options are out of range.
Image flipErrorMap(const ImageView& reference, const ImageView& test, const std::optional<HdrFlipOptions>& hdr = {},
                   double pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace defocus::engine
