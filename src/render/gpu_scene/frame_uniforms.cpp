#include "render/gpu_scene/frame_uniforms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <numbers>

#include "core/error.h"
#include "lens/wavelengths.h"
#include "render/gpu_scene/environment_light.h"
#include "render/gpu_scene/layer_window.h"
#include "scene/specular_albedo.h"

namespace defocus::engine {

namespace {

constexpr double unlimitedBlur = 1e9;  // in image widths; not infinite, because infinity times 0 is NaN
constexpr std::size_t maxConstantLights = 4;

// Max size in bytes of the uniform blocks in shaders/include/frame.glsl and lighting.glsl.
constexpr std::size_t everyDriversBlock = 16 << 10;  // every driver allows at least 16 KiB (GL_MAX_UNIFORM_BLOCK_SIZE)

struct GpuLight {
    glm::vec4 directionType;
    glm::vec4 colorScale;
    glm::vec4 cone;
};

struct GpuFrame {
    glm::vec4 projection;
    glm::vec4 coc;
    glm::vec4 cocField;
    glm::vec4 cocLimits;
    glm::vec4 cocOther;
    glm::vec4 window;
    glm::mat4 worldFromView;
    std::array<glm::vec4, maxLights> lightPositions;
};

struct GpuLighting {
    std::array<glm::vec4, 3> environment;
    std::array<glm::vec4, 9> irradiance;
    std::array<GpuLight, maxLights> lights;
};
static_assert(sizeof(GpuFrame) <= everyDriversBlock && sizeof(GpuLighting) <= everyDriversBlock);

GpuLight gpuLight(const PlacedLight& placed) {
    const Light& light = placed.light;
    const glm::vec3 direction(glm::normalize(placed.direction));
    // The attenuation by a spot light's cone is the square of a ramp that is linear in the cosine of the angle: 0 at
    // the outer and 1 at the inner cone angle (KHR_lights_punctual). The shader computes the square.
    const float inner = std::cos(light.innerConeAngle);
    const float outer = std::cos(light.outerConeAngle);
    const float scale = 1.0f / std::max(inner - outer, 1e-4f);
    const float type = light.type == LightType::directional ? 0.0f : light.type == LightType::point ? 1.0f : 2.0f;
    return {glm::vec4(direction, type), glm::vec4(light.color * (light.intensity / std::numbers::pi_v<float>), scale),
            glm::vec4(-outer * scale, 0, 0, 0)};
}

// Returns the number that stands for the environment type in the shaders.
int environmentNumber(EnvironmentType type) {
    static_assert(static_cast<int>(EnvironmentType::map) == 3);
    return static_cast<int>(type);
}

GlTexture environmentTexture(const Image& map) {
    const int levels = mipmapLevels(map.width, map.height);
    std::vector<float> rgba(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) * 4);
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            const auto channels = static_cast<std::size_t>(map.channels);
            const float value = c == 3 ? 1.0f : map.pixels[i * channels + (channels >= 3 ? c : 0)];
            rgba[i * 4 + c] = std::min(std::max(0.0f, value), 65504.0f);  // this order of arguments maps NaN to 0
        }
    GlTexture texture({.format = TextureFormat::rgba16f, .width = map.width, .height = map.height, .levels = levels});
    texture.upload(0, map.width, map.height, rgba.data());
    texture.generateMipmaps();
    texture.sampling(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT, GL_CLAMP_TO_EDGE);
    return texture;
}

GlTexture specularAlbedoTexture() {
    constexpr int side = SpecularAlbedoTable::side;
    GlTexture texture({.format = TextureFormat::rg32f, .width = side, .height = side, .linear = true});
    texture.upload(0, side, side, specularAlbedoTable().table.data());
    return texture;
}

// Returns whether shaders may contain the lighting as constants: true if the lighting is the same in every frame and
// there are few lights. Constants for many lights would make shaders too long.
bool staysLitAlike(const World& world) {
    return world.lights.size() <= maxConstantLights && (world.scene->clips.empty() || world.pose.lights.empty());
}

// Returns whether all values are finite. Values from a file may be NaN or infinite. Shaders cannot contain such
// lighting as constants, because GLSL has no literals for it.
bool isFinite(const GpuLighting& block) {
    const auto finite = [](const glm::vec4& v) { return std::isfinite(v.x + v.y + v.z + v.w); };
    const auto finiteLight = [&](const GpuLight& light) {
        return finite(light.directionType) && finite(light.colorScale) && finite(light.cone);
    };
    return std::ranges::all_of(block.environment, finite) && std::ranges::all_of(block.irradiance, finite) &&
           std::ranges::all_of(block.lights, finiteLight);
}

