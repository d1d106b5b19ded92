#pragma once
// Data layers of a frame (defocus/layers.h), as a renderer returns them.

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
    // `entries` values per pixel, row 0 at the top: number · 2¹⁶ + count, 0 after the last.
    std::vector<std::uint32_t> values;
};

struct LayerImages {
    Image coverage;                         // 1 channel: share of the samples that show a surface
    std::map<Layer, Image> means;           // premultiplied; 1 to 3 channels
    Image nearestDepth;                     // with Layer::depth: m, +∞ where no sample shows a surface
    Image samples;                          // 1 channel: number of lens samples that the pixel counts
    std::map<Layer, NumberCounts> numbers;  // Layer::objects and materials; number i + 1 is object or material i
};

}  // namespace defocus::engine
