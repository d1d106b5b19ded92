#pragma once
// Draws and sums the data layers of a frame (defocus/layers.h) in the same lens samples as the picture. The picture's
// pass writes them as further colour attachments.

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "gl/timer.h"
#include "render/accumulation/wave_layers.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layer_images.h"
#include "render/renderer.h"

namespace defocus::engine {

// Data layers of a wave, which are drawn together with its picture.
class WaveDataLayers {
public:
    // `picture` has the colours and depths of the wave. With `countsSamples`, the number of samples differs between
    // pixels.
    WaveDataLayers(const std::vector<Layer>& layers, bool countsSamples, const WaveLayers& picture);

    // Clears the layers and binds them together with the picture's layers.
    void begin() const;
    // Binds the layers together with the picture's layers.
    void bind() const { target_.bind(); }
    // Returns the texture of an output of shaders/accumulation/layers.frag. `slot` is the output's define, such as
    // "NORMAL_SLOT".
    [[nodiscard]] const GlTexture& of(const std::string& slot) const { return textures_.at(slot); }
    [[nodiscard]] std::size_t bytes() const;

private:
    std::map<std::string, GlTexture> textures_;  // textures, keyed by the name of the slot
    Target target_;
};

class LensLayers {
public:
    // `size`: size of the layers in px.
    LensLayers(const std::vector<Layer>& layers, bool countsSamples, const glm::ivec2& size,
               std::filesystem::path shaderFolder);

    // Returns the defines of the surface pass whose fragment shader is accumulation/layers.frag.
    [[nodiscard]] static ShaderDefines defines(const std::vector<Layer>& layers, bool countsSamples);
    // Return bytes per pixel: of the data layers of one lens sample, and of the sums over all samples.
    [[nodiscard]] static std::uint64_t layerBytes(const std::vector<Layer>& layers);
    [[nodiscard]] static std::uint64_t sumBytes(const std::vector<Layer>& layers);
    // Returns whether the layers count objects or materials. If so, the surface pass writes their indices.
    [[nodiscard]] static bool countNumbers(const std::vector<Layer>& layers);

    void reset() { samples_ = 0; }
    // Adds the layers of samples [first, first + count); see LayerSum::add.
    void add(const WaveDataLayers& wave, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    // Returns the means of all samples so far, at least one. `camera`: position of the camera in m.
    [[nodiscard]] LayerImages images(const glm::dvec3& camera) const;
    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    // Returns the GPU times of the passes that add the layers.
    [[nodiscard]] std::vector<PassTime> times();
    [[nodiscard]] std::size_t bytes() const;

private:
    // Sum of one output (slot) of shaders/accumulation/layers.frag.
    struct SlotSum {
        GlTexture sum;
        GlTexture compensation;
        GpuTimer timer;
    };
    struct Table {
        GlTexture entries;
        GpuTimer timer;
    };

    const Program& program(const char* fragment, ShaderDefines defines);
    // Returns the output (slot) whose sum has the coverage; all slots except NUMBER_SLOT have the same alpha.
    [[nodiscard]] const std::string& coverageSlot() const;
    void addSlot(const std::string& slot, const GlTexture& layers, const FrameUniforms& frame, std::uint32_t first,
                 std::uint32_t count);
    void addNumbers(Layer layer, const GlTexture& numbers, const FrameUniforms& frame, std::uint32_t first,
                    std::uint32_t count);

    std::vector<Layer> layers_;
    glm::ivec2 size_;
    std::filesystem::path shaderFolder_;
    std::map<std::string, SlotSum> slots_;  // sums, keyed by the name of the slot
    std::map<Layer, Table> tables_;
    Target sums_;  // framebuffer for the sums; its colour is never written
    GlTexture unused_;
    std::map<std::string, Program> programs_;
    Fullscreen fullscreen_;
    std::uint32_t samples_ = 0;
};

}  // namespace defocus::engine