// Returns the GLSL initializer of the lighting constant in shaders/include/lighting.glsl.
std::string lightingText(const GpuLighting& block, std::size_t lightCount) {
    const auto vectors = [](std::span<const glm::vec4> list) {
        std::string text;
        for (const glm::vec4& v : list)
            text += fmt::format("{}vec4({:.8e},{:.8e},{:.8e},{:.8e})", text.empty() ? "" : ",", v.x, v.y, v.z, v.w);
        return text;
    };
    std::string lights;
    for (std::size_t i = 0; i < std::max<std::size_t>(lightCount, 1); ++i) {
        const GpuLight& light = block.lights[i];
        const std::array members = {light.directionType, light.colorScale, light.cone};
        lights += fmt::format("{}LightData({})", i > 0 ? "," : "", vectors(members));
    }
    return fmt::format("vec4[]({}),vec4[]({}),LightData[]({})", vectors(block.environment), vectors(block.irradiance),
                       lights);
}

// Byte offset between the uniforms of successive batches (waves) of samples: the max GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT
// of all drivers.
constexpr std::size_t waveStride = 256;

bool barrelCuts(const FramePlan& plan) {
    return plan.usesLens && plan.view.lens.catEye > 0;
}

}  // namespace

void FrameUniforms::upload(const World& world, const FramePlan& plan, std::uint32_t layerCount) {
    if (world.lights.size() > maxLights)
        fail("the scene has {} lights; the maximum is {}", world.lights.size(), maxLights);
    const EnvironmentType type = world.environment.type;
    const int levels = type == EnvironmentType::map
                           ? mipmapLevels(world.environment.map->width, world.environment.map->height) - 1
                           : 0;
    defines_ = {{"blockSamples", std::to_string(blockSamples)},
                {"positionsPerAxis", std::to_string(positionsPerAxis(plan.settings))},
                {"environmentType", std::to_string(environmentNumber(type))},
                {"backgroundType", std::to_string(plan.needsAlpha ? 0 : environmentNumber(type))},
                {"environmentLevels", fmt::format("{:.1f}", static_cast<double>(levels))},
                {"environmentLighting", fmt::format("{:.6f}", world.environment.lighting)},
                {"lightCount", std::to_string(world.lights.size())}};
    const bool knownMap = type == EnvironmentType::map && environmentMap_;
    if (type == EnvironmentType::map && !knownMap) environmentMap_ = environmentTexture(*world.environment.map);
    if (!knownMap) irradiance_ = diffuseCoefficients(world.environment);
    if (type == EnvironmentType::map) defines_.emplace_back("ENVIRONMENT_MAP", "");
    usesOwnBlur_ = plan.usesOwnBlur;
    countsInAlpha_ = barrelCuts(plan);
    const auto set = [&](bool condition, const char* name) {
        if (condition) defines_.emplace_back(name, "true");
    };
    set(plan.usesOwnBlur, "usesOwnBlur");
    set(plan.settings.multipleScattering, "multipleScattering");
    set(plan.coc.chromatic > 0, "chromatic");
    set(plan.usesCocControls, "cocControls");
    set(plan.usesCocControls && plan.coc.aberrates(), "aberrations");
    if (countsInAlpha_) defines_.emplace_back("catEye", fmt::format("{:.6f}", plan.view.lens.catEye));
    if (countsInAlpha_ || plan.coc.chromatic > 0) defines_.emplace_back("WEIGHS_SAMPLES", "");
    layerCount_ = layerCount;
    if (!specularAlbedos_) specularAlbedos_ = specularAlbedoTexture();
    uploadLighting(world);
    uploadSamples(plan, layerCount);

    const View& view = plan.view;
    const double tanX = plan.tanHalfHorizontal;
    const double tanY = tanX * view.height / view.width;
    GpuFrame block{};
    block.projection = {1 / tanX, 1 / tanY, view.nearPlane, 0};
    const ClipCircleOfConfusion& coc = plan.coc;
    block.coc = {coc.a, coc.front, view.width, coc.behind};
    block.cocField = {coc.tilt, coc.curvature, coc.gain};
    block.cocLimits = {std::min(coc.foregroundLimit, unlimitedBlur), std::min(coc.backgroundLimit, unlimitedBlur),
                       1 / (coc.aspect * coc.aspect), plan.settings.cocTolerance};
    block.cocOther = {coc.aBehind, coc.shareOfMillimetre, coc.astigmatism, coc.coma};
    const LayerWindow window = layerWindow(plan);
    block.window = {window.imageLeft, window.imageBottom, window.imageWidth, window.imageHeight};
    block.worldFromView = glm::mat4(glm::mat3(view.worldFromCamera));
    const glm::dvec3 camera(view.worldFromCamera[3]);
    for (std::size_t i = 0; i < world.lights.size(); ++i)
        block.lightPositions[i] = glm::vec4(glm::vec3(world.lights[i].position - camera), world.lights[i].light.range);
    frameBlock_ = Buffer(sizeof block, &block);
}

