// Source: glTF 2.0 specification, 3.7.2 (meshes): strips and fans, flat normals, tangents.
#include "scene/gltf/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/finish_mesh.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/attributes.h"

namespace defocus::engine::gltf {

namespace {

// Accessor indices of a primitive's attributes and morph targets, by attribute name. Primitives with equal accessors
// share vertices.
struct VertexSource {
    std::map<std::string, int> attributes;
    std::vector<std::map<std::string, int>> targets;
    auto operator<=>(const VertexSource&) const = default;
};

// Primitives of one mesh that share vertices; a Draco-compressed primitive shares vertices with no other.
struct Group {
    VertexSource vertices;
    std::vector<std::size_t> members;  // indices into the mesh's primitives
    bool compressed = false;
};

// Cache of the most recently read vertices, because some files use the same accessors for many meshes.
struct LastBlock {
    VertexSource vertices;
    VertexBlock block;
};

std::vector<std::uint32_t> triangleList(int mode, const std::vector<std::uint32_t>& indices) {
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 3)};
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const std::uint32_t a = fan ? indices[i + 1] : indices[i];
        const std::uint32_t b = fan ? indices[i + 2] : indices[i + 1 + i % 2];
        const std::uint32_t c = fan ? indices[0] : indices[i + 2 - i % 2];
        // Drop degenerate triangles, which repeat a vertex to join two strips.
        if (a != b && b != c && c != a) result.insert(result.end(), {a, b, c});
    }
    return result;
}

bool isStroke(const tinygltf::Primitive& primitive) {
    return primitive.mode < TINYGLTF_MODE_TRIANGLES;
}

// Returns the indices of the points, or of both ends of each line segment.
std::vector<std::uint32_t> strokeList(int mode, const std::vector<std::uint32_t>& indices) {
    if (mode == TINYGLTF_MODE_POINTS) return indices;
    if (mode == TINYGLTF_MODE_LINE)
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 2)};
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i + 1 < indices.size(); ++i) result.insert(result.end(), {indices[i], indices[i + 1]});
    if (mode == TINYGLTF_MODE_LINE_LOOP && indices.size() > 2)
        result.insert(result.end(), {indices.back(), indices.front()});
    return result;
}

// Returns the vertex indices of a primitive, which are 0, 1, 2 … if the file has none. Throws Error for an index that
// is not below `vertexCount`.
std::vector<std::uint32_t> readIndices(Source& source, const tinygltf::Primitive& primitive, std::size_t vertexCount,
                                       const DracoPrimitive* draco, const std::string& what) {
    std::vector<std::uint32_t> indices;
    if (draco != nullptr) {
        indices = draco->triangles();
    } else if (primitive.indices >= 0) {
        indices = readIntegers(source, primitive.indices, 1, what + ": indices");
    } else {
        takeBudget(source, vertexCount, sizeof(std::uint32_t), what);
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    for (const std::uint32_t index : indices)
        if (index >= vertexCount)
            fault(source.document, "{}: index {} is out of range; there are {} vertices", what, index, vertexCount);
    return indices;
}

std::vector<std::uint32_t> readTriangles(Source& source, const tinygltf::Primitive& primitive, std::size_t vertexCount,
                                         const DracoPrimitive* draco, const std::string& what) {
    return triangleList(draco != nullptr ? TINYGLTF_MODE_TRIANGLES : primitive.mode,
                        readIndices(source, primitive, vertexCount, draco, what));
}

// Removes points and line segments with NaN or infinite positions.
void dropUnplacedStrokes(Source& source, Strokes& strokes) {
    const std::size_t ends = strokes.points ? 1 : 2;
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + ends <= strokes.indices.size(); i += ends) {
        const auto first = strokes.indices.begin() + static_cast<std::ptrdiff_t>(i);
        const auto last = first + static_cast<std::ptrdiff_t>(ends);
        const bool placed = std::all_of(first, last, [&](std::uint32_t vertex) {
            const glm::vec3& position = strokes.vertices.positions[vertex];
            return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
        });
        if (placed) kept.insert(kept.end(), first, last);
    }
    const std::size_t dropped = (strokes.indices.size() - kept.size()) / ends;
    if (dropped > 0)
        ignoreDamaged(source, strokes.points ? "points" : "lines", "a vertex position is NaN or infinite", dropped);
    strokes.indices = std::move(kept);
}

