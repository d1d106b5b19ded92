#pragma once
// Computes the weighted mean of images that are moved by whole pixels.

#include <glm/vec2.hpp>
#include <span>

#include "image/half_image.h"
#include "image/image_parts.h"

namespace defocus::engine {

// An image, and the displacement and the weight with which it is added.
struct MovedImage {
    const HalfImage* image = nullptr;  // image, including the margin around the visible image
    glm::ivec2 move{0};                // displacement in px, to the right and up; at most PartSize::margin per axis
    float weight = 1;                  // weight of the image in the sum, ≥ 0
};

class ShiftedSum {
public:
    // `size`: size and margin of all images. The mean has no margin.
    explicit ShiftedSum(const PartSize& size);

    // Adds images in the given order. The result doesn't depend on how the images are divided between calls.
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