void FrameUniforms::uploadLighting(const World& world) {
    GpuLighting block{};
    block.environment = {glm::vec4(world.environment.zenith, 1), glm::vec4(world.environment.horizon, 1),
                         glm::vec4(world.environment.nadir, 1)};
    block.irradiance = irradiance_;
    for (std::size_t i = 0; i < world.lights.size(); ++i) block.lights[i] = gpuLight(world.lights[i]);
    const bool constant = staysLitAlike(world) && isFinite(block);
    defines_.emplace_back("maxLights",
                          std::to_string(constant ? std::max<std::size_t>(world.lights.size(), 1) : maxLights));
    if (constant) defines_.emplace_back("LIGHTING_VALUES", lightingText(block, world.lights.size()));
    lightingBlock_ = constant ? Buffer() : Buffer(sizeof block, &block);
}

void FrameUniforms::uploadSamples(const FramePlan& plan, std::uint32_t layerCount) {
    const float k = static_cast<float>(plan.view.width) / static_cast<float>(plan.view.height);
    const auto radius = static_cast<float>(0.5 * plan.apertureDiameter);
    const glm::vec2 pixel(2.0f / static_cast<float>(plan.view.width), 2.0f / static_cast<float>(plan.view.height));
    std::vector<GpuSample> samples(plan.samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const LensSample& sample = plan.samples[i];
        // A sample position to the right of the pixel's centre shifts the image left.
        const glm::vec2 jitter = -sample.pixel * pixel;
        const auto number = static_cast<float>(plan.settings.firstSample + i);
        const auto layer = static_cast<float>(i % blockSamples % layerCount);
        samples[i] = {{sample.lens.x, k * sample.lens.y, jitter.x, jitter.y},
                      {radius * sample.lens.x, radius * sample.lens.y, number, layer}};
    }
    samples_ = Buffer::of(std::span<const GpuSample>(samples));
    std::vector<glm::vec3> moments;
    for (const SampleMoment& moment : plan.moments) moments.emplace_back(moment.moment, moment.fraction, moment.time);
    moments_ = moments.empty() ? Buffer() : Buffer::of(std::span<const glm::vec3>(moments));

    // Compute by how much each lens sample shifts the sky, in units of the image plane at distance 1. A point at depth
    // w is shifted by the lens point times C/w, where C is the clip-space circle of confusion. Without blur controls, C
    // = a + b·w. Then C/w = b at infinity, and lens point and jitter shift the sky by a fixed offset. With blur
    // controls, C/w depends on the pixel, and the shader multiplies it by the lens point. The buffer is padded to
    // complete blocks of samples, which are bound one at a time.
    const glm::vec2 imagePlane(plan.tanHalfHorizontal, plan.tanHalfHorizontal * plan.view.height / plan.view.width);
    const double dioptres = plan.coc.chromatic > 0 ? plan.view.lens.axialChromaticAberration : 0;
    std::vector<float> bandShifts(samples.size());
    std::vector<glm::vec4> shifts((samples.size() + blockSamples - 1) / blockSamples * blockSamples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::vec4& s = samples[i].lensAndJitter;
        const glm::vec2 byLens = -glm::vec2(s.x, s.y) * imagePlane;
        const glm::vec2 byJitter = -glm::vec2(s.z, s.w) * imagePlane;
        bandShifts[i] = static_cast<float>(chromaticShift(plan.coc.a, dioptres, plan.samples[i].band));
        const float b = static_cast<float>(plan.coc.behind) + bandShifts[i];
        shifts[i] = plan.usesCocControls ? glm::vec4(byLens, byJitter) : glm::vec4(b * byLens + byJitter, 0, 0);
    }
    sampleShifts_ = Buffer::of(std::span<const glm::vec4>(shifts));
    uploadBands(plan, bandShifts);

    std::vector<glm::vec4> waves(shifts.size() / blockSamples * wavesPerBlock() * waveStride / sizeof(glm::vec4));
    for (std::uint32_t i = 0; i < samples.size(); ++i)
        if (i % blockSamples % layerCount == 0) {
            const std::uint32_t number = plan.settings.firstSample + i;
            const std::uint32_t block = number / blockSamples * blockSamples;
            const double drawn = std::min(block + blockSamples, plan.frameSamples);
            const double footprint = std::sqrt(1 / (2 * drawn - 1));
            waves[waveOf(i) * waveStride / sizeof(glm::vec4)] = glm::vec4(footprint, std::log2(footprint), 0, 0);
        }
    waves_ = Buffer::of(std::span<const glm::vec4>(waves));
}

