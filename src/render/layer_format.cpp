#include "render/layer_format.h"

#include <algorithm>

#include "core/enum_name.h"

namespace defocus::engine {

namespace {

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

// Returns whether the radiance of the environment, emissive materials or diffuse surfaces under directional lights may
// exceed the range of half floats, so that layers must be 32-bit floats. Radiance from other sources, such as point
// lights, is clamped to 65,504.
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

LayerFormat chosenLayerFormat(const World& world, LayerFormat asked) {
    if (asked != LayerFormat::automatic) return asked;
    return beyondHalfFloat(world) ? LayerFormat::rgba32f : LayerFormat::rgba16f;
}

ShaderDefines layerFormatDefines(LayerFormat format) {
    if (format == LayerFormat::rgba16f) return {{"layerLargest", "65504.0"}};
    return {};
}

const char* layerFormatName(LayerFormat format) {
    return enumName<LayerFormat::rgba32f>(format, {"automatic", "rgba16f", "rgba32f"});
}

TextureFormat layerTextureFormat(LayerFormat format) {
    return format == LayerFormat::rgba32f ? TextureFormat::rgba32f : TextureFormat::rgba16f;
}

std::size_t layerPixelBytes(LayerFormat format) {
    return pixelBytes(layerTextureFormat(format)) + pixelBytes(TextureFormat::depth32f);
}

}  // namespace defocus::engine
