// glTF 2.0 specification, 3.7.2.2 (morph targets) and 3.7.3 (skins).
#include "plan/clip_vertices.h"

#include <algorithm>
#include <cmath>

namespace defocus {

namespace {

void addInfluences(const ObjectPose& pose, const glm::u16vec4& joints, const glm::vec4& weights, glm::dmat4& sum,
                   double& weightSum) {
    for (int i = 0; i < 4; ++i) {
        if (!(weights[i] > 0)) continue;
        const std::size_t joint = joints[i] < pose.viewFromJoint.size() ? joints[i] : 0;
        sum += static_cast<double>(weights[i]) * pose.viewFromJoint[joint];
        weightSum += static_cast<double>(weights[i]);
    }
}

glm::dmat4 viewFromVertex(const Vertices& vertices, const ObjectPose& pose, bool skinned, std::size_t vertex) {
    if (!skinned || vertices.joints.empty()) return pose.viewFromJoint.front();
    glm::dmat4 sum(0.0);
    double weightSum = 0;
    addInfluences(pose, vertices.joints[vertex], vertices.weights[vertex], sum, weightSum);
    if (!vertices.joints1.empty())
        addInfluences(pose, vertices.joints1[vertex], vertices.weights1[vertex], sum, weightSum);
    return weightSum > 0 ? sum / weightSum : pose.viewFromJoint.front();
}

// Where morph targets have the level's vertices, in the mesh's space.
std::vector<glm::dvec3> morphedPositions(const Mesh& mesh, const Pyramid& pyramid, std::uint32_t level,
                                         const ObjectPose& pose) {
    const std::vector<glm::vec3>& own = pyramid.levels[level].positions;
    std::vector<glm::dvec3> result(own.begin(), own.end());
    const std::size_t targets = std::min(mesh.morphTargets.size(), pose.morphWeights.size());
    for (std::size_t t = 0; t < targets; ++t) {
        const double weight = pose.morphWeights[t];
        const std::vector<glm::vec3>& displacements = mesh.morphTargets[t].positions;
        if (weight == 0 || !std::isfinite(weight) || displacements.empty()) continue;
        for (std::size_t v = 0; v < result.size(); ++v)
            result[v] += weight * glm::dvec3(displacements[pyramid.source[v]]);
    }
    return result;
}

}  // namespace

ClipVertices clipVertices(const FramePlan& plan, const World& world, const ObjectPlan& object, std::uint32_t level,
                          const ObjectPose& pose, double time) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    const Vertices& vertices = pyramid.vertices;
    const glm::dvec2 perTangent = glm::dvec2(1, plan.coc.aspect) / plan.tanHalfHorizontal;
    ClipVertices result;
    result.places = morphedPositions(mesh, pyramid, level, pose);
    for (std::size_t v = 0; v < result.places.size(); ++v) {
        glm::dvec3& place = result.places[v];
        const glm::dvec3 view(viewFromVertex(vertices, pose, object.skinned, v) * glm::dvec4(place, 1));
        place = glm::dvec3(glm::dvec2(view) * perTangent, -view.z);
        double factor = object.cocScale;
        double added = 0;
        if (!vertices.blurs.empty()) {
            const VertexBlur& blur = vertices.blurs[v];
            const double millimetres = blur.opening + time * (double{blur.closing} - double{blur.opening});
            factor *= static_cast<double>(blur.factor);
            added = object.cocScale * plan.coc.shareOfMillimetre * millimetres;
        }
        const double w = place.z;
        const double relative = circleOfConfusion(plan.coc, w, 1, glm::dvec2(place) / w, factor, added);
        result.coc.push_back(w * relative);
    }
    return result;
}

}  // namespace defocus
