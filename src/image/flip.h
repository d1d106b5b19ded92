#pragma once
// FLIP, the difference a person sees when alternating between two images.
//   LDR: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for
//   Alternating
//        Images", HPG 2020.
//   HDR: Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range Images",
//        Eurographics Short Papers 2021. The largest LDR-FLIP over a range of exposures, each through the ACES curve of
//        K. Narkowicz. The exposures are given, as the automatic ones fail on mostly black images.

#include <optional>

#include "image/image.h"

namespace defocus::engine {

struct HdrFlipOptions {
    double startExposure = -4;  // EV
    double stopExposure = 2;    // EV, not below startExposure
    int exposures = 4;          // evenly spaced from start to stop, 1 (start alone) to 64
};

// FLIP's own default: a 0.7 m wide 3840 px monitor seen from 0.7 m.
inline constexpr double defaultPixelsPerDegree = 67.0;

// FLIP per pixel in [0, 1], 1 channel. Both images are LINEAR, of one size, with 1, 3 or 4 channels (alpha takes no
// part); LDR clips them to [0, 1]. A pixel that is NaN or infinite in exactly one image gets 1, in both 0; it takes no
// part in its neighbours. Throws Error for sizes that differ or options out of range.
Image flipErrorMap(const ImageView& reference, const ImageView& test, const std::optional<HdrFlipOptions>& hdr = {},
                   double pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace defocus::engine
