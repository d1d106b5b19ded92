#pragma once
// Caches the vertex arrays of a pass that draws meshes. Meshes with the same vertex format share a vertex array.

#include <functional>
#include <map>
#include <utility>

#include "gl/buffer.h"
#include "render/gpu_scene/gpu_mesh.h"

namespace defocus::engine {

class VertexArrays {
public:
    // `shared` adds the attributes and buffers that all draws of the pass have in common, such as lens samples.
    explicit VertexArrays(std::function<void(VertexArray&)> shared = {}) : shared_(std::move(shared)) {}

    // Attaches the vertices of a mesh's level to the vertex array of their format. Returns this vertex array.
    VertexArray& attach(const GpuMesh& mesh, std::size_t level);

private:
    using Format = std::pair<AttributeSet, GLenum>;  // attributes of the mesh, type of the colours

    std::function<void(VertexArray&)> shared_;
    std::map<Format, VertexArray> arrays_;
};

}  // namespace defocus::engine
