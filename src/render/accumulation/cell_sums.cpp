#include "render/accumulation/cell_sums.h"

#include <fmt/format.h>

#include <string>

namespace defocus {

namespace {

GlTexture meanImages(int width, int height) {
    GlTexture texture({.format = TextureFormat::rgba32f, .width = width, .height = height, .layers = 2});
    texture.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

CellSums::CellSums(const LensCells& cells, int width, int height, const std::filesystem::path& shaderFolder)
    : inFront_(cells.inFront),
      behind_(cells.behind),
      defines_({{"LENS_CELLS", "1"},
                {"CELLS_IN_FRONT", std::to_string(cells.inFront)},
                {"CELLS_BEHIND", std::to_string(cells.behind)},
                {"LEAST_CELL_VARIANCE", fmt::format("{:.4f}", leastCellVariance)}}),
      sums_({.format = TextureFormat::rgba32f, .width = width, .height = height, .layers = cells.classes()}) {
    for (int classIndex = 0; classIndex < cells.classes(); ++classIndex) {
        ClassMeans& means = means_.emplace_back();
        means.side = 1 << (classIndex < inFront_ ? classIndex : classIndex - inFront_);
        const auto size = [&](int pixels) {
            return means.side == 1 ? pixels + 1 : (pixels + means.side - 1) / means.side;
        };
        means.images = meanImages(size(width), size(height));
        means.target = Target::ofLayers(means.images);
    }
    const auto pass = [&](const char* fragment, const ShaderDefines& defines) {
        return Program({{fullscreenShader, fragment}, defines, shaderFolder});
    };
    average_ = pass("accumulation/cell_means.frag", defines_);
    ShaderDefines nearest = defines_;
    nearest.emplace_back("NEAREST", "1");
    if (inFront_ > 0) averageNearest_ = pass("accumulation/cell_means.frag", nearest);
    blur_ = pass("accumulation/blur_cells.frag", defines_);
}

void CellSums::bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur) const {
    layerDepths.attach(6);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glBindImageTexture(0, sums_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    glProgramUniform1f(addLayers.name(), 3, static_cast<float>(blur));
}

void CellSums::blurInto(const Target& target, const GlTexture& sum) {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    sums_.attach(0);
    sum.attach(1);
    for (GLuint classIndex = 0; classIndex < means_.size(); ++classIndex) {
        const ClassMeans& means = means_[classIndex];
        const Program& average = static_cast<int>(classIndex) == inFront_ - 1 ? averageNearest_ : average_;
        means.target.bind();
        glProgramUniform1i(average.name(), 0, static_cast<GLint>(classIndex));
        glProgramUniform1i(average.name(), 1, means.side);
        fullscreen_.draw(average);
    }
    for (GLuint classIndex = 0; classIndex < means_.size(); ++classIndex)
        means_[classIndex].images.attach(2 + classIndex);
    target.bind();
    fullscreen_.draw(blur_);
}

std::size_t CellSums::bytes() const {
    std::size_t total = sums_.bytes();
    for (const ClassMeans& means : means_) total += means.images.bytes();
    return total;
}

}  // namespace defocus
