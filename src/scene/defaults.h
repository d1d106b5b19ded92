#pragma once
// Defaults for files without camera, lights or environment: a camera that frames the scene, three studio lights and a
// sky.

#include <glm/mat4x4.hpp>
#include <span>

#include "defocus/camera.h"
#include "scene/pose.h"

namespace defocus::engine {

struct PlacedCamera {
    Camera camera;
    glm::dmat4 worldFromCamera{1.0};  // no scale
    int node = -1;                    // node that holds the camera; −1: default framing camera
};

// Returns the chosen camera. NamedCamera matches the name of a camera or of its node; FirstCamera skips orthographic
// cameras. The framing camera shows `pose.bounds` from a three-quarter view at the image aspect (width / height), with
// matching focusDistance and znear. Throws Error for orthographic cameras and for unknown names, listing the known
// ones.
PlacedCamera chooseCamera(const Scene& scene, const Pose& pose, const CameraChoice& choice, double aspect);

// Returns the camera's matrix in another pose of the same scene; a framing camera keeps its matrix.
glm::dmat4 worldFromCameraIn(const PlacedCamera& camera, const Pose& pose);

// Default directional light. Angles are in radians as seen from the scene: `azimuth` to the right of the camera,
// `elevation` above it.
struct StudioLight {
    const char* name = "";
    double azimuth = 0;
    double elevation = 0;
    glm::vec3 color{1.0f};
    float illuminance = 1;       // lux
    double angularDiameter = 0;  // rad, angular size of the softbox
    // Returns the unit vector towards the light in camera axes: right, up, back.
    [[nodiscard]] glm::dvec3 toLight() const;
};
std::span<const StudioLight> studioLights();

// lightsOrDefault returns the scene's lights, or else key, fill and rim lights placed relative to the camera. It
// returns none if every visible material is unlit or uniformly emissive. environmentOrDefault returns the scene's
// environment, or else a soft sky. Together the defaults show an 18 % grey card at 18 % of display white.
std::vector<PlacedLight> lightsOrDefault(const Scene& scene, const Pose& pose, const PlacedCamera& camera);
Environment environmentOrDefault(const Scene& scene);

// Returns a factor (≥ 1) on the default sky's radiance that balances it with the scene's own lights. The sky then gives
// the scene's centre a seventh of the illuminance of those lights, like a sky that fills sun shadows.
double skyScale(const Pose& pose);

}  // namespace defocus::engine
