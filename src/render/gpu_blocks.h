#pragma once
// The uniform blocks of shaders/include/frame.glsl and lighting.glsl, std140, for C++.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace defocus {

inline constexpr int mostLights = 64;  // 64 lights of 48 bytes: a fifth of the 16 KiB every driver gives a block

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
    glm::mat4 worldFromView;
    std::array<glm::vec4, mostLights> lightPositions;
};

struct GpuLighting {
    std::array<glm::vec4, 3> environment;
    std::array<glm::vec4, 9> irradiance;
    std::array<GpuLight, mostLights> lights;
};

struct GpuObject {
    glm::mat4 viewFromObject;
    glm::mat4 normalMatrix;
    glm::vec4 values;
    glm::ivec4 posing;
};

struct GpuMaterial {
    glm::vec4 baseColor;
    glm::vec4 emissiveCutoff;
    glm::vec4 surface;
    std::array<glm::vec4, 10> uvRows;
};

// A lens sample as an instance reads it.
struct GpuSample {
    glm::vec4 lensAndJitter;  // u, k·v, jitter x, y in normalised device units
    glm::vec4 eyeAndDither;   // lens point x, y in m, dither offset, layer
};

// Vertex attribute locations of shaders/accumulation/object.vert.
enum AttributeLocation : unsigned {
    positionLocation,
    normalLocation,
    colorLocation,
    uv0Location,
    uv1Location,
    tangentLocation,
    lensLocation,
    eyeLocation,
    cocScaleLocation,
    jointsLocation,
    weightsLocation,
    joints1Location,
    weights1Location,
    momentLocation,
    bandShiftLocation,
};

}  // namespace defocus
