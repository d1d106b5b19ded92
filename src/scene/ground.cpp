#include "scene/ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace defocus::engine {

namespace {

constexpr double reach = 30;  // radius of the disk relative to the radius of the scene
constexpr float reflectance = 0.36f;
constexpr std::uint32_t sectors = 96;  // number of sectors; enough for a horizon without visible corners
constexpr std::uint32_t rings = 12;    // number of rings; enough that blur is nearly linear within each triangle

// Returns a triangulated unit disk in the plane y = 0, facing +y. Its rings of vertices are denser towards the centre.
Mesh disk(int material) {
    Mesh mesh;
    mesh.name = "Ground";
    Primitive primitive{material, {}};
    mesh.vertices.positions.emplace_back(0.0f);
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        const double share = static_cast<double>(ring) / rings;
        for (std::uint32_t i = 0; i < sectors; ++i) {
            const double angle = 2 * std::numbers::pi * i / sectors;
            mesh.vertices.positions.emplace_back(share * share * glm::dvec3(std::cos(angle), 0, -std::sin(angle)));
        }
    }
    const auto corner = [](std::uint32_t ring, std::uint32_t i) {
        return ring == 0 ? 0 : 1 + (ring - 1) * sectors + i % sectors;
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t i = 0; i < sectors; ++i) {
            const std::uint32_t inner = corner(ring, i), outer = corner(ring + 1, i);
            const std::uint32_t nextInner = corner(ring, i + 1), nextOuter = corner(ring + 1, i + 1);
            primitive.indices.insert(primitive.indices.end(), {inner, outer, nextOuter});
            if (ring > 0) primitive.indices.insert(primitive.indices.end(), {inner, nextOuter, nextInner});
        }
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 1, 0});
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

}  // namespace

bool hasGround(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, &Node::ground);
}

void removeGround(Scene& scene) {
    if (!hasGround(scene)) return;
    scene.roots.pop_back();
    scene.nodes.pop_back();
    scene.meshes.pop_back();
    scene.materials.pop_back();
}

void addGround(Scene& scene, const Pose& pose) {
    if (pose.bounds.empty()) return;
    Material material;
    material.name = "Ground";
    material.baseColorFactor = {reflectance, reflectance, reflectance, 1};
    material.metallicFactor = 0;
    material.roughnessFactor = 1;
    material.specularFactor = 0;  // no highlights, which would show lights that are not in the image
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(disk(static_cast<int>(scene.materials.size()) - 1));

    const glm::dvec3 size = pose.bounds.size();
    const double radius = 0.5 * std::max({size.x, size.y, size.z});
    const glm::dvec3 centre = pose.bounds.centre();
    Node node;
    node.name = "Ground";
    node.mesh = static_cast<int>(scene.meshes.size()) - 1;
    node.ground = true;
    node.translation = glm::dvec3(centre.x, pose.bounds.minimum.y, centre.z) / scene.metresPerUnit;
    node.scale = glm::dvec3(reach * std::max(radius, 1e-9) / scene.metresPerUnit);
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
}

}  // namespace defocus::engine
