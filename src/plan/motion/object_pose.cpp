#include "plan/motion/object_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace defocus::engine {

namespace {

// Returns the bounds of the offsets that all morph targets together add to a vertex position.
Bounds morphReach(const Pyramid& pyramid, const ObjectPose& pose) {
    Bounds reach;
    reach.extend(glm::dvec3(0));
    const std::size_t targets = std::min(pyramid.morphBounds.size(), pose.morphWeights.size());
    for (std::size_t t = 0; t < targets; ++t) {
        const double weight = pose.morphWeights[t];
        if (!std::isfinite(weight)) continue;
        const glm::dvec3 a = weight * pyramid.morphBounds[t].minimum;
        const glm::dvec3 b = weight * pyramid.morphBounds[t].maximum;
        reach.minimum += glm::min(a, b);
        reach.maximum += glm::max(a, b);
    }
    return reach;
}

Bounds widened(Bounds box, const Bounds& reach) {
    if (box.empty()) return box;
    box.minimum += reach.minimum;
    box.maximum += reach.maximum;
    return box;
}

}  // namespace

ObjectPose objectPose(const Object& object, const glm::dmat4& viewFromWorld) {
    ObjectPose pose;
    if (!object.skinned()) pose.viewFromJoint.push_back(viewFromWorld * object.worldFromObject);
    for (const glm::dmat4& worldFromJoint : object.worldFromJoint)
        pose.viewFromJoint.push_back(viewFromWorld * worldFromJoint);
    pose.morphWeights = object.morphWeights;
    return pose;
}

bool morphs(const ObjectPose& pose) {
    return std::any_of(pose.morphWeights.begin(), pose.morphWeights.end(), [](double weight) { return weight != 0; });
}

Bounds posedBox(const Pyramid& pyramid, const ObjectPose& pose, bool skinned) {
    const Bounds reach = morphReach(pyramid, pose);
    if (!skinned || pyramid.jointBounds.empty())
        return transformed(widened(pyramid.bounds, reach), pose.viewFromJoint.front());
    Bounds box;
    for (std::size_t j = 0; j < pyramid.jointBounds.size(); ++j) {
        // Joint indices outside the skin select the first joint, as in posing.glsl.
        const glm::dmat4& matrix = pose.viewFromJoint[j < pose.viewFromJoint.size() ? j : 0];
        box.extend(transformed(widened(pyramid.jointBounds[j], reach), matrix));
    }
    return box;
}

double largestScale(const ObjectPose& pose) {
    double largest = 0;
    for (const glm::dmat4& matrix : pose.viewFromJoint)
        for (int column = 0; column < 3; ++column) largest = std::max(largest, glm::length(glm::dvec3(matrix[column])));
    return largest;
}

bool mirrors(const ObjectPose& pose) {
    std::ptrdiff_t balance = 0;
    for (const glm::dmat4& matrix : pose.viewFromJoint) {
        const double determinant = glm::determinant(glm::dmat3(matrix));
        balance += determinant < 0 ? 1 : determinant > 0 ? -1 : 0;
    }
    return balance > 0;
}

}  // namespace defocus::engine
