#include "scene/finish_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/error.h"
#include "scene/pose.h"
#include "scene/tangents.h"

namespace defocus::engine {

namespace {

bool normalise(glm::vec3& vector) {
    const glm::dvec3 wide = vector;
    const double length = glm::length(wide);
    if (!(length > 1e-12) || !std::isfinite(length)) return false;
    // Vectors whose length is already 1 within float precision stay unchanged.
    if (std::abs(length - 1.0) > 1e-6) vector = glm::vec3(wide / length);
    return true;
}

std::size_t repairNormals(VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices) {
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < block.vertices.normals.size(); ++i)
        if (!normalise(block.vertices.normals[i])) broken.push_back(i);
    if (broken.empty()) return 0;
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>* list : indices) all.insert(all.end(), list->begin(), list->end());
    const std::vector<glm::vec3> smooth = smoothNormals(block.vertices.positions, all);
    for (const std::size_t i : broken) block.vertices.normals[i] = smooth[i];
    return broken.size();
}

void repairTangents(VertexBlock& block) {
    for (std::size_t i = 0; i < block.vertices.tangents.size(); ++i) {
        glm::vec4& tangent = block.vertices.tangents[i];
        glm::vec3 direction(tangent);
        if (!normalise(direction)) direction = perpendicular(block.vertices.normals[i]);
        tangent = glm::vec4(direction, tangent.w < 0 ? -1.0f : 1.0f);
    }
}

// Sets negative and non-finite weights to 0 and returns the sum of the remaining weights.
double usableSum(glm::vec4& weight) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        if (!(weight[i] > 0) || !std::isfinite(weight[i])) weight[i] = 0;
        sum += static_cast<double>(weight[i]);
    }
    return sum;
}

// Scales the skin weights of each vertex so that they sum to 1. Vertices without a positive weight follow their first
// joint.
void repairWeights(VertexBlock& block) {
    Vertices& vertices = block.vertices;
    bool furtherCount = false;
    for (std::size_t i = 0; i < vertices.weights.size(); ++i) {
        glm::vec4 none(0);
        glm::vec4& first = vertices.weights[i];
        glm::vec4& further = vertices.weights1.empty() ? none : vertices.weights1[i];
        const double firstSum = usableSum(first);
        const double furtherSum = usableSum(further);
        const double sum = firstSum + furtherSum;
        first = sum > 0 ? glm::vec4(glm::dvec4(first) / sum) : glm::vec4(1, 0, 0, 0);
        if (sum > 0) further = glm::vec4(glm::dvec4(further) / sum);
        furtherCount |= furtherSum > 0;
    }
    if (furtherCount) return;
    vertices.joints1.clear();
    vertices.weights1.clear();
}

bool finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

}  // namespace

std::size_t repairAttributes(VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices) {
    const std::size_t replaced = repairNormals(block, indices);
    repairTangents(block);
    repairWeights(block);
    return replaced;
}

Ignored replacedNormalsNote(std::size_t count) {
    return {"vertex normals", "zero length, NaN or infinite; replaced by the average normal of the adjacent faces",
            count};
}

int tangentUvSet(std::span<const Primitive> primitives, std::span<const Material> materials) {
    for (const Primitive& primitive : primitives) {
        if (primitive.material < 0) continue;
        const Material& material = materials[static_cast<std::size_t>(primitive.material)];
        for (const TextureUse* use : {&material.normal, &material.clearcoatNormal, &material.anisotropy})
            if (use->used()) return use->uvSet;
        if (material.isAnisotropic()) return 0;
    }
    return -1;
}

VertexBlock withMissingAttributes(VertexBlock block, std::span<std::vector<std::uint32_t>* const> indices,
                                  int tangentUvs) {
    if (block.vertices.normals.empty()) block = flatShaded(block, indices);
    if (tangentUvs >= 0 && block.vertices.tangents.empty()) block = withTangents(block, indices, tangentUvs);
    return block;
}

std::string placedAtInfinity(const Scene& scene) {
    const Pose pose = unmeasuredPoseAt(scene, 0, -1);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (!finite(pose.worldFromNode[i])) return fmt::format("node '{}'", scene.nodes[i].name);
    for (const Object& object : pose.objects)
        if (!finite(object.worldFromObject) || !std::ranges::all_of(object.worldFromJoint, finite))
            return fmt::format("object '{}'", object.name);
    return {};
}

}  // namespace defocus::engine
