#pragma once
// Chooses parts of an image that show details too small to see in the complete picture.

#include <optional>
#include <string>
#include <vector>

#include "frame/driver/reference_image.h"

namespace defocus::engine {

struct Crop {
    std::string title;
    int x = 0;  // left column, px
    int y = 0;  // top row, px
    int width = 0;
    int height = 0;
};

// Returns the square of `size` px with the largest sum in a 1-channel image of values ≥ 0; ties go to the first in
// reading order. The square shares no pixel with `other`. Returns nothing if no square fits.
std::optional<Crop> largestSquare(const Image& values, int size, const std::optional<Crop>& other = {});

// Returns two squares of a quarter of the image's shorter side. In the first, accumulation at full detail with
// `fewSamples` lens samples is farthest from the reference. In the second, the geometry is most blurred. Needs a
// current GL context.
std::vector<Crop> tellingCrops(const World& world, const View& view, const ReferenceImage& reference,
                               std::uint32_t fewSamples, const RendererOptions& options);

}  // namespace defocus::engine
