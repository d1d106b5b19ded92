#pragma once
// Data layers of a frame, such as depth and motion vectors (defocus/layers.h), as a renderer returns them.

#include <cstdint>
#include <map>
#include <vector>

#include "defocus/layers.h"
#include "image/image.h"

namespace defocus::engine {

// For each pixel, how many lens samples show each object or material.
struct NumberCounts {
    int width = 0;
    int height = 0;
    int entries = 0;  // max number of different objects or materials in a pixel
    // `entries` values per pixel, row 0 at the top: (1 + index of the object or material) · 2¹⁶ + (number of samples).
    // Unused entries of a pixel are at the end, and are 0.
    std::vector<std::uint32_t> values;
};

struct LayerImages {
    Image coverage;                         // 1 channel: fraction of the samples that show a surface
    std::map<Layer, Image> means;           // premultiplied means of 1 to 3 channels
    Image nearestDepth;                     // only with Layer::depth: min depth in m over all samples; +∞: no surface
    Image samples;                          // 1 channel: number of lens samples that contribute to the pixel
    std::map<Layer, NumberCounts> numbers;  // key: Layer::objects or Layer::materials
};

}  // namespace defocus::engine