// Uploads SampleBlock (shaders/accumulation/layer_light.glsl) for each block of samples. It holds, for each sample, the
// colour weights of the sample's wavelength and the resulting change of b, where a + b·w is the clip-space circle of
// confusion at depth w. The lens points of the block's samples follow.
void FrameUniforms::uploadBands(const FramePlan& plan, const std::vector<float>& bandShifts) {
    bandShifts_ = Buffer();
    sampleBands_ = Buffer();
    if (!(plan.coc.chromatic > 0) && !barrelCuts(plan)) return;
    if (plan.coc.chromatic > 0) bandShifts_ = Buffer::of(std::span<const float>(bandShifts));
    std::vector<glm::vec3> weights(bandShifts.size(), glm::vec3(1));
    if (plan.coc.chromatic > 0) weights = bandWeights(plan.samples);
    std::vector<glm::vec4> bands((bandShifts.size() + blockSamples - 1) / blockSamples * blockSamples * 2);
    for (std::size_t i = 0; i < bandShifts.size(); ++i) {
        const std::size_t at = i / blockSamples * blockSamples * 2 + i % blockSamples;
        bands[at] = glm::vec4(weights[i], bandShifts[i]);
        bands[at + blockSamples] = glm::vec4(plan.samples[i].lens, 0, 0);
    }
    sampleBands_ = Buffer::of(std::span<const glm::vec4>(bands));
}

void FrameUniforms::bind(std::uint32_t firstSample) const {
    constexpr std::size_t blockBytes = blockSamples * sizeof(glm::vec4);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.name());
    if (lightingBlock_) glBindBufferBase(GL_UNIFORM_BUFFER, 5, lightingBlock_.name());
    glBindBufferRange(GL_UNIFORM_BUFFER, 3, sampleShifts_.name(),
                      static_cast<GLintptr>(firstSample / blockSamples * blockBytes), blockBytes);
    if (sampleBands_)
        glBindBufferRange(GL_UNIFORM_BUFFER, 4, sampleBands_.name(),
                          static_cast<GLintptr>(firstSample / blockSamples * blockBytes * 2), blockBytes * 2);
    bindWave(firstSample);
    if (environmentMap_) environmentMap_.attach(5);
    specularAlbedos_.attach(33);
}

void FrameUniforms::bindWave(std::uint32_t sample) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, 6, waves_.name(), static_cast<GLintptr>(waveOf(sample) * waveStride),
                      sizeof(glm::vec4));
}

std::size_t FrameUniforms::wavesPerBlock() const {
    return (blockSamples + layerCount_ - 1) / layerCount_;
}

std::size_t FrameUniforms::waveOf(std::uint32_t sample) const {
    return sample / blockSamples * wavesPerBlock() + sample % blockSamples / layerCount_;
}

std::size_t FrameUniforms::bytes() const {
    return frameBlock_.bytes() + lightingBlock_.bytes() + samples_.bytes() + moments_.bytes() + sampleShifts_.bytes() +
           waves_.bytes() + bandShifts_.bytes() + sampleBands_.bytes() + environmentMap_.bytes() +
           specularAlbedos_.bytes();
}

}  // namespace defocus::engine
