#pragma once
// The image of a frame from the sums of its blocks, wherever these were rendered. The same passes add them as in a
// single run, so that the result has the same bits on machines of one kind.

#include <optional>

#include "render/accumulation/layer_sum.h"

namespace defocus::engine {

class BlockMerge {
public:
    // The frame's blocks in order, from its first sample on: all but the last of 64 samples, RGBA of one size. Needs a
    // current GL 4.5 context. Throws Error for a block that doesn't fit to those before.
    void add(const BlockSum& block);
    // At least one block must be in.
    [[nodiscard]] Image image();

private:
    std::optional<LayerSum> sum_;
};

}  // namespace defocus::engine
