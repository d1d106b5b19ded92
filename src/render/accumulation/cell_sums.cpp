#include "render/accumulation/cell_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace defocus {

namespace {

constexpr int tileSide = 8;  // cellTile of shaders/include/cells.glsl

int tiles(int pixels) {
    return (pixels + tileSide - 1) / tileSide;
}

constexpr int mostDrawn = 7;  // drawnClasses of shaders/include/cells.glsl

// Squares of 2^k px for each k below `levels`; those of single pixels lie around their corners.
GlTexture meanImages(TextureFormat format, const TextureInfo& image, int levels) {
    const auto whole = [&](int pixels) { return ((pixels >> (levels - 1)) + 1) << (levels - 1); };
    GlTexture texture(
        {.format = format, .width = whole(image.width), .height = whole(image.height), .layers = 2, .levels = levels});
    texture.sampling(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

CellPasses::CellPasses(const LensCells& cells, const std::filesystem::path& shaderFolder)
    : defines({{"LENS_CELLS", "1"},
               {"CELLS_IN_FRONT", std::to_string(cells.inFront)},
               {"CELLS_BEHIND", std::to_string(cells.behind)},
               {"LEAST_CELL_VARIANCE", fmt::format("{:.4f}", leastCellVariance)}}) {
    const auto pass = [&](const char* fragment, const ShaderDefines& own) {
        return Program({{fullscreenShader, fragment}, own, shaderFolder});
    };
    const auto means = [&](const ShaderDefines& own) {
        return Program({{"accumulation/cell_tiles.vert", "accumulation/cell_means.frag"}, own, shaderFolder});
    };
    spread = pass("accumulation/spread_classes.frag", defines);
    average = means(defines);
    ShaderDefines nearest = defines;
    nearest.emplace_back("NEAREST", "1");
    if (cells.inFront > 0) averageNearest = means(nearest);
    blur = pass("accumulation/blur_cells.frag", defines);
}

CellSums::CellSums(const LensCells& cells, const GlTexture (&blockSums)[2], const CellPasses& passes)
    : inFront_(cells.inFront),
      behind_(cells.behind),
      passes_(&passes),
      sums_({.format = TextureFormat::rgba32f,
             .width = blockSums[0].info().width,
             .height = blockSums[0].info().height,
             .layers = cells.classes()}),
      held_({.format = TextureFormat::r32ui, .width = tiles(sums_.info().width), .height = tiles(sums_.info().height)}),
      spread_(held_.info()),
      spreadTarget_({&spread_}),
      shownMeans_(meanImages(TextureFormat::rgba32f, sums_.info(), std::max(inFront_, behind_))),
      openMeans_(meanImages(TextureFormat::r32f, sums_.info(), std::max(inFront_, behind_))) {
    sums_.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    for (int i = 0; i < 2; ++i)
        addingTargets_[i] = Target::ofImageAndLayers(blockSums[i], sums_, std::min(cells.classes(), mostDrawn));
    for (int k = 0; k < inFront_; ++k) meanTargets_.push_back(Target::ofLayer({&shownMeans_, &openMeans_}, 0, k));
    for (int k = 0; k < behind_; ++k) meanTargets_.push_back(Target::ofLayer({&shownMeans_, &openMeans_}, 1, k));
}

void CellSums::bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur, bool startsBlock,
                             int to) const {
    addingTargets_[to].bind();
    layerDepths.attach(6);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    if (startsBlock) {
        glClearTexImage(held_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    } else {
        sums_.attach(7);
        glTextureBarrier();  // each pixel is read where it is written
    }
    glBindImageTexture(1, held_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    glBindImageTexture(0, sums_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    glProgramUniform1f(addLayers.name(), 3, static_cast<float>(blur));
}

void CellSums::blurInto(const Target& target, const GlTexture& sum) {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    spreadTarget_.bind();
    held_.attach(0);
    fullscreen_.draw(passes_->spread);
    sums_.attach(0);
    sum.attach(1);
    spread_.attach(2);
    for (int classIndex = 0; classIndex < inFront_ + behind_; ++classIndex) {
        const Program& average = classIndex == inFront_ - 1 ? passes_->averageNearest : passes_->average;
        const int side = 1 << (classIndex < inFront_ ? classIndex : classIndex - inFront_);
        // Drivers shade several pixels at a time: a point has 4 x 4 at least.
        const int pointSide = std::max(tileSide, 4 * side);
        const int columns = (shownMeans_.info().width + pointSide - 1) / pointSide;
        const int rows = (shownMeans_.info().height + pointSide - 1) / pointSide;
        meanTargets_[static_cast<std::size_t>(classIndex)].bind();
        glViewport(0, 0, columns * pointSide / side, rows * pointSide / side);
        glProgramUniform1i(average.name(), 0, classIndex);
        glProgramUniform1i(average.name(), 1, side);
        glProgramUniform1i(average.name(), 2, pointSide / tileSide);
        glProgramUniform2i(average.name(), 3, columns, rows);
        fullscreen_.drawSquares(average, columns * rows);
    }
    shownMeans_.attach(3);
    openMeans_.attach(4);
    target.bind();
    fullscreen_.draw(passes_->blur);
}

std::size_t CellSums::bytes() const {
    return sums_.bytes() + held_.bytes() + spread_.bytes() + shownMeans_.bytes() + openMeans_.bytes();
}

}  // namespace defocus
