#pragma once
// Chooses defaults for files without camera, lights or environment: a camera that frames the scene, three studio lights
// and a sky.

#include <glm/mat4x4.hpp>
#include <optional>
#include <span>

#include "defocus/camera.h"
#include "scene/pose.h"

namespace defocus::engine {

struct PlacedCamera {
    Camera camera;
    glm::dmat4 worldFromCamera{1.0};  // rigid transform, without scale
    int node = -1;                    // index of the node that holds the camera; −1: none
    bool tracked = false;  // true: camera of Pose::tracked; if false and node is −1: the default framing camera
};

// Returns the camera that `choice` selects. NamedCamera is the name of a camera or of its node. FirstCamera selects the
// scene's camera track. Without a track, it selects the first camera that is not orthographic, or the default camera if
// there is none. The default camera shows `pose.bounds` from a three-quarter view in an image of `aspect` = width /
// height, with matching focusDistance and znear. `tanHalfHorizontal` is the tangent of half the default camera's
// horizontal angle of view; nullopt: a 50 mm lens on 36 mm film along the longer side of the image. Throws Error if the
// named camera is orthographic or the name is unknown; the message lists the known names.
PlacedCamera chooseCamera(const Scene& scene, const Pose& pose, const CameraChoice& choice, double aspect,
                          std::optional<double> tanHalfHorizontal = {});

// Returns the camera's matrix in another pose of the same scene; the default framing camera does not move.
glm::dmat4 worldFromCameraIn(const PlacedCamera& camera, const Pose& pose);

// Default directional light. The direction to the light is given in radians relative to the direction from the scene to
// the camera: `azimuth` to the camera's right, `elevation` upwards.
struct StudioLight {
    const char* name = "";
    double azimuth = 0;
    double elevation = 0;
    glm::vec3 color{1.0f};
    float illuminance = 1;       // illuminance in lux of a surface that faces the light
    double angularDiameter = 0;  // angular diameter of the light, rad
    // Returns the unit vector towards the light in camera axes: +x right, +y up, +z backwards.
    [[nodiscard]] glm::dvec3 toLight() const;
};
std::span<const StudioLight> studioLights();

// lightsOrDefault returns the pose's lights. If the pose has none, it returns key, fill and rim lights placed relative
// to the camera, or no lights if every drawn material is unlit or uniformly emissive. environmentOrDefault returns the
// scene's environment; without one, a soft sky. Under the default lights and sky, a surface of 18 % reflectance appears
// at 18 % of display white.
std::vector<PlacedLight> lightsOrDefault(const Scene& scene, const Pose& pose, const PlacedCamera& camera);
Environment environmentOrDefault(const Scene& scene);

// Returns the factor (≥ 1) by which the default sky's radiance is multiplied to match the scene's lights in this pose.
// With this factor, the sky gives the scene's centre a seventh of the lights' illuminance, as a clear sky does relative
// to the sun.
double skyScale(const Pose& pose);

}  // namespace defocus::engine
