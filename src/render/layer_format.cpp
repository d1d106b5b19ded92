#include "render/layer_format.h"

#include <algorithm>

#include "core/error.h"

namespace defocus::engine {

namespace {

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

// Radiance that a half float cannot hold: layers must be 32-bit floats then. What lights reflect is bounded for matt
// surfaces under distant lights; beyond that, values end at 65,504.
bool beyondHalfFloat(const World& world) {
    constexpr float limit = 6e4f;
    const Environment& e = world.environment;
    float distantLight = 0;
    for (const PlacedLight& placed : world.lights)
        if (placed.light.type == LightType::directional)
            distantLight += placed.light.intensity * largest(placed.light.color);
    const auto radiates = [&](const Material& m) {
        const float base = largest(glm::vec3(m.baseColorFactor));
        return std::max(largest(m.emissiveFactor), m.unlit ? base : base * distantLight) > limit;
    };
    return std::any_of(world.scene->materials.begin(), world.scene->materials.end(), radiates) ||
           std::max({largest(e.zenith), largest(e.horizon), largest(e.nadir)}) > limit;
}

}  // namespace

LayerFormat chosenLayerFormat(const World& world, const FramePlan& plan, LayerFormat asked) {
    if (asked == LayerFormat::automatic) return beyondHalfFloat(world) ? LayerFormat::rgba32f : LayerFormat::rgba16f;
    if (asked == LayerFormat::rgb9e5 && (plan.usesBlending || plan.usesTransmission || plan.needsAlpha))
        fail(
            "layer format {}: it holds no alpha, which blended and transmitting materials and a transparent background "
            "need; choose "
            "rgba16f",
            layerFormatName(asked));
    return asked;
}

ShaderDefines layerFormatDefines(LayerFormat format) {
    if (format == LayerFormat::rgb9e5) return {{"LAYER_RGB9E5", "1"}};
    if (format == LayerFormat::rgba16f) return {{"LAYER_LARGEST", "65504.0"}};
    return {};
}

const char* layerFormatName(LayerFormat format) {
    switch (format) {
        case LayerFormat::automatic:
            return "automatic";
        case LayerFormat::rgb9e5:
            return "rgb9e5";
        case LayerFormat::rgba16f:
            return "rgba16f";
        case LayerFormat::rgba32f:
            return "rgba32f";
        case LayerFormat::rgba8:
            return "rgba8";
    }
    return "";
}

TextureFormat layerTextureFormat(LayerFormat format) {
    switch (format) {
        case LayerFormat::rgb9e5:
            return TextureFormat::r32ui;
        case LayerFormat::rgba32f:
            return TextureFormat::rgba32f;
        case LayerFormat::rgba8:
            return TextureFormat::rgba8;
        default:
            return TextureFormat::rgba16f;
    }
}

std::size_t layerPixelBytes(LayerFormat format) {
    return pixelBytes(layerTextureFormat(format)) + pixelBytes(TextureFormat::depth32f);
}

}  // namespace defocus::engine
