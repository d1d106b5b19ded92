#pragma once
// What a file leaves out: a camera that frames the scene, a soft three-light set-up and a sky.

#include <glm/mat4x4.hpp>
#include <span>

#include "defocus/camera.h"
#include "scene/pose.h"

namespace defocus::engine {

struct PlacedCamera {
    Camera camera;
    glm::dmat4 worldFromCamera{1.0};  // no scale
    int node = -1;                    // that carries it; −1: it frames the scene
};

// Returns the chosen camera; a NamedCamera has the camera's or its node's name, and FirstCamera skips orthographic
// cameras. A camera that frames the scene shows `pose.bounds` from a three-quarter view at the given image aspect
// (width / height) and has a fitting focusDistance and znear. Throws Error for an unknown name, listing the known ones,
// and for orthographic cameras.
PlacedCamera chooseCamera(const Scene& scene, const Pose& pose, const CameraChoice& choice, double aspect);

// Where the camera is in another pose of its scene; one that frames the scene stays where it is.
glm::dmat4 worldFromCameraIn(const PlacedCamera& camera, const Pose& pose);

// A directional light of scenes without any. It stands `azimuth` to the right of the camera and `elevation` above it,
// as seen from the scene (rad).
struct StudioLight {
    const char* name = "";
    double azimuth = 0;
    double elevation = 0;
    glm::vec3 color{1.0f};
    float illuminance = 1;       // lux
    double angularDiameter = 0;  // rad, of the softbox
    // Unit, along the camera's right, up and back.
    [[nodiscard]] glm::dvec3 toLight() const;
};
std::span<const StudioLight> studioLights();

// The scene's own lights. Without any: directional key, fill and rim lights as seen from the camera, unless all that is
// drawn is unlit or glows evenly. And its environment, or a soft sky; the two together show a grey card of 18 % at 18 %
// of white.
std::vector<PlacedLight> lightsOrDefault(const Scene& scene, const Pose& pose, const PlacedCamera& camera);
Environment environmentOrDefault(const Scene& scene);

// The factor on the radiance of the sky that lightsOrDefault's studio was made for, so that it fits the scene's own
// lights where these are brighter: as shadows under the sun get light from a sky, it gives the scene's middle a
// seventh of what they do. 1 at least.
double skyScale(const Pose& pose);

}  // namespace defocus::engine
