#include "render/gpu_scene/gpu_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <map>
#include <utility>

#include "gl/buffer_writer.h"

namespace defocus::engine {

namespace {

// Max size in bytes of a mesh that shares buffers with other meshes.
constexpr std::size_t largestSharing = std::size_t{1} << 16;
constexpr std::size_t sharedBytes = std::size_t{1} << 20;  // size in bytes at which shared buffers are full

// A mesh is far from its origin on an axis if the coordinate of its bounding box's centre is at least this multiple of
// half the box's largest side.
constexpr double farFromOrigin = 4;

constexpr float rangeRounding = 1e-3f;  // tolerance when colour ranges are rounded outwards, in units of 1/255

// Colours of level 0 are in [0, 1]; 16-bit fixed point is exact for files with 8 or 16 bits. Colours of coarser levels
// are fitted and may lie outside [0, 1].
GLenum colorTypeOf(std::size_t level) {
    return level == 0 ? GL_UNSIGNED_SHORT : GL_HALF_FLOAT;
}

std::vector<glm::u16vec4> packed(const std::vector<glm::vec4>& colors, GLenum type) {
    std::vector<glm::u16vec4> result;
    result.reserve(colors.size());
    for (const glm::vec4& color : colors)
        result.push_back(type == GL_HALF_FLOAT ? glm::packHalf(color) : glm::packUnorm<glm::uint16>(color));
    return result;
}

void measureColors(const std::vector<glm::vec4>& colors, GpuLevel& level) {
    if (colors.empty()) return;
    level.minColor = level.maxColor = colors.front();
    for (const glm::vec4& color : colors) {
        level.minColor = glm::min(level.minColor, color);
        level.maxColor = glm::max(level.maxColor, color);
    }
}

// Returns the indices of a level's triangles, which are contiguous in Pyramid::indices.
std::span<const std::uint32_t> indicesOf(const Pyramid& pyramid, std::size_t level) {
    const std::vector<IndexRange>& ranges = pyramid.levels[level].primitives;
    if (ranges.empty()) return {};
    const std::uint32_t end = ranges.back().first + ranges.back().count;
    return std::span(pyramid.indices).subspan(ranges.front().first, end - ranges.front().first);
}

std::vector<glm::vec3> relative(const std::vector<glm::vec3>& positions, const glm::dvec3& origin) {
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const glm::vec3& position : positions) result.emplace_back(glm::dvec3(position) - origin);
    return result;
}

// Numbers of vertices and indices of meshes.
struct Extent {
    std::size_t ofLevels = 0;  // number of vertices in per-level buffers
    std::size_t ofMeshes = 0;  // number of vertices in the buffers shared by all levels
    std::size_t indices = 0;
};

std::size_t verticesOf(const AttributeLayout& layout, const Extent& extent) {
    return layout.perLevel ? extent.ofLevels : extent.ofMeshes;
}

std::size_t bytesOf(AttributeSet attributes, const Extent& extent) {
    std::size_t bytes = extent.indices * sizeof(std::uint32_t);
    for (const AttributeLayout& layout : meshAttributes)
        if ((attributes & only(layout.location)) != 0) bytes += verticesOf(layout, extent) * layout.stride;
    return bytes;
}

// Returns the attributes that a mesh needs for the flagged levels.
AttributeSet attributesOf(const Pyramid& pyramid, const std::vector<bool>& levels) {
    AttributeSet set = only(positionLocation) | only(normalLocation);
    const auto add = [&](const auto& values, AttributeLocation location) {
        if (!values.empty()) set |= only(location);
    };
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (!levels[level]) continue;
        const PyramidLevel& source = pyramid.levels[level];
        add(source.colors, colorLocation);
        add(source.uv0, uv0Location);
        add(source.uv1, uv1Location);
        if (level == 0) add(source.colors, colorRangeLocation);
    }
    const Vertices& vertices = pyramid.vertices;
    add(vertices.tangents, tangentLocation);
    add(vertices.blurs, blurLocation);
    add(vertices.joints, jointsLocation);
    add(vertices.weights, weightsLocation);
    add(vertices.joints1, joints1Location);
    add(vertices.weights1, weights1Location);
    return set;
}

