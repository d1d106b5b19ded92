#pragma once
// Chooses crops of an image to show enlarged: parts whose details are too small to see in the complete image.

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

// Returns the square of `size` × `size` px with the largest sum of pixel values in `values`, a 1-channel image with
// values ≥ 0. Squares that overlap `other` are excluded. Among equal sums, the first square in row-major order wins.
// Returns nullopt if no square fits.
std::optional<Crop> largestSquare(const Image& values, int size, const std::optional<Crop>& other = {});

// Returns two square crops, each with a side of a quarter of the image's shorter side: one where the error of
// accumulation at full detail with `fewSamples` lens samples is largest, and one where the geometry is most blurred.
// Needs a current GL context.
std::vector<Crop> tellingCrops(const World& world, const View& view, const ReferenceImage& reference,
                               std::uint32_t fewSamples, const RendererOptions& options);

}  // namespace defocus::engine
