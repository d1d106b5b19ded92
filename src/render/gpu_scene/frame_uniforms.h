#pragma once
// Inputs of every pass of a frame: camera, lens, lights and environment as uniforms; lens samples as instance data.

#include <array>
#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::uint32_t blockSamples = 64;  // samples per block of the sum

// A lens sample as per-instance vertex attributes.
struct GpuSample {
    glm::vec4 lensAndJitter;  // u, k·v; jitter x, y in normalised device coordinates
    glm::vec4 eyeAndDither;   // lens point x, y in m, dither offset, layer
};

class FrameUniforms {
public:
    // `layerCount` is K, the number of lens samples drawn at once: sample i goes to layer (i mod 64) mod K.
    void upload(const World& world, const FramePlan& plan, std::uint32_t layerCount);

    // Defines that shaders/include/frame.glsl and environment.glsl need for this world.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // Binds the uniform blocks and the environment map for samples [firstSample, …) of one block of the sum.
    void bind(std::uint32_t firstSample) const;
    // Binds only the uniforms that differ between waves. `sample`: any sample of the wave.
    void bindWave(std::uint32_t sample) const;
    [[nodiscard]] const Buffer& samples() const { return samples_; }
    // One SampleMoment per lens sample, as a vec3. Empty if nothing moves.
    [[nodiscard]] const Buffer& moments() const { return moments_; }
    // One float per lens sample: the offset that its wavelength adds to b of C(w). Empty without chromatic aberration.
    [[nodiscard]] const Buffer& bandShifts() const { return bandShifts_; }
    // Whether the weight of a sample differs between pixels. The sum's alpha then counts the samples of a pixel.
    [[nodiscard]] bool countsInAlpha() const { return countsInAlpha_; }
    // Whether surfaces have blur modifiers.
    [[nodiscard]] bool usesOwnBlur() const { return usesOwnBlur_; }
    [[nodiscard]] std::uint32_t layerCount() const { return layerCount_; }  // K
    [[nodiscard]] std::size_t bytes() const;

private:
    void uploadLighting(const World& world);
    void uploadSamples(const FramePlan& plan, std::uint32_t layerCount);
    void uploadBands(const FramePlan& plan, const std::vector<float>& bandShifts);
    [[nodiscard]] std::size_t wavesPerBlock() const;
    [[nodiscard]] std::size_t waveOf(std::uint32_t sample) const;

    ShaderDefines defines_;
    std::array<glm::vec4, 9> irradiance_{};  // of the environment; see diffuseCoefficients
    Buffer frameBlock_;
    Buffer lightingBlock_;  // empty if the shaders have the lighting as constants
    Buffer samples_;        // one GpuSample per lens sample
    Buffer moments_;
    Buffer waves_;         // per wave: number of its first sample, and of the first sample of its block
    Buffer sampleShifts_;  // vec4 per lens sample: offset of the sky
    Buffer bandShifts_;
    Buffer sampleBands_;  // SampleBlock of shaders/accumulation/layer_light.glsl
    bool countsInAlpha_ = false;
    bool usesOwnBlur_ = false;
    std::uint32_t layerCount_ = 1;
    GlTexture environmentMap_;
};

}  // namespace defocus::engine
