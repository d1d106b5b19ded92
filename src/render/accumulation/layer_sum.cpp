// Source of the compensated sum: Neumaier 1974, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen.

#include "render/accumulation/layer_sum.h"

#include <cassert>

#include "core/error.h"
#include "gl/read_back.h"

namespace defocus::engine {

LayerSum::Sum::Sum(int width, int height) {
    for (int i = 0; i < 2; ++i) {
        sum[i] = GlTexture({.format = TextureFormat::rgba32f, .width = width, .height = height, .linear = true});
        compensation[i] = GlTexture({.format = TextureFormat::rgba32f, .width = width, .height = height});
        target[i] = Target({&sum[i], &compensation[i]});
    }
}

LayerSum::LayerSum(const LayerSumInfo& info)
    : info_(info), block_(info.width, info.height), frame_(info.width, info.height) {
    const auto pass = [&](const char* fragment) {
        return Program({{fullscreenShader, fragment}, layerFormatDefines(info.format), info.shaderFolder});
    };
    addBlock_ = pass("accumulation/add_block.frag");
    resolve_ = pass("accumulation/resolve.frag");
}

void LayerSum::reset(const glm::ivec2& first) {
    samples_ = 0;
    meanIsCurrent_ = false;
    first_ = first;
    blursCells_ = false;
}

void LayerSum::blurCells(const LensCells& cells) {
    assert(samples_ % blockSamples == 0);
    cellBlur_ = cells.blur;
    blursCells_ = cells.classes() > 0;
    if (!blursCells_ || (cells_ && cells_->fits(cells))) return;
    const auto passes = cellPasses_.try_emplace({cells.inFront, cells.behind}, cells, info_.shaderFolder).first;
    cells_.emplace(cells, block_.sum, passes->second);
}

void LayerSum::add(const WaveLayers& layers, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count) {
    ShaderDefines defines = frame.defines();
    for (const auto& define : layerFormatDefines(info_.format)) defines.push_back(define);
    if (samples_ % blockSamples == 0) defines.emplace_back("startsBlock", "true");
    if (blursCells_) defines.insert(defines.end(), cells_->defines().begin(), cells_->defines().end());
    const auto [entry, isNew] = addLayers_.try_emplace(defines);
    Program& addLayers = entry->second;
    const char* fragment = blursCells_ ? "accumulation/add_layers_to_cells.frag" : "accumulation/add_layers.frag";
    if (isNew) addLayers = Program({{fullscreenShader, fragment}, defines, info_.shaderFolder});
    const int next = 1 - block_.current;
    if (!blursCells_) block_.target[next].bind();
    frame.bind(first);
    layers.colors().attach(0);
    block_.sum[block_.current].attach(1);
    block_.compensation[block_.current].attach(2);
    if (blursCells_) cells_->bindForAdding(addLayers, layers.depths(), cellBlur_, samples_ % blockSamples == 0, next);
    glProgramUniform1i(addLayers.name(), 0, static_cast<GLint>(count));
    glProgramUniform1i(addLayers.name(), 1, static_cast<GLint>(samples_ % blockSamples));
    glProgramUniform2i(addLayers.name(), 2, first_.x, first_.y);
    fullscreen_.draw(addLayers);
    block_.flip();
    countsInAlpha_ = frame.countsInAlpha();
    samples_ += count;
    meanIsCurrent_ = false;
    if (samples_ % blockSamples == 0) {
        block_.current = latestBlock(true);
        addBlockTo(frame_, block_.current, samples_ == blockSamples);
        frame_.flip();
    }
}

int LayerSum::latestBlock(bool asAdded) {
    if (!blursCells_ || !asAdded) return block_.current;
    const int other = 1 - block_.current;
    cells_->blurInto(block_.target[other], block_.sum[block_.current]);
    return other;
}

void LayerSum::addBlockTo(Sum& frame, int block, bool startsFrame) {
    frame.target[1 - frame.current].bind();
    block_.sum[block].attach(0);
    block_.compensation[block].attach(1);
    frame.sum[frame.current].attach(2);
    frame.compensation[frame.current].attach(3);
    glProgramUniform1i(addBlock_.name(), 0, startsFrame ? 1 : 0);
    fullscreen_.draw(addBlock_);
}

BlockSum LayerSum::block() {
    if (samples_ == 0) fail("no samples have been accumulated yet");
    const int latest = latestBlock(samples_ % blockSamples != 0);
    return {(samples_ - 1) % blockSamples + 1, readBack(block_.sum[latest], 4),
            readBack(block_.compensation[latest], 4)};
}

void LayerSum::addBlock(const BlockSum& block) {
    assert(samples_ % blockSamples == 0 && block.samples >= 1 && block.samples <= blockSamples);
    upload(block_.sum[block_.current], block.sum);
    upload(block_.compensation[block_.current], block.compensation);
    samples_ += block.samples;
    meanIsCurrent_ = false;
    if (samples_ % blockSamples == 0) {
        addBlockTo(frame_, block_.current, samples_ == blockSamples);
        frame_.flip();
    }
}

Image LayerSum::mean() {
    return readBack(meanTexture(), 4);
}

const GlTexture& LayerSum::meanTexture() {
    makeMean();
    return mean_;
}

void LayerSum::makeMean() {
    if (samples_ == 0) fail("no samples have been accumulated yet");
    if (meanIsCurrent_) return;
    if (!mean_) {
        mean_ =
            GlTexture({.format = TextureFormat::rgba32f, .width = info_.width, .height = info_.height, .linear = true});
        meanTarget_ = Target({&mean_});
    }
    const float divisor = countsInAlpha_ ? 0.0f : static_cast<float>(samples_);
    // The frame's sum contains only complete blocks, so add an unfinished block to a copy of this sum. If no block is
    // complete yet, the mean is computed from the unfinished block alone.
    const bool unfinished = samples_ % blockSamples != 0;
    const bool isFirst = samples_ < blockSamples;
    if (isFirst && blursCells_)
        cells_->blurInto(meanTarget_, block_.sum[block_.current], divisor);
    else if (isFirst)
        divide(block_, block_.current, divisor);
    else if (unfinished) {
        addBlockTo(frame_, latestBlock(true), false);
        divide(frame_, 1 - frame_.current, divisor);
    } else {
        divide(frame_, frame_.current, divisor);
    }
    meanIsCurrent_ = true;
}

void LayerSum::divide(const Sum& total, int latest, float divisor) {
    meanTarget_.bind();
    total.sum[latest].attach(0);
    total.compensation[latest].attach(1);
    glProgramUniform1f(resolve_.name(), 0, divisor);
    fullscreen_.draw(resolve_);
}

std::size_t LayerSum::bytes() const {
    std::size_t total = mean_.bytes() + (cells_ ? cells_->bytes() : 0);
    for (const Sum* sum : {&block_, &frame_})
        for (int i = 0; i < 2; ++i) total += sum->sum[i].bytes() + sum->compensation[i].bytes();
    return total;
}

}  // namespace defocus::engine