// Reads points or lines; drops their joints and morph targets.
Strokes readStrokes(Source& source, const tinygltf::Primitive& primitive, const std::string& what) {
    VertexBlock block = readAttributes(source, primitive, nullptr, what);
    std::vector<std::uint32_t> none;
    std::vector<std::uint32_t>* const lists[] = {&none};
    repairAttributes(block, lists);
    Strokes strokes;
    strokes.material = primitive.material;
    strokes.points = primitive.mode == TINYGLTF_MODE_POINTS;
    strokes.vertices = std::move(block.vertices);
    strokes.vertices.tangents = {};
    strokes.vertices.joints = strokes.vertices.joints1 = {};
    strokes.vertices.weights = strokes.vertices.weights1 = {};
    strokes.indices =
        strokeList(primitive.mode, readIndices(source, primitive, strokes.vertices.count(), nullptr, what));
    constexpr std::uint64_t quadBytes = 512;  // upper bound for four vertices and two triangles, bytes
    takeBudget(source, strokes.indices.size(), quadBytes, what);
    dropUnplacedStrokes(source, strokes);
    return strokes;
}

// Returns whether a primitive has positions; otherwise lists it in Source::ignored. Throws Error for unknown modes.
bool drawable(Source& source, const tinygltf::Primitive& primitive, const std::string& what) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        fault(source.document, "{}: unknown mode {}", what, primitive.mode);
    if (!primitive.attributes.contains("POSITION")) {
        ignore(source, "primitive", "it has no positions");
        return false;
    }
    for (const char* name : {"TEXCOORD_2", "COLOR_1", "JOINTS_2"})
        if (primitive.attributes.contains(name)) ignore(source, name, "additional attribute sets are not used");
    return true;
}

std::vector<Group> groupPrimitives(Source& source, const tinygltf::Mesh& mesh, const nlohmann::json& json,
                                   const std::string& label) {
    std::vector<Group> groups;
    // Index into `groups` of the group with these vertices. Compressed primitives are not listed: they share no
    // vertices.
    std::map<VertexSource, std::size_t> places;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const tinygltf::Primitive& primitive = mesh.primitives[i];
        if (!drawable(source, primitive, fmt::format("{}, primitive {}", label, i)) || isStroke(primitive)) continue;
        const bool compressed = findExtension(json["primitives"][i], "KHR_draco_mesh_compression") != nullptr;
        const VertexSource vertices{primitive.attributes, primitive.targets};
        if (!compressed) {
            const auto [place, added] = places.try_emplace(vertices, groups.size());
            if (!added) {
                groups[place->second].members.push_back(i);
                continue;
            }
        }
        groups.push_back({vertices, {i}, compressed});
    }
    return groups;
}

class MeshReader {
public:
    MeshReader(Source& source, const std::vector<Material>& materials) : source_(source), materials_(materials) {}

