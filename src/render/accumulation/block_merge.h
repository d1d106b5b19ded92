#pragma once
// Combines the block sums of a frame, wherever they were rendered, into the frame's image. The GPU passes are those of
// a single run, so the result is bit-identical on machines of one kind.

#include <optional>

#include "render/accumulation/layer_sum.h"

namespace defocus::engine {

class BlockMerge {
public:
    // Adds the frame's next block, starting with the first sample. All blocks but the last hold 64 samples; all are
    // RGBA and of one size. Needs a current GL 4.5 context. Throws Error for a block of another size or sample count.
    void add(const BlockSum& block);
    // Returns the mean of all samples. Needs at least one block.
    [[nodiscard]] Image image();

private:
    std::optional<LayerSum> sum_;
};

}  // namespace defocus::engine
