#pragma once
// Uploads the shader inputs that all passes of a frame share: camera, lens, lights and environment as uniforms; lens
// samples as per-instance attributes.

#include <array>
#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Lens sample as per-instance vertex attributes.
struct GpuSample {
    glm::vec4 lensAndJitter;  // xy: lens point (u, k·v), k = image width / height; zw: subpixel jitter (NDC)
    glm::vec4 eyeAndSample;   // xy: lens point in m; z: index of the sample in the frame; w: layer to draw into
};

class FrameUniforms {
public:
    // Uploads the inputs of one frame. `layerCount` is K, the number of samples that are drawn together: sample i of a
    // block of 64 samples is drawn into layer i mod K.
    void upload(const World& world, const FramePlan& plan, std::uint32_t layerCount);

    // Returns the defines that shaders/include/frame.glsl and environment.glsl need for this frame.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    // Binds the uniform blocks and the environment map for samples from `firstSample` to the end of its block of 64
    // samples.
    void bind(std::uint32_t firstSample) const;
    // Binds only the uniforms that differ between batches (waves) of samples, for the batch that contains `sample`.
    void bindWave(std::uint32_t sample) const;
    [[nodiscard]] const Buffer& samples() const { return samples_; }
    // Returns one SampleMoment (time within the exposure) per lens sample, as a vec3: index of a shutter time,
    // interpolation weight of the next shutter time, and time. Empty if nothing moves.
    [[nodiscard]] const Buffer& moments() const { return moments_; }
    // Returns one float per lens sample: the change that the sample's wavelength causes in b, where a + b·w is the
    // clip-space circle of confusion at depth w. Empty without chromatic aberration.
    [[nodiscard]] const Buffer& bandShifts() const { return bandShifts_; }
    // Returns whether the number of samples differs between pixels, because the lens barrel hides lens points (cat's
    // eye). If so, the sum's alpha is the pixel's number of samples.
    [[nodiscard]] bool countsInAlpha() const { return countsInAlpha_; }
    // Returns whether surfaces have blur modifiers (factor and offset of their blur).
    [[nodiscard]] bool usesOwnBlur() const { return usesOwnBlur_; }
    [[nodiscard]] std::uint32_t layerCount() const { return layerCount_; }  // number of samples drawn together
    [[nodiscard]] std::size_t bytes() const;

private:
    void uploadLighting(const World& world);
    void uploadSamples(const FramePlan& plan, std::uint32_t layerCount);
    void uploadBands(const FramePlan& plan, const std::vector<float>& bandShifts);
    [[nodiscard]] std::size_t wavesPerBlock() const;
    [[nodiscard]] std::size_t waveOf(std::uint32_t sample) const;

    ShaderDefines defines_;
    std::array<glm::vec4, 9> irradiance_{};  // coefficients of the environment's irradiance (diffuseCoefficients)
    Buffer frameBlock_;
    Buffer lightingBlock_;  // empty if shaders contain the lighting as constants
    Buffer samples_;        // GpuSample of each lens sample
    Buffer moments_;
    Buffer waves_;  // WaveBlock (shaders/include/shading.glsl) of each batch of samples
    // One vec4 per lens sample: by how much the sample shifts the sky, on the image plane at distance 1.
    Buffer sampleShifts_;
    Buffer bandShifts_;
    // Wavelength weights and lens points of the samples: SampleBlock (shaders/accumulation/layer_light.glsl), once per
    // block of samples.
    Buffer sampleBands_;
    bool countsInAlpha_ = false;
    bool usesOwnBlur_ = false;
    std::uint32_t layerCount_ = 1;
    GlTexture environmentMap_;
    GlTexture specularAlbedos_;  // albedos of specular reflection (SpecularAlbedoTable)
};

}  // namespace defocus::engine
