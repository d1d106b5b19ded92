#pragma once
// The name table of rendering methods. Optional builds (the Embree ray tracer) add theirs with registerMethod before
// use.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/renderer.h"

namespace defocus {

// How one lens sample's radiance is kept until it is summed.
enum class LayerFormat {
    automatic,  // rgba16f, or rgba32f where the scene's radiance may exceed 6e4
    rgba16f,    // half floats: 2⁻¹¹ relative error a sample
    rgba32f,    // references
    rgb9e5,     // 32 bits with a shared exponent, dithered over the samples: half the memory; opaque scenes only
    rgba8,      // clips at 1: a bound for the table of formats, not for pictures
};

struct RendererOptions {
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;                  // K, lens samples drawn at once; 0: as many as waveBytes allow
    std::uint64_t waveBytes = 256ull << 20;  // memory for a wave's layers
    bool geometryShaderLayers = false;       // pick layers in a geometry shader even where the vertex shader may
    std::filesystem::path shaderFolder;      // overrides the embedded shaders; empty: none
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
