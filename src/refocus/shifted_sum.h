#pragma once
// Weighted mean of images that are moved by fractions of a pixel.
//
// Images are summed in blocks of 64 with Neumaier's compensation, as in render/accumulation/layer_sum.h. Images that
// are not moved, with weight 1, thus give the bits of method accumulation.

#include <glm/vec2.hpp>

#include "image/image.h"
#include "image/image_parts.h"

namespace defocus::engine {

// Pixels beyond the moved image that the resampling filter reads.
inline constexpr int filterReach = 2;

class ShiftedSum {
public:
    // The mean has the size without the margin, which must be at least filterReach. `white`: radiance that is shown as
    // white.
    explicit ShiftedSum(const PartSize& size, float white = 1);

    // Adds an RGBA image of the full size, times `weight` ≥ 0, moved by `shift` px (right, up). Both components must be
    // at least filterReach smaller than the margin. Catmull–Rom interpolation (Catmull and Rom 1974) keeps details
    // sharp. Its overshoot is limited to that of a step from black to white, so that highlights far above white do not
    // get dark rings.
    void add(const Image& image, const glm::dvec2& shift, float weight = 1);
    // Returns the sum divided by the sum of the weights, which must be above 0.
    [[nodiscard]] Image mean() const;

private:
    struct Sum {
        Image value, compensation;
    };
    static void addBlock(Sum& frame, const Sum& block);

    PartSize size_;
    float overshoot_;  // radiance by which interpolation may leave the range of the pixels that it combines
    Sum block_, frame_;
    int inBlock_ = 0;     // images in block_
    double weights_ = 0;  // sum of the weights
};

}  // namespace defocus::engine
