#pragma once
// The node hierarchy at one moment, and what a renderer needs of it: objects (mesh instances), lights and cameras in
// world space.

#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace defocus::engine {

struct Object {  // a mesh instance with all its primitives
    int mesh = -1;
    int node = -1;
    std::string name;  // the node's, else the mesh's name; instances carry "#i"
    // Of a skinned object: where its first joint takes it, for what needs one matrix.
    glm::dmat4 worldFromObject{1.0};
    double cocScale = 1;  // factor on the blur, ≥ 0
    // Each joint's place times its inverse bind matrix (the node's own place does not count); empty without a skin.
    std::vector<glm::dmat4> worldFromJoint;
    std::vector<double> morphWeights;  // one a morph target of the mesh
    // What the scene stands on: no subject of cameras and focus, and below everything that could be in its shadow.
    bool ground = false;

    [[nodiscard]] bool skinned() const { return !worldFromJoint.empty(); }
};

struct PlacedLight {
    Light light;
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  // unit, the way the light shines
};

struct Pose {
    std::vector<glm::dmat4> worldFromNode;  // as many as Scene::nodes
    std::vector<Object> objects;
    std::vector<PlacedLight> lights;
    std::vector<Camera> cameras;  // as many as Scene::cameras, with their values of the moment
    Bounds bounds;                // of all objects but the ground, world space
};

// The scene in metres at `time` seconds into its clip `clip` (-1: no animation). Times outside the clip hold its ends.
Pose poseAt(const Scene& scene, double time, int clip = 0);
// The same with empty `bounds`, which take the longest.
Pose unmeasuredPoseAt(const Scene& scene, double time, int clip = 0);

// The pose's lights, as large as those that stood for them `before`; those where the pose has none.
std::vector<PlacedLight> movedLights(const std::vector<PlacedLight>& before, const Pose& pose);

// The node of that name; throws Error listing the names that exist.
int nodeNamed(const Scene& scene, std::string_view name);

// World position of a node: the centre of its mesh's bounds, as posed, where it has one, else its origin.
glm::dvec3 nodeCentre(const Scene& scene, const Pose& pose, int node);

}  // namespace defocus::engine
