#include "scene/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "scene/vertex_block.h"

namespace defocus::engine {

namespace {

constexpr std::size_t corners = 4;  // corners of the quad that draws a point or a line segment

// Adds the materials of strokes (points and lines) to a scene: copies of the file's materials, lit or unlit.
class StrokeMaterials {
public:
    explicit StrokeMaterials(Scene& scene) : scene_(scene) {}

    // Returns the index of the lit or unlit copy of the file's material `index`.
    int of(int index, bool lit) {
        const auto [entry, isNew] = places_.try_emplace({index, lit}, static_cast<int>(scene_.materials.size()));
        if (!isNew) return entry->second;
        Material material = index >= 0 ? scene_.materials[static_cast<std::size_t>(index)] : Material{};
        material.doubleSided = true;
        material.normal = material.clearcoatNormal = {};  // points and lines have no tangents for normal maps
        if (!lit) {
            material.unlit = true;
            material.baseColorFactor += glm::vec4(material.emissiveFactor, 0);
        }
        scene_.materials.push_back(std::move(material));
        return entry->second;
    }

private:
    Scene& scene_;
    std::map<std::pair<int, bool>, int> places_;
};

// Half the width of a stroke (a point or line), in world space.
class HalfWidth {
public:
    explicit HalfWidth(const StrokeView& view) : view_(view), cameraFromWorld_(glm::inverse(view.worldFromCamera)) {}

    [[nodiscard]] double at(const glm::dvec3& point) const {
        const double depth = -(cameraFromWorld_ * glm::dvec4(point, 1)).z;
        return 0.5 * view_.pixelTangent * std::max(depth, view_.nearPlane);
    }
    [[nodiscard]] glm::dvec3 right(const glm::dvec3& point) const {
        return at(point) * glm::dvec3(view_.worldFromCamera[0]);
    }
    [[nodiscard]] glm::dvec3 up(const glm::dvec3& point) const {
        return at(point) * glm::dvec3(view_.worldFromCamera[1]);
    }
    // Returns half the line's width as a vector parallel to the image plane. Seen from the camera, it points to the
    // left of `direction`.
    [[nodiscard]] glm::dvec3 across(const glm::dvec3& point, const glm::dvec3& direction) const {
        const glm::dvec3 p(cameraFromWorld_ * glm::dvec4(point, 1));
        const glm::dvec3 d(cameraFromWorld_ * glm::dvec4(direction, 0));
        const glm::dvec2 along = glm::dvec2(d) * std::max(-p.z, view_.nearPlane) + glm::dvec2(p) * d.z;
        const double length = glm::length(along);
        if (!(length > 0) || !std::isfinite(length)) return up(point);
        return (along.x * up(point) - along.y * right(point)) / length;
    }

private:
    const StrokeView& view_;
    glm::dmat4 cameraFromWorld_;
};

// Returns the corners of the quad for a point or a line segment in world space, counter-clockwise as seen from the
// camera.
std::array<glm::dvec3, corners> quadOf(const glm::dvec3& begin, const glm::dvec3& end, bool points,
                                       const HalfWidth& half) {
    if (points) {
        const glm::dvec3 right = half.right(begin), up = half.up(begin);
        return {begin - right - up, begin + right - up, begin + right + up, begin - right + up};
    }
    const glm::dvec3 atBegin = half.across(begin, end - begin), atEnd = half.across(end, end - begin);
    return {begin - atBegin, end - atEnd, end + atEnd, begin + atBegin};
}

// Appends the quads of `strokes` to `mesh`, for an object with the matrix `worldFromObject`.
void appendQuads(const Strokes& strokes, int material, const glm::dmat4& worldFromObject, const HalfWidth& half,
                 Mesh& mesh) {
    const std::size_t ends = strokes.points ? 1 : 2;
    const std::size_t count = strokes.indices.size() / ends;
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t begin = strokes.indices[i * ends], end = strokes.indices[i * ends + ends - 1];
        order.insert(order.end(), {begin, end, end, begin});
    }
    VertexBlock block{gathered(strokes.vertices, order), {}};
    const glm::dmat4 objectFromWorld = glm::inverse(worldFromObject);
    const auto toWorld = [&](std::uint32_t vertex) {
        return glm::dvec3(worldFromObject * glm::dvec4(strokes.vertices.positions[vertex], 1));
    };
    Primitive primitive{material, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const auto quad = quadOf(toWorld(order[corners * i]), toWorld(order[corners * i + 1]), strokes.points, half);
        for (std::size_t c = 0; c < corners; ++c) {
            const glm::vec3 corner(objectFromWorld * glm::dvec4(quad[c], 1));
            if (std::isfinite(glm::dot(corner, corner))) block.vertices.positions[corners * i + c] = corner;
        }
        for (const std::uint32_t c : {0u, 1u, 2u, 0u, 2u, 3u})
            primitive.indices.push_back(static_cast<std::uint32_t>(corners * i) + c);
    }
    if (block.vertices.normals.empty()) block.vertices.normals.assign(block.vertices.positions.size(), {0, 0, 1});
    const std::uint32_t base = append(mesh, block);
    for (std::uint32_t& index : primitive.indices) index += base;
    mesh.primitives.push_back(std::move(primitive));
}

}  // namespace

bool hasStrokes(const Scene& scene) {
    return std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return !mesh.strokes.empty(); });
}

Scene withStrokes(const Scene& scene, const Pose& pose, const StrokeView& view) {
    Scene result = scene;
    for (Mesh& mesh : result.meshes) mesh.strokes.clear();
    const HalfWidth half(view);
    StrokeMaterials materials(result);
    std::vector<bool> nodeDone(scene.nodes.size());
    std::vector<bool> meshDone(scene.meshes.size());
    for (const Object& object : pose.objects) {
        const auto node = static_cast<std::size_t>(object.node);
        const auto place = static_cast<std::size_t>(object.mesh);
        if (nodeDone[node] || scene.meshes[place].strokes.empty()) continue;
        Mesh mesh = scene.meshes[place];
        mesh.strokes.clear();
        for (const Strokes& strokes : scene.meshes[place].strokes)
            appendQuads(strokes, materials.of(strokes.material, !strokes.vertices.normals.empty()),
                        object.worldFromObject, half, mesh);
        mesh.blurBounds = boundsOf(mesh.vertices.blurs);
        if (meshDone[place]) {
            result.nodes[node].mesh = static_cast<int>(result.meshes.size());
            result.meshes.push_back(std::move(mesh));
        } else {
            result.meshes[place] = std::move(mesh);
        }
        nodeDone[node] = meshDone[place] = true;
    }
    return result;
}

}  // namespace defocus::engine