// Returns a mesh whose data are placed in shared buffers after the vertices and indices counted in `extent`. Adds the
// counts of the mesh to `extent`.
GpuMesh placed(const Pyramid& pyramid, const std::vector<bool>& levels, Extent& extent) {
    GpuMesh mesh;
    mesh.origin = meshOrigin(pyramid.bounds);
    mesh.attributes = attributesOf(pyramid, levels);
    mesh.firstVertex = extent.ofMeshes;
    mesh.levels.resize(pyramid.levels.size());
    // Each level uses a prefix of the pyramid's vertices, so the finest level determines the vertex count.
    std::size_t count = 0;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (!levels[level]) continue;
        const PyramidLevel& source = pyramid.levels[level];
        GpuLevel& target = mesh.levels[level];
        target.uploaded = true;
        target.firstVertex = extent.ofLevels;
        target.firstIndex = extent.indices;
        if (!source.colors.empty()) target.colorType = colorTypeOf(level);
        if (level > 0) measureColors(source.colors, target);
        count = std::max<std::size_t>(count, source.vertexCount);
        extent.ofLevels += source.vertexCount;
        extent.indices += indicesOf(pyramid, level).size();
    }
    extent.ofMeshes += count;
    return mesh;
}

template <typename T>
void append(BufferWriter& writer, const std::vector<T>& items) {
    writer.append(std::span(items));
}

// Appends a level's values of a per-level attribute.
void appendLevel(BufferWriter& writer, AttributeLocation location, const Pyramid& pyramid, std::size_t level,
                 const GpuMesh& mesh) {
    const PyramidLevel& source = pyramid.levels[level];
    switch (location) {
        case positionLocation:
            return append(writer, relative(source.positions, mesh.origin));
        case normalLocation:
            return append(writer, source.normals);
        case colorLocation:
            return append(writer, packed(source.colors, mesh.levels[level].colorType));
        case uv0Location:
            return append(writer, source.uv0);
        default:
            return append(writer, source.uv1);
    }
}

// Appends the values of an attribute that all levels share, for the first `count` vertices.
void appendShared(BufferWriter& writer, AttributeLocation location, const Pyramid& pyramid, std::size_t count) {
    const Vertices& vertices = pyramid.vertices;
    const auto prefix = [&](const auto& items) { writer.append(std::span(items).first(count)); };
    switch (location) {
        case tangentLocation:
            return prefix(vertices.tangents);
        case blurLocation:
            return prefix(vertices.blurs);
        case jointsLocation:
            return prefix(vertices.joints);
        case weightsLocation:
            return prefix(vertices.weights);
        case joints1Location:
            return prefix(vertices.joints1);
        case weights1Location:
            return prefix(vertices.weights1);
        default:
            return append(writer, cornerColorRanges(pyramid.levels.front().colors, indicesOf(pyramid, 0)));
    }
}

// Returns the number of vertices of the finest uploaded level.
std::size_t vertexCountOf(const GpuMesh& mesh, const Pyramid& pyramid) {
    std::size_t count = 0;
    for (std::size_t level = 0; level < mesh.levels.size(); ++level)
        if (mesh.levels[level].uploaded) count = std::max<std::size_t>(count, pyramid.levels[level].vertexCount);
    return count;
}

GpuMorphs morphsOf(const Mesh& mesh, const Pyramid& pyramid, std::size_t vertexCount) {
    GpuMorphs morphs;
    if (mesh.morphTargets.empty()) return morphs;
    morphs.vertexCount = vertexCount;
    for (const MorphTarget& target : mesh.morphTargets) {
        morphs.normals |= !target.normals.empty();
        morphs.tangents |= !target.tangents.empty() && !mesh.vertices.tangents.empty();
    }
    std::vector<glm::vec3> texels;
    texels.reserve(static_cast<std::size_t>(morphs.attributesPerTarget()) * vertexCount * mesh.morphTargets.size());
    const auto add = [&](const std::vector<glm::vec3>& displacements) {
        for (std::size_t v = 0; v < vertexCount; ++v)
            texels.push_back(displacements.empty() ? glm::vec3(0) : displacements[pyramid.source[v]]);
    };
    for (const MorphTarget& target : mesh.morphTargets) {
        add(target.positions);
        if (morphs.normals) add(target.normals);
        if (morphs.tangents) add(target.tangents);
    }
    morphs.texels =
        TexelBuffer({texels.empty() ? nullptr : &texels.front().x, texels.size() * 3}, GL_RGB32F, 3, "morph targets");
    return morphs;
}

// Meshes that have the same vertex attributes and will therefore share buffers.
class Batch {
public:
    void add(const World& world, const MeshUpload& upload) {
        members_.emplace_back(upload.mesh, placed(world.pyramids[upload.mesh], upload.levels, extent_));
    }
    [[nodiscard]] std::size_t bytes() const {
        return members_.empty() ? 0 : bytesOf(members_.front().second.attributes, extent_);
    }

