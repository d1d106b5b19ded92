#pragma once
// Weighted mean of images that are moved by whole pixels.
//
// Images are summed in blocks of 64 with Neumaier's compensated summation, as in render/accumulation/layer_sum.h. The
// mean of images that are not moved and have weight 1 is therefore bit-identical to that of method accumulation.

#include <glm/vec2.hpp>
#include <span>

#include "image/half_image.h"
#include "image/image_parts.h"

namespace defocus::engine {

// An image that is moved and weighted.
struct MovedImage {
    const HalfImage* image = nullptr;  // image with its margin
    glm::ivec2 move{0};                // move in px, to the right and up; each component at most the margin
    float weight = 1;                  // ≥ 0
};

class ShiftedSum {
public:
    // The mean has the size without the margin.
    explicit ShiftedSum(const PartSize& size);

    // Adds images, in order. The result doesn't depend on how images are divided between calls.
    void add(std::span<const MovedImage> images);
    // Returns the sum divided by the sum of the weights, which must be above 0.
    [[nodiscard]] Image mean() const;

private:
    struct Sum {
        Image value, compensation;
    };

    PartSize size_;
    Sum block_, frame_;
    int inBlock_ = 0;     // number of images in block_
    double weights_ = 0;  // sum of all weights
};

}  // namespace defocus::engine
