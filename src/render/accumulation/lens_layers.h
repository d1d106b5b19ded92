#pragma once
// Draws and sums the data layers of a frame, such as depth and normals (defocus/layers.h), for the same lens samples as
// the image. The pass that draws the image also writes the data layers, to further colour attachments.

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

// Returns whether the number of samples differs between pixels, because the lens barrel hides lens points (cat's eye).
[[nodiscard]] bool countsSamples(const FramePlan& plan);

// Textures for the data layers (depth, normals and other outputs) of a batch (wave) of samples. The pass that draws the
// colours also draws the data layers.
class WaveDataLayers {
public:
    // `picture` holds the colours and depths of the batch (wave) of lens samples. `countsSamples`: true if the number
    // of samples differs between pixels.
    WaveDataLayers(const std::vector<Layer>& layers, bool countsSamples, const WaveLayers& picture);

    // Clears the data layers and binds them, together with the colours and depths, as the render target.
    void begin() const;
    // Binds the data layers, together with the colours and depths, as the render target.
    void bind() const { target_.bind(); }
    // Returns the texture of an output of shaders/accumulation/layers.frag. `slot` is the output's macro, such as
    // "NORMAL_SLOT".
    [[nodiscard]] const GlTexture& of(const std::string& slot) const { return textures_.at(slot); }
    [[nodiscard]] std::size_t bytes() const;

private:
    std::map<std::string, GlTexture> textures_;  // textures of the outputs, keyed by macro, such as "NORMAL_SLOT"
    Target target_;
};

class LensLayers {
public:
    // `size`: size of the layers in px.
    LensLayers(const std::vector<Layer>& layers, bool countsSamples, const glm::ivec2& size,
               std::filesystem::path shaderFolder);

    // Returns the defines of the surface pass whose fragment shader is accumulation/layers.frag.
    [[nodiscard]] static ShaderDefines defines(const std::vector<Layer>& layers, bool countsSamples);
    // Both functions return bytes per pixel: layerBytes() for the data layers of one lens sample, sumBytes() for their
    // sums over all samples.
    [[nodiscard]] static std::uint64_t layerBytes(const std::vector<Layer>& layers, bool countsSamples);
    [[nodiscard]] static std::uint64_t sumBytes(const std::vector<Layer>& layers, bool countsSamples);
    // Returns whether `layers` contains the object or the material layer, which count the samples of each object or
    // material in a pixel. For these layers, the surface pass writes the indices of objects and materials.
    [[nodiscard]] static bool countNumbers(const std::vector<Layer>& layers);

    void reset() { samples_ = 0; }
    // Adds the data layers of samples [first, first + count); see LayerSum::add.
    void add(const WaveDataLayers& wave, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    // Returns the means of all samples so far. Needs at least one sample. `camera`: position of the camera in m.
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
    // Returns the output (slot) whose sum contains the coverage, the sum of alpha. All slots except NUMBER_SLOT have
    // the same alpha, so one of them suffices.
    [[nodiscard]] const std::string& coverageSlot() const;
    void addSlot(const std::string& slot, const GlTexture& layers, const FrameUniforms& frame, std::uint32_t first,
                 std::uint32_t count);
    void addNumbers(Layer layer, const GlTexture& numbers, const FrameUniforms& frame, std::uint32_t first,
                    std::uint32_t count);

    std::vector<Layer> layers_;
    glm::ivec2 size_;
    std::filesystem::path shaderFolder_;
    std::map<std::string, SlotSum> slots_;  // sums of the outputs of layers.frag, keyed by macro, such as "NORMAL_SLOT"
    std::map<Layer, Table> tables_;
    // Framebuffer of the summing passes. Its colour attachment is unused, because the passes write with imageStore.
    Target sums_;
    GlTexture unused_;
    std::map<std::string, Program> programs_;
    Fullscreen fullscreen_;
    std::uint32_t samples_ = 0;
};

}  // namespace defocus::engine
