#pragma once
// Where to look: parts of an image that show what a whole picture hides.

#include <optional>
#include <string>
#include <vector>

#include "frame/reference_image.h"

namespace defocus {

struct Crop {
    std::string title;
    int x = 0;  // of its left column
    int y = 0;  // of its top row
    int width = 0;
    int height = 0;
};

// The square of `size` px with the largest sum of a 1-channel image of values ≥ 0 (the first such in reading order),
// where it shares no pixel with `other`; nothing where no square fits.
std::optional<Crop> largestSquare(const Image& values, int size, const std::optional<Crop>& other = {});

// Two squares of a quarter of the image's shorter side: where accumulation at full detail with `fewSamples` lens
// samples is farthest from the reference, and where what geometry shows is most blurred. Needs a current GL context.
std::vector<Crop> tellingCrops(const World& world, const View& view, const ReferenceImage& reference,
                               std::uint32_t fewSamples, const RendererOptions& options);

}  // namespace defocus