    // Uploads the batch's meshes to buffers that they share, and moves the meshes to `meshes`.
    void upload(const World& world, std::vector<GpuMesh>& meshes) {
        if (members_.empty()) return;
        const auto buffers = std::make_shared<MeshBuffers>();
        for (const AttributeLayout& layout : meshAttributes)
            if (members_.front().second.has(layout.location))
                buffers->vertices[layout.location] = attribute(world, layout);
        buffers->indices = indices(world);
        for (auto& [index, mesh] : members_) {
            mesh.buffers = buffers;
            const Pyramid& pyramid = world.pyramids[index];
            mesh.morphs = morphsOf(world.scene->meshes[index], pyramid, vertexCountOf(mesh, pyramid));
            meshes[index] = std::move(mesh);
        }
        *this = {};
    }

private:
    [[nodiscard]] Buffer attribute(const World& world, const AttributeLayout& layout) const {
        BufferWriter writer(verticesOf(layout, extent_) * layout.stride);
        for (const auto& [index, mesh] : members_) {
            const Pyramid& pyramid = world.pyramids[index];
            if (!layout.perLevel) appendShared(writer, layout.location, pyramid, vertexCountOf(mesh, pyramid));
            for (std::size_t level = 0; level < mesh.levels.size(); ++level)
                if (layout.perLevel && mesh.levels[level].uploaded)
                    appendLevel(writer, layout.location, pyramid, level, mesh);
        }
        return writer.finish();
    }

    [[nodiscard]] Buffer indices(const World& world) const {
        BufferWriter writer(extent_.indices * sizeof(std::uint32_t));
        for (const auto& [index, mesh] : members_)
            for (std::size_t level = 0; level < mesh.levels.size(); ++level)
                if (mesh.levels[level].uploaded) writer.append(indicesOf(world.pyramids[index], level));
        return writer.finish();
    }

    std::vector<std::pair<std::size_t, GpuMesh>> members_;  // pairs of mesh index and mesh
    Extent extent_;
};

}  // namespace

std::size_t MeshBuffers::bytes() const {
    std::size_t total = indices.bytes();
    for (const Buffer& buffer : vertices) total += buffer.bytes();
    return total;
}

void uploadMeshes(const World& world, std::span<const MeshUpload> uploads, std::vector<GpuMesh>& meshes) {
    std::map<AttributeSet, Batch> shared;
    for (const MeshUpload& upload : uploads) {
        const Pyramid& pyramid = world.pyramids[upload.mesh];
        Extent own;
        const bool small = bytesOf(placed(pyramid, upload.levels, own).attributes, own) <= largestSharing;
        Batch alone;
        Batch& batch = small ? shared[attributesOf(pyramid, upload.levels)] : alone;
        batch.add(world, upload);
        if (!small || batch.bytes() >= sharedBytes) batch.upload(world, meshes);
    }
    for (auto& [attributes, batch] : shared) batch.upload(world, meshes);
}

glm::dvec3 meshOrigin(const Bounds& bounds) {
    if (bounds.empty()) return glm::dvec3(0);
    const glm::dvec3 middle = bounds.centre();
    const glm::dvec3 size = bounds.size();
    const double reach = 0.5 * std::max({size.x, size.y, size.z});
    glm::dvec3 origin(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (std::abs(middle[axis]) >= farFromOrigin * reach) origin[axis] = static_cast<float>(middle[axis]);
    return origin;
}

std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices) {
    if (colors.empty()) return {};
    std::vector<glm::vec4> min = colors;
    std::vector<glm::vec4> max = colors;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec4 &a = colors[indices[i]], &b = colors[indices[i + 1]], &c = colors[indices[i + 2]];
        const glm::vec4 low = glm::min(glm::min(a, b), c);
        const glm::vec4 high = glm::max(glm::max(a, b), c);
        for (std::size_t k = i; k < i + 3; ++k) {
            min[indices[k]] = glm::min(min[indices[k]], low);
            max[indices[k]] = glm::max(max[indices[k]], high);
        }
    }
    std::vector<glm::u16vec4> ranges;
    ranges.reserve(colors.size());
    for (std::size_t v = 0; v < colors.size(); ++v)
        ranges.push_back(glm::u16vec4(glm::ceil(255.0f * max[v] - rangeRounding)) * std::uint16_t{256} +
                         glm::u16vec4(glm::floor(255.0f * min[v] + rangeRounding)));
    return ranges;
}

}  // namespace defocus::engine
