#pragma once
// Combines the sums of a frame's blocks of 64 samples, which may come from several machines, into the frame's image.
// The merge uses the same GPU passes as a single run, so the image is bit-identical to the image of a single run if all
// GPUs and drivers are equal.

#include <optional>

#include "render/accumulation/layer_sum.h"

namespace defocus::engine {

class BlockMerge {
public:
    // Adds the sum of the frame's next block; blocks must be added in sample order. All sums are RGBA images of equal
    // size. Each contains 64 samples; the last may contain fewer. Needs a current OpenGL 4.5 context. Throws Error for
    // a wrong size or number of samples.
    void add(const BlockSum& block);
    // Returns the mean of all samples of the blocks added so far, at least one block.
    [[nodiscard]] Image image();

private:
    std::optional<LayerSum> sum_;
};

}  // namespace defocus::engine
