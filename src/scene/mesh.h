#pragma once
// Defines a mesh whose primitives share one vertex array, so that all primitives are simplified together.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "core/bounds.h"

namespace defocus::engine {

// Per-vertex change of the lens's circle of confusion c to C(t) = factor·c + added(t). added(t) is a signed diameter in
// mm on the sensor (> 0 behind the focus plane). It changes linearly from `opening` to `closing` during the exposure.
// Source: linear C(t) of Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization.
struct VertexBlur {
    float factor = 1;   // multiplies the lens's blur, ≥ 0; 0: only the added blur
    float opening = 0;  // added blur in mm when the shutter opens
    float closing = 0;  // added blur in mm when the shutter closes
    bool operator==(const VertexBlur&) const = default;
};

// Min and max of the VertexBlur of a mesh's vertices.
struct VertexBlurBounds {
    float factorMin = 1;
    float factorMax = 1;
    float addedMin = 0;  // min of the added blur over vertices and exposure, mm on the sensor
    float addedMax = 0;
    bool moves = false;  // true if the added blur of a vertex changes during the exposure
    bool operator==(const VertexBlurBounds&) const = default;
};

// Vertex attributes, one array each. An array is empty if the mesh lacks the attribute; otherwise it is as long as
// `positions`.
struct Vertices {
    std::vector<glm::vec3> positions;  // positions in object units
    std::vector<glm::vec3> normals;    // unit length
    std::vector<glm::vec4> tangents;   // xyz: unit vector; w: handedness ±1 (glTF)
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors;     // linear, straight alpha; in [0, 1] if read from a file
    std::vector<glm::u16vec4> joints;  // first to fourth joint of each vertex: indices into the skin's joints
    std::vector<glm::vec4> weights;    // weights of `joints`; sum to 1 together with weights1
    std::vector<VertexBlur> blurs;
    std::vector<glm::u16vec4> joints1;  // fifth to eighth joint; empty if no vertex has more than four
    std::vector<glm::vec4> weights1;

    [[nodiscard]] std::size_t count() const { return positions.size(); }
};

struct MorphTarget {  // displacements at weight 1; each array is empty or has one entry per vertex
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

struct Primitive {
    int material = -1;                   // index into Scene::materials; -1: glTF's default material
    std::vector<std::uint32_t> indices;  // three per triangle, into Mesh::vertices; counter-clockwise from the front
};

// Points or line segments, which withStrokes (scene/strokes.h) turns into triangles.
struct Strokes {
    int material = -1;  // index into Scene::materials; -1: glTF's default material
    bool points = false;
    std::vector<std::uint32_t> indices;  // indices into `vertices`: one per point, two per line segment
    Vertices vertices;                   // without normals, the strokes are not lit
};

struct Mesh {
    std::string name;
    Vertices vertices;
    std::vector<Primitive> primitives;
    std::vector<MorphTarget> morphTargets;
    std::vector<float> morphWeights;  // default weights, one per morph target
    VertexBlurBounds blurBounds;      // min and max of vertices.blurs
    std::vector<Strokes> strokes;     // points and lines; see scene/strokes.h

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] Bounds bounds() const;  // bounding box of the vertices that triangles and strokes use; may be empty
};

VertexBlurBounds boundsOf(const std::vector<VertexBlur>& blurs);

// Returns the bounding box of the positions; NaN and infinite positions are ignored.
Bounds boundsOf(const std::vector<glm::vec3>& positions);

// Returns area-weighted smooth normals of a triangle list. Vertices at equal positions share a normal; vertices without
// a non-degenerate triangle get +y.
std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& indices);

}  // namespace defocus::engine
