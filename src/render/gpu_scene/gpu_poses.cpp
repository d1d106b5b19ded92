#include "render/gpu_scene/gpu_poses.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace defocus::engine {

namespace {

// Returns the indices of the morph targets with a nonzero weight in at least one pose.
std::vector<std::size_t> targetsUsed(const std::vector<const ObjectPose*>& poses, const GpuMorphs& morphs) {
    std::vector<std::size_t> used;
    if (!morphs) return used;
    for (std::size_t t = 0; t < poses.front()->morphWeights.size(); ++t)
        if (std::any_of(poses.begin(), poses.end(), [&](const ObjectPose* pose) { return pose->morphWeights[t] != 0; }))
            used.push_back(t);
    return used;
}

void addRows(std::vector<float>& texels, const glm::dmat4& matrix) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) texels.push_back(static_cast<float>(matrix[column][row]));
}

}  // namespace

GpuPoses gpuPoses(const FramePlan& plan, const ObjectPlan& object, const GpuMesh& mesh) {
    GpuPoses result;
    if (!object.deformed && object.motion.empty()) return result;
    std::vector<const ObjectPose*> poses;
    for (const ObjectPose& pose : object.motion) poses.push_back(&pose);
    if (poses.empty()) poses.push_back(&object.pose);
    const std::vector<std::size_t> targets = targetsUsed(poses, mesh.morphs);
    const std::size_t joints = object.pose.viewFromJoint.size();
    result.count = poses.size();
    result.skinned = object.skinned;
    result.moving = !object.motion.empty();
    result.cameraMoves = result.moving && !plan.middleFromView.empty();
    result.layout = glm::ivec4(3 * joints + targets.size() + (result.cameraMoves ? 3 : 0), joints, targets.size(),
                               mesh.morphs.vertexCount);

    std::vector<float> texels;
    texels.reserve(poses.size() * static_cast<std::size_t>(result.layout.x) * 4);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const ObjectPose* pose = poses[i];
        for (const glm::dmat4& matrix : pose->viewFromJoint) addRows(texels, glm::translate(matrix, mesh.origin));
        for (const std::size_t target : targets) {
            const auto weight = static_cast<float>(pose->morphWeights[target]);
            texels.insert(texels.end(), {std::isfinite(weight) ? weight : 0, static_cast<float>(target), 0, 0});
        }
        if (result.cameraMoves) addRows(texels, plan.middleFromView[i]);
    }
    result.texels =
        TexelBuffer(texels, GL_RGBA32F, 4, "poses of an object (use fewer samples or fewer motion segments)");
    return result;
}

void poseDefines(ShaderDefines& defines, const GpuPoses& poses, const GpuMesh& mesh) {
    if (!poses.texels) return;
    defines.emplace_back("POSED", "");
    if (poses.moving) defines.emplace_back("moving", "true");
    if (poses.cameraMoves) defines.emplace_back("cameraMoves", "true");
    if (poses.skinned && mesh.has(jointsLocation))
        defines.emplace_back("skinInfluences", mesh.has(joints1Location) ? "8" : "4");
    if (poses.layout.z == 0) return;
    defines.emplace_back("morphed", "true");
    defines.emplace_back("morphAttributes", std::to_string(mesh.morphs.attributesPerTarget()));
    if (mesh.morphs.normals) defines.emplace_back("morphNormals", "true");
    if (mesh.morphs.tangents) defines.emplace_back("morphTangents", "true");
}

}  // namespace defocus::engine
