// Source: glTF 2.0 specification, 3.7.2.2 (morph targets) and 3.7.3 (skins).
#include "scene/posed_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <optional>
#include <span>

namespace defocus::engine {

namespace {

void addInfluences(std::span<const glm::dmat4> matrices, const glm::u16vec4& joints, const glm::vec4& weights,
                   glm::dmat4& sum, double& weightSum) {
    for (int i = 0; i < 4; ++i) {
        if (!(weights[i] > 0) || !std::isfinite(weights[i])) continue;
        const std::size_t joint = joints[i] < matrices.size() ? joints[i] : 0;
        sum += static_cast<double>(weights[i]) * matrices[joint];
        weightSum += static_cast<double>(weights[i]);
    }
}

// Returns the world matrix of a vertex: the mean of its joints' matrices, weighted by the vertex's joint weights. For a
// vertex without joints, it is the object's matrix.
glm::dmat4 worldFromVertex(const Vertices& vertices, const Object& object, std::size_t vertex) {
    if (!object.skinned() || vertices.joints.empty()) return object.worldFromObject;
    glm::dmat4 sum(0.0);
    double weightSum = 0;
    addInfluences(object.worldFromJoint, vertices.joints[vertex], vertices.weights[vertex], sum, weightSum);
    if (!vertices.joints1.empty())
        addInfluences(object.worldFromJoint, vertices.joints1[vertex], vertices.weights1[vertex], sum, weightSum);
    return weightSum > 0 ? sum / weightSum : object.worldFromJoint.front();
}

// Returns `values`, which are positions or normals, plus the displacements of the mesh's morph targets, weighted by the
// object's morph weights.
std::vector<glm::dvec3> morphed(const std::vector<glm::vec3>& values, const Mesh& mesh, const Object& object,
                                std::vector<glm::vec3> MorphTarget::*kind) {
    std::vector<glm::dvec3> result(values.begin(), values.end());
    const std::vector<double>& weights = object.morphWeights;
    for (std::size_t t = 0; t < std::min(mesh.morphTargets.size(), weights.size()); ++t) {
        const std::vector<glm::vec3>& displacements = mesh.morphTargets[t].*kind;
        if (weights[t] == 0 || !std::isfinite(weights[t]) || displacements.empty()) continue;
        for (std::size_t v = 0; v < result.size(); ++v) result[v] += weights[t] * glm::dvec3(displacements[v]);
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> posedPositions(const Mesh& mesh, const Object& object) {
    std::vector<glm::dvec3> result = morphed(mesh.vertices.positions, mesh, object, &MorphTarget::positions);
    for (std::size_t v = 0; v < result.size(); ++v)
        result[v] = glm::dvec3(worldFromVertex(mesh.vertices, object, v) * glm::dvec4(result[v], 1));
    return result;
}

std::vector<glm::vec3> posedNormals(const Mesh& mesh, const Object& object) {
    const std::vector<glm::dvec3> bound = morphed(mesh.vertices.normals, mesh, object, &MorphTarget::normals);
    std::vector<glm::vec3> result(bound.size());
    for (std::size_t v = 0; v < result.size(); ++v) {
        const glm::dmat3 linear(worldFromVertex(mesh.vertices, object, v));
        const glm::dvec3 turned = glm::inverseTranspose(linear) * bound[v];
        const double length = glm::length(turned);
        result[v] = length > 0 && std::isfinite(length) ? glm::vec3(turned * (glm::length(bound[v]) / length))
                                                        : glm::vec3(bound[v]);
    }
    return result;
}

bool deformed(const Object& object) {
    return object.skinned() || std::any_of(object.morphWeights.begin(), object.morphWeights.end(),
                                           [](double weight) { return weight != 0; });
}

Bounds posedBounds(const Mesh& mesh, const Object& object) {
    return posedBounds(mesh, deformed(object) ? Bounds{} : mesh.bounds(), object);
}

Bounds posedBounds(const Mesh& mesh, const Bounds& meshBounds, const Object& object) {
    if (!deformed(object)) return transformed(meshBounds, object.worldFromObject);
    const std::vector<glm::dvec3> positions = posedPositions(mesh, object);
    Bounds bounds;
    for (const Primitive& primitive : mesh.primitives)
        for (const std::uint32_t index : primitive.indices) bounds.extend(positions[index]);
    return bounds;
}

Bounds posedBounds(const Scene& scene, const Pose& pose) {
    Bounds result;
    std::vector<std::optional<Bounds>> meshBounds(scene.meshes.size());
    for (const Object& object : pose.objects) {
        if (object.ground) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        std::optional<Bounds>& bounds = meshBounds[static_cast<std::size_t>(object.mesh)];
        if (!bounds) bounds = mesh.bounds();
        result.extend(posedBounds(mesh, *bounds, object));
    }
    return result;
}

}  // namespace defocus::engine
