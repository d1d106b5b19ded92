#include "render/accumulation/cell_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace defocus::engine {

namespace {

constexpr int tileSide = 8;  // tile side in px; equals cellTile in shaders/include/cells.glsl

int tiles(int pixels) {
    return (pixels + tileSide - 1) / tileSide;
}

// Max number of blur classes (groups of pixel values with similar blur) whose sums are colour attachments. Equals the
// max of drawnClasses in shaders/include/cells.glsl.
constexpr int maxDrawn = 7;

// blurInto() draws point sprites whose side depends on the blur class. This is the largest side in px of the image, a
// multiple of all smaller sides.
constexpr int largestPoint = 4 << (maxCellClasses - 1);

// Returns the columns and rows of the grid of squares over which blur class 0, the least blurred class, is averaged.
// The squares of this class have the size of a pixel. They are centred on pixel corners, so the grid has more columns
// and rows than the image.
glm::ivec2 squaresOf(const TextureInfo& image) {
    const auto whole = [](int pixels) { return (pixels / largestPoint + 1) * largestPoint; };
    return {whole(image.width), whole(image.height)};
}

// Allocates a texture for means over squares of pixels, for all blur classes; meansOrigin() returns the position of
// each class in the texture.
GlTexture meanImages(TextureFormat format, const glm::ivec2& squares, int classes) {
    return GlTexture({.format = format,
                      .width = classes > 1 ? squares.x + squares.x / 2 : squares.x,
                      .height = squares.y,
                      .layers = 2,
                      .linear = true});
}

glm::ivec2 meansOrigin(const glm::ivec2& squares, int k) {
    return k == 0 ? glm::ivec2(0) : glm::ivec2(squares.x, squares.y - (squares.y >> (k - 1)));
}

}  // namespace

CellPasses::CellPasses(const LensCells& cells, const std::filesystem::path& shaderFolder)
    : defines({{"cellsInFront", std::to_string(cells.inFront)},
               {"cellsBehind", std::to_string(cells.behind)},
               {"minCellVariance", fmt::format("{:.4f}", minCellVariance)}}) {
    const auto pass = [&](const char* fragment, const ShaderDefines& own) {
        return Program({{fullscreenShader, fragment}, own, shaderFolder});
    };
    const auto means = [&](const ShaderDefines& own) {
        return Program({{"accumulation/cell_tiles.vert", "accumulation/cell_means.frag"}, own, shaderFolder});
    };
    spread = pass("accumulation/spread_classes.frag", defines);
    average = means(defines);
    ShaderDefines nearest = defines;
    nearest.emplace_back("nearestClass", "true");
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
             .layers = cells.classes(),
             .linear = true}),
      held_({.format = TextureFormat::r32ui, .width = tiles(sums_.info().width), .height = tiles(sums_.info().height)}),
      spread_(held_.info()),
      spreadTarget_({&spread_}),
      squares_(squaresOf(sums_.info())),
      shownMeans_(meanImages(TextureFormat::rgba32f, squares_, std::max(inFront_, behind_))),
      openMeans_(meanImages(TextureFormat::r32f, squares_, std::max(inFront_, behind_))),
      meanTargets_{Target::ofLayer({&shownMeans_, &openMeans_}, 0), Target::ofLayer({&shownMeans_, &openMeans_}, 1)} {
    for (int i = 0; i < 2; ++i)
        addingTargets_[i] = Target::ofImageAndLayers(blockSums[i], sums_, std::min(cells.classes(), maxDrawn));
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
        glTextureBarrier();  // suffices, because each fragment reads only texels at its own position
    }
    glBindImageTexture(1, held_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    glBindImageTexture(0, sums_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    glProgramUniform1f(addLayers.name(), 3, static_cast<float>(blur));
}

void CellSums::blurInto(const Target& target, const GlTexture& sum, float samples) {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    spreadTarget_.bind();
    held_.attach(0);
    fullscreen_.draw(passes_->spread);
    sums_.attach(0);
    sum.attach(1);
    spread_.attach(2);
    for (int classIndex = 0; classIndex < inFront_ + behind_; ++classIndex) {
        const Program& average = classIndex == inFront_ - 1 ? passes_->averageNearest : passes_->average;
        const bool isBehind = classIndex >= inFront_;
        const int k = isBehind ? classIndex - inFront_ : classIndex;
        const int side = 1 << k;
        // A point sprite covers at least 4 x 4 pixels of the target: pixels are shaded in groups, so smaller sprites
        // would waste work.
        const int pointSide = std::max(tileSide, 4 * side);
        const int columns = squares_.x / pointSide;
        const int rows = squares_.y / pointSide;
        const glm::ivec2 origin = meansOrigin(squares_, k);
        meanTargets_[isBehind ? 1 : 0].bind();
        glViewport(origin.x, origin.y, squares_.x / side, squares_.y / side);
        glProgramUniform1i(average.name(), 0, classIndex);
        glProgramUniform1i(average.name(), 1, side);
        glProgramUniform1i(average.name(), 2, pointSide / tileSide);
        glProgramUniform2i(average.name(), 3, columns, rows);
        glProgramUniform2i(average.name(), 4, origin.x, origin.y);
        fullscreen_.drawSquares(average, columns * rows);
    }
    shownMeans_.attach(3);
    openMeans_.attach(4);
    target.bind();
    glProgramUniform2i(passes_->blur.name(), 0, squares_.x, squares_.y);
    glProgramUniform1f(passes_->blur.name(), 1, samples);
    fullscreen_.draw(passes_->blur);
}

std::size_t CellSums::bytes() const {
    return sums_.bytes() + held_.bytes() + spread_.bytes() + shownMeans_.bytes() + openMeans_.bytes();
}

}  // namespace defocus::engine
