#pragma once
// What every pass of a frame reads: camera, lens, lights and environment as uniforms, the lens samples as instances.

#include <array>
#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t blockSamples = 64;  // samples a block of the sum

// A lens sample as an instance reads it.
struct GpuSample {
    glm::vec4 lensAndJitter;  // u, k·v, jitter x, y in normalised device units
    glm::vec4 eyeAndDither;   // lens point x, y in m, dither offset, layer
};

class FrameUniforms {
public:
    // `layerCount` is K, the lens samples drawn at once: sample i goes to layer (i mod 64) mod K.
    void upload(const World& world, const FramePlan& plan, std::uint32_t layerCount);

    // The defines that shaders/include/frame.glsl and environment.glsl need for this world.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // Binds the uniform blocks (and the environment's map) for samples [firstSample, …) of one block of the sum.
    void bind(std::uint32_t firstSample) const;
    // Binds only what tells the samples of a wave apart where they are shaded; `sample` is any of the wave's.
    void bindWave(std::uint32_t sample) const;
    [[nodiscard]] const Buffer& samples() const { return samples_; }
    // vec2, one a lens sample: its SampleMoment. Empty where nothing moves.
    [[nodiscard]] const Buffer& moments() const { return moments_; }
    // float, one a lens sample: what its wavelength adds to b of C(w). Empty where wavelengths share a focus.
    [[nodiscard]] const Buffer& bandShifts() const { return bandShifts_; }
    // Samples weigh differently from pixel to pixel: the sum's alpha counts those that a pixel has.
    [[nodiscard]] bool countsInAlpha() const { return countsInAlpha_; }
    [[nodiscard]] std::uint32_t layerCount() const { return layerCount_; }  // K
    [[nodiscard]] std::size_t bytes() const;

private:
    void uploadLighting(const World& world);
    void uploadSamples(const FramePlan& plan, std::uint32_t layerCount);
    void uploadBands(const FramePlan& plan, const std::vector<float>& bandShifts);
    [[nodiscard]] std::size_t wavesPerBlock() const;
    [[nodiscard]] std::size_t waveOf(std::uint32_t sample) const;

    ShaderDefines defines_;
    std::array<glm::vec4, 9> irradiance_{};  // of the environment
    Buffer frameBlock_;
    Buffer lightingBlock_;  // empty where the shaders hold it as constants
    Buffer samples_;        // GpuSample, one a lens sample
    Buffer moments_;
    Buffer waves_;         // of each wave: the numbers of its first sample and of the first in its block
    Buffer sampleShifts_;  // vec4, one a lens sample: where the sky lies for it
    Buffer bandShifts_;
    Buffer sampleBands_;  // of shaders/accumulation/add_layers.frag's SampleBlock
    bool countsInAlpha_ = false;
    std::uint32_t layerCount_ = 1;
    GlTexture environmentMap_;
};

}  // namespace defocus::engine