    Mesh read(std::size_t index) {
        const tinygltf::Mesh& from = source_.model.meshes[index];
        const nlohmann::json& json = source_.document.json["meshes"][index];
        const std::string label = labelOf("mesh", index, from.name);
        Mesh mesh;
        mesh.name = from.name;
        dropped_ = 0;
        std::vector<std::pair<std::size_t, Primitive>> primitives;
        for (const Group& group : groupPrimitives(source_, from, json, label)) {
            std::vector<Primitive> members = readGroup(mesh, from, json, group, label);
            for (std::size_t i = 0; i < members.size(); ++i)
                primitives.emplace_back(group.members[i], std::move(members[i]));
        }
        std::sort(primitives.begin(), primitives.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto& [order, primitive] : primitives) mesh.primitives.push_back(std::move(primitive));
        if (dropped_ > 0 && mesh.triangleCount() == 0)
            fault(source_.document, "{}: every triangle has a position that is NaN or infinite", label);
        for (std::size_t i = 0; i < from.primitives.size(); ++i)
            if (isStroke(from.primitives[i]) && from.primitives[i].attributes.contains("POSITION"))
                mesh.strokes.push_back(
                    readStrokes(source_, from.primitives[i], fmt::format("{}, primitive {}", label, i)));
        readMorphWeights(mesh, from, label);
        return mesh;
    }

private:
    // Reads the triangles and vertices of the primitives in a group. Appends the vertices to the mesh and returns the
    // primitives.
    std::vector<Primitive> readGroup(Mesh& mesh, const tinygltf::Mesh& from, const nlohmann::json& json,
                                     const Group& group, const std::string& label) {
        const std::string what = fmt::format("{}, primitive {}", label, group.members.front());
        std::optional<DracoPrimitive> draco;
        if (group.compressed)
            draco.emplace(
                source_, *findExtension(json["primitives"][group.members.front()], "KHR_draco_mesh_compression"), what);
        const VertexBlock& all =
            readBlock(from.primitives[group.members.front()], group, draco ? &*draco : nullptr, what);

        std::vector<Primitive> primitives;
        std::vector<std::vector<std::uint32_t>*> lists;
        for (const std::size_t member : group.members) {
            const tinygltf::Primitive& primitive = from.primitives[member];
            primitives.push_back(
                {primitive.material, readTriangles(source_, primitive, all.vertices.count(), draco ? &*draco : nullptr,
                                                   fmt::format("{}, primitive {}", label, member))});
        }
        lists.reserve(primitives.size());
        for (Primitive& primitive : primitives) lists.push_back(&primitive.indices);
        dropped_ += dropUnplaced(source_, all.vertices.positions, lists);

        VertexBlock block = finish(compacted(all, lists), lists, tangentUvSet(primitives, materials_), what);
        takeBudget(source_, block.vertices.count(), sizeof(glm::vec3) * 4, what);
        const std::uint32_t base = append(mesh, block);
        for (Primitive& primitive : primitives)
            for (std::uint32_t& index : primitive.indices) index += base;
        return primitives;
    }

    const VertexBlock& readBlock(const tinygltf::Primitive& primitive, const Group& group, const DracoPrimitive* draco,
                                 const std::string& what) {
        if (group.compressed || !last_ || last_->vertices != group.vertices)
            last_ = {group.compressed ? VertexSource{} : group.vertices,
                     readAttributes(source_, primitive, draco, what)};
        return last_->block;
    }

    // Repairs vertex attributes. Adds normals if they are missing, and tangents if they are missing and needed.
    VertexBlock finish(VertexBlock block, std::span<std::vector<std::uint32_t>* const> lists, int tangentUv,
                       const std::string& what) {
        const std::size_t replaced = repairAttributes(block, lists);
        if (replaced > 0) {
            const Ignored note = replacedNormalsNote(replaced);
            ignore(source_, note.what, note.reason, note.count);
        }
        if (block.vertices.normals.empty()) {
            std::size_t corners = 0;
            for (const std::vector<std::uint32_t>* list : lists) corners += list->size();
            takeBudget(source_, corners, sizeof(glm::vec3) * 2, what);
        }
        return withMissingAttributes(std::move(block), lists, tangentUv);
    }

    void readMorphWeights(Mesh& mesh, const tinygltf::Mesh& from, const std::string& label) {
        for (const tinygltf::Primitive& primitive : from.primitives)
            if (primitive.targets.size() != from.primitives.front().targets.size())
                fault(source_.document, "{}: its primitives have different numbers of morph targets", label);
        mesh.morphWeights.assign(mesh.morphTargets.size(), 0.0f);
        for (std::size_t i = 0; i < std::min(from.weights.size(), mesh.morphWeights.size()); ++i)
            mesh.morphWeights[i] = toFloat(from.weights[i]);
    }

    Source& source_;
    const std::vector<Material>& materials_;
    std::optional<LastBlock> last_;
    std::uint64_t dropped_ = 0;  // triangles of the current mesh that were dropped because of non-finite positions
};

}  // namespace

std::vector<Mesh> readMeshes(Source& source, const std::vector<Material>& materials, const Progress& progress) {
    MeshReader reader(source, materials);
    std::vector<Mesh> meshes;
    meshes.reserve(source.model.meshes.size());
    for (std::size_t i = 0; i < source.model.meshes.size(); ++i) {
        report(progress, "reading meshes", i, source.model.meshes.size());
        meshes.push_back(reader.read(i));
        meshes.back().blurBounds = boundsOf(meshes.back().vertices.blurs);
    }
    return meshes;
}

}  // namespace defocus::engine::gltf
