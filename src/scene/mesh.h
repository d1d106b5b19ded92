#pragma once
// A mesh as all its primitives over ONE set of vertices, so that one pyramid can simplify it as a whole.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "core/bounds.h"

namespace defocus::engine {

// What a vertex makes of the blur c that the lens gives its place: factor·c, and signed millimetres on the sensor
// besides (> 0 as behind the focus), which change linearly from the opening of the shutter to its closing. That is the
// linear C(t) of Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization.
struct VertexBlur {
    float factor = 1;   // ≥ 0; 0: what is added replaces the lens's blur
    float opening = 0;  // mm
    float closing = 0;  // mm
    bool operator==(const VertexBlur&) const = default;
};

// Of all vertices of a mesh.
struct VertexBlurBounds {
    float factorMin = 1;
    float factorMax = 1;
    float addedMin = 0;  // mm, at any time
    float addedMax = 0;
    bool moves = false;  // some vertex's changes while the shutter is open
    bool operator==(const VertexBlurBounds&) const = default;
};

// Vertex attributes, one array each; an array is empty (the mesh doesn't have it) or as long as `positions`.
struct Vertices {
    std::vector<glm::vec3> positions;  // object units
    std::vector<glm::vec3> normals;    // unit length
    std::vector<glm::vec4> tangents;   // xyz unit length, w = ±1 handedness (glTF)
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors;     // linear, straight alpha; those of a file lie in [0, 1]
    std::vector<glm::u16vec4> joints;  // indices into the skin's joints, influences one to four
    std::vector<glm::vec4> weights;    // of all influences; they sum to 1
    std::vector<VertexBlur> blurs;
    std::vector<glm::u16vec4> joints1;  // influences five to eight; empty where four are enough
    std::vector<glm::vec4> weights1;

    [[nodiscard]] std::size_t count() const { return positions.size(); }
};

struct MorphTarget {  // displacements, each empty or one a vertex
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

struct Primitive {
    int material = -1;                   // into Scene::materials; -1: glTF's default material
    std::vector<std::uint32_t> indices;  // triangles, into Mesh::vertices, front faces counter-clockwise
};

struct Mesh {
    std::string name;
    Vertices vertices;
    std::vector<Primitive> primitives;
    std::vector<MorphTarget> morphTargets;
    std::vector<float> morphWeights;  // defaults, one a target
    VertexBlurBounds blurBounds;      // of vertices.blurs

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] Bounds bounds() const;  // of the vertices that triangles use; empty without triangles
};

VertexBlurBounds boundsOf(const std::vector<VertexBlur>& blurs);

// The box of the finite ones among positions.
Bounds boundsOf(const std::vector<glm::vec3>& positions);

// Area-weighted smooth normals (positions welded exactly) for triangles `indices` over `positions`; a vertex without
// any proper triangle gets +y.
std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& indices);

}  // namespace defocus::engine
