#pragma once
// Lists the vertex attributes of meshes, with their shader locations and their layout in buffers.

#include <epoxy/gl.h>

#include <cstddef>
#include <cstdint>

namespace defocus::engine {

// Vertex attribute locations of vertex.glsl, posing.glsl and surface_vertex.glsl in shaders/include/.
enum AttributeLocation : unsigned {
    positionLocation,
    normalLocation,
    colorLocation,
    uv0Location,
    uv1Location,
    tangentLocation,
    lensLocation,
    eyeLocation,
    blurLocation,
    jointsLocation,
    weightsLocation,
    joints1Location,
    weights1Location,
    momentLocation,
    bandShiftLocation,
    colorRangeLocation,  // location 15, the highest that all drivers support
    attributeLocationCount
};

// Set of attribute locations; bit i stands for location i.
using AttributeSet = std::uint32_t;

constexpr AttributeSet only(AttributeLocation location) {
    return AttributeSet{1} << location;
}

// Layout of an attribute in the buffers of meshes.
struct AttributeLayout {
    AttributeLocation location;
    GLint components;
    GLenum type;           // GL type of a component; colours: see GpuLevel::colorType
    std::size_t stride;    // bytes per vertex
    bool perLevel = true;  // false: all levels share the attribute's values
};

inline constexpr AttributeLayout meshAttributes[] = {
    {positionLocation, 3, GL_FLOAT, 12},
    {normalLocation, 3, GL_FLOAT, 12},
    {colorLocation, 4, GL_UNSIGNED_SHORT, 8},
    {uv0Location, 2, GL_FLOAT, 8},
    {uv1Location, 2, GL_FLOAT, 8},
    {tangentLocation, 4, GL_FLOAT, 16, false},
    {blurLocation, 3, GL_FLOAT, 12, false},
    {jointsLocation, 4, GL_UNSIGNED_SHORT, 8, false},
    {weightsLocation, 4, GL_FLOAT, 16, false},
    {joints1Location, 4, GL_UNSIGNED_SHORT, 8, false},
    {weights1Location, 4, GL_FLOAT, 16, false},
    {colorRangeLocation, 4, GL_UNSIGNED_SHORT, 8, false},
};

}  // namespace defocus::engine
