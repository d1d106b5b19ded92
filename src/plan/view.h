#pragma once
// Defines a view: camera, lens and image size for rendering a posed scene.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lens/lens.h"
#include "lod/pyramid/shared_pyramids.h"
#include "plan/render_settings.h"
#include "scene/defaults.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace defocus::engine {

struct View {
    glm::dmat4 worldFromCamera{1.0};  // rigid transform; the camera looks along its −z axis
    Lens lens;
    double nearPlane = 0.01;  // distance of the near plane in m, > 0
    int width = 1024;         // image width, px
    int height = 768;         // image height, px
    // worldFromCamera at each shutter time (see Shutter); empty if the camera doesn't move.
    std::vector<glm::dmat4> shutterCameras;
    std::map<std::string, double> methodValues;  // method settings that a shot animates: values by name
};

// Returns the view with a margin of `margin` px on each side. The pixels of the original view stay the same.
View withMargin(View view, int margin);

// Poses of the scene at the shutter times: the times within the exposure at which motion is sampled.
struct Shutter {
    std::vector<Pose> poses;  // for each shutter time, one pose of the scene; empty if the scene doesn't move
    // false: shutter times are evenly spaced from opening to closing, and vertices move linearly between them.
    // Munkberg, Toth and Akenine-Möller 2012 use one such linear segment. true: each lens sample has its own shutter
    // time, LensSample::time.
    bool perSample = false;
};

// A scene that is ready for planning: a pose, lights, environment and one pyramid per mesh.
struct World {
    std::shared_ptr<const Scene> scene;
    Pose pose;        // pose in the middle of the exposure
    Shutter shutter;  // poses during the exposure; lights and sky stay fixed at the middle of the exposure
    std::vector<PlacedLight> lights;
    Environment environment;
    SharedPyramids pyramids;  // one pyramid per mesh of the scene
};

}  // namespace defocus::engine
