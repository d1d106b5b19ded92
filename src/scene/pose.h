#pragma once
// Computes a scene at one instant: objects (mesh instances), lights and cameras in world space.

#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace defocus::engine {

struct Object {  // mesh instance with all its primitives
    int mesh = -1;
    int node = -1;
    std::string name;  // name of the node or, if empty, of the mesh; "#i" is appended for instance i
    // For a skinned object, the matrix of its first joint, for code that needs one matrix per object.
    glm::dmat4 worldFromObject{1.0};
    double cocScale = 1;  // multiplies the circle of confusion of the object, ≥ 0
    // World matrix times inverse bind matrix of each joint; empty without a skin. With a skin, worldFromObject does not
    // apply to vertices.
    std::vector<glm::dmat4> worldFromJoint;
    std::vector<double> morphWeights;
    // True for the ground plane that addGround (scene/ground.h) adds. Default framing and focus ignore the ground, and
    // it casts no shadows.
    bool ground = false;

    [[nodiscard]] bool skinned() const { return !worldFromJoint.empty(); }
};

struct PlacedLight {
    Light light;
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  // unit vector along which the light shines
};

inline constexpr std::size_t maxLights = 336;  // max lights that fit into a uniform block on every OpenGL driver

struct Pose {
    std::vector<glm::dmat4> worldFromNode;  // matrices of the nodes; same indices as Scene::nodes
    std::vector<Object> objects;
    std::vector<PlacedLight> lights;       // at most maxLights; intensity 0 while an animation hides the light
    std::size_t faintLights = 0;           // number of lights dropped because of maxLights, the faintest first
    std::vector<Camera> cameras;           // cameras with animated values; same indices as Scene::cameras
    std::optional<TrackedCamera> tracked;  // camera of Scene::cameraTrack at this time
    Bounds bounds;                         // bounding box of all objects except the ground, in world space
};

// Returns the scene in metres at `time` seconds of clip `clip` (index; −1: no animation). Times outside the clip give
// its first or last pose.
Pose poseAt(const Scene& scene, double time, int clip = 0);
// Returns the pose of poseAt but with empty `bounds`, whose computation takes most of the time of poseAt.
Pose unmeasuredPoseAt(const Scene& scene, double time, int clip = 0);
// Returns the pose at a shutter time, with empty `bounds`. It contains the objects of `exposed`, the frame's pose, in
// the same order, even if an animation shows or hides objects during the exposure.
Pose shutterPoseAt(const Scene& scene, double time, int clip, const Pose& exposed);

// Returns the pose's lights, but with the sizes (angular diameters and radii) of the lights `before`, matched by index,
// because --light-angle and --light-radius change these. Returns `before`, which may be default lights, if the pose has
// no lights.
std::vector<PlacedLight> movedLights(const std::vector<PlacedLight>& before, const Pose& pose);

// Returns the index of the node with this name. Throws Error, with a list of existing names, if there is none.
int nodeNamed(const Scene& scene, std::string_view name);

// Returns the centre of the bounding box of a node's posed mesh in world space; for a node without a mesh, the node's
// origin.
glm::dvec3 nodeCentre(const Scene& scene, const Pose& pose, int node);

}  // namespace defocus::engine
