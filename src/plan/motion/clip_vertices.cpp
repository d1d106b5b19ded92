#include "plan/motion/clip_vertices.h"

#include "scene/posed_mesh.h"

namespace defocus::engine {

ClipVertices clipVertices(const FramePlan& plan, const World& world, const ObjectPlan& object, std::uint32_t level,
                          const ObjectPose& pose, double time) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    const Vertices& vertices = pyramid.vertices;
    const glm::dvec2 perTangent = glm::dvec2(1, plan.coc.aspect) / plan.tanHalfHorizontal;
    const bool skinned = object.skinned && !vertices.joints.empty();
    const std::vector<glm::vec3>& own = pyramid.levels[level].positions;
    ClipVertices result;
    result.places.assign(own.begin(), own.end());
    addMorphs(mesh, pose.morphWeights, &MorphTarget::positions, pyramid.source, result.places);
    for (std::size_t v = 0; v < result.places.size(); ++v) {
        glm::dvec3& place = result.places[v];
        const glm::dmat4 viewFromVertex =
            skinned ? skinMatrix(vertices, pose.viewFromJoint, v) : pose.viewFromJoint.front();
        const glm::dvec3 view(viewFromVertex * glm::dvec4(place, 1));
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

}  // namespace defocus::engine
