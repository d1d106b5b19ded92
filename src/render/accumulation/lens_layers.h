#pragma once
// Draws and sums the data layers of a frame (defocus/layers.h) in the same lens samples as the picture. The picture's
// pass writes them as further colour attachments.

#include <map>
#include <string>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "gl/timer.h"
#include "render/accumulation/layer_sum.h"
#include "render/layer_images.h"
#include "render/renderer.h"

namespace defocus::engine {

class LensLayers {
public:
    // `picture` has the colours and depths of the waves; it must outlive this object. With `countsSamples`, the number
    // of samples differs between pixels.
    LensLayers(const std::vector<Layer>& layers, const LayerSum& picture, bool countsSamples);

    // Returns the defines of the surface pass whose fragment shader is accumulation/layers.frag.
    [[nodiscard]] static ShaderDefines defines(const std::vector<Layer>& layers, bool countsSamples);
    // Return bytes per pixel: of the data layers of one lens sample, and of the sums over all samples.
    [[nodiscard]] static std::uint64_t layerBytes(const std::vector<Layer>& layers);
    [[nodiscard]] static std::uint64_t sumBytes(const std::vector<Layer>& layers);

    void reset() { samples_ = 0; }
    // Clears the layers and binds them together with the picture's layers.
    void beginWave();
    // Binds the layers together with the picture's layers.
    void bind() const { target_.bind(); }
    // Adds the layers of samples [first, first + count); see LayerSum::endWave.
    void endWave(const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    // Returns the means of all samples so far, at least one. `camera`: position of the camera in m.
    [[nodiscard]] LayerImages images(const glm::dvec3& camera) const;
    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] bool countsNumbers() const { return !tables_.empty(); }
    // Returns the GPU times of the sums.
    [[nodiscard]] std::vector<PassTime> times();
    [[nodiscard]] std::size_t bytes() const;

private:
    // Colour attachment of the surface pass with its sum.
    struct Attachment {
        GlTexture layers;
        GlTexture sum;
        GlTexture compensation;
        GpuTimer timer;
    };
    struct Table {
        GlTexture entries;
        GpuTimer timer;
    };

    const Program& program(const char* fragment, ShaderDefines defines);
    void sumAttachment(const std::string& slot, Attachment& attachment, const FrameUniforms& frame, std::uint32_t first,
                       std::uint32_t count);
    void countNumbers(Layer layer, Table& table, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);

    std::vector<Layer> layers_;
    LayerSumInfo info_;
    std::map<std::string, Attachment> attachments_;  // key: name of the slot in shaders/accumulation/layers.frag
    std::map<Layer, Table> tables_;
    Target target_;
    Target sums_;  // framebuffer for the sums; its colour is never written
    GlTexture unused_;
    std::map<std::string, Program> programs_;
    Fullscreen fullscreen_;
    std::uint32_t samples_ = 0;
};

}  // namespace defocus::engine
