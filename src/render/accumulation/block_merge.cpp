#include "render/accumulation/block_merge.h"

#include "core/error.h"

namespace defocus::engine {

void BlockMerge::add(const BlockSum& block) {
    const Image& image = block.sum;
    if (!sum_) sum_.emplace(LayerSumInfo{.width = image.width, .height = image.height, .format = LayerFormat::rgba16f});
    if (block.samples < 1 || block.samples > blockSamples || sum_->samples() % blockSamples != 0)
        fail("only the last block of a frame may have fewer than {} samples, and none may have more", blockSamples);
    for (const Image* each : {&block.sum, &block.compensation})
        if (each->width != sum_->info().width || each->height != sum_->info().height || each->channels != 4)
            fail("a block differs in size from the blocks before it");
    sum_->addBlock(block);
}

Image BlockMerge::image() {
    if (!sum_) fail("there are no blocks of samples to merge");
    return sum_->mean();
}

}  // namespace defocus::engine
