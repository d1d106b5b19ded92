#include "render/gpu_scene/vertex_arrays.h"

namespace defocus::engine {

VertexArray& VertexArrays::attach(const GpuMesh& mesh, std::size_t level) {
    const GpuLevel& source = mesh.levels[level];
    const auto [entry, isNew] = arrays_.try_emplace({mesh.attributes, source.colorType});
    VertexArray& array = entry->second;
    for (const AttributeLayout& layout : meshAttributes) {
        if (!mesh.has(layout.location)) continue;
        if (isNew) {
            const GLenum type = layout.location == colorLocation ? source.colorType : layout.type;
            array.attribute(layout.location, layout.components, type,
                            layout.location == colorLocation && type == GL_UNSIGNED_SHORT);
        }
        const std::size_t first = layout.perLevel ? source.firstVertex : mesh.firstVertex;
        array.bind(layout.location, mesh.buffers->vertices[layout.location], first * layout.stride, layout.stride);
    }
    if (isNew && shared_) shared_(array);
    return array;
}

}  // namespace defocus::engine
