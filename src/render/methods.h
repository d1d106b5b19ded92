#pragma once
// The name table of rendering methods. Optional builds (the Embree ray tracer) add theirs with registerMethod before use.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/renderer.h"

namespace defocus {

enum class LayerFormat {
    automatic,  // rgb9e5 for opaque scenes over a background, else rgba16f
    rgb9e5,     // 32 bit shared exponent, dithered over the samples
    rgba16f,
    rgba32f,    // references, radiance above 6e4
    r11g11b10f,
    rgba8,      // for the table of formats only: clips at 1
};

struct RendererOptions {
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;                         // K, lens samples drawn at once; 0: as many as waveBytes allow
    std::uint64_t waveBytes = 256ull << 20;         // memory for a wave's layers
};

struct Method {
    std::string name;
    std::string description;
    bool needsGl = true;  // a current GL context
    std::function<std::unique_ptr<Renderer>(const World&, const RendererOptions&)> make;
};

const std::vector<Method>& methods();
void registerMethod(Method method);
// Throws Error listing the known names for an unknown one.
const Method& methodNamed(std::string_view name);

}  // namespace defocus
