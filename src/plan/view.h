#pragma once
// A view says from where, through which lens and at which size a posed scene is rendered.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lens/lens.h"
#include "plan/render_settings.h"
#include "scene/defaults.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace defocus::engine {

struct View {
    glm::dmat4 worldFromCamera{1.0};  // a rigid transform; the camera looks along its −z axis
    Lens lens;
    double nearPlane = 0.01;  // m, > 0
    int width = 1024;         // px
    int height = 768;         // px
    // worldFromCamera at each moment of World::shutter; empty if the camera doesn't move.
    std::vector<glm::dmat4> shutterCameras;
    std::map<std::string, double> methodValues;  // of the method's settings, by name, where a shot gives them keys
};

// The poses of the scene while the shutter is open.
struct Shutter {
    std::vector<Pose> poses;  // they have the same objects as World::pose; empty if the scene doesn't move
    // false: the moments are evenly spaced, from opening to closing, and vertices move in straight lines from one to
    // the next (Munkberg, Toth and Akenine-Möller 2012 have one such line). true: each lens sample has a moment of its
    // own, at its LensSample::time.
    bool perSample = false;
};

// A scene that is ready to be planned: it has a pose, lights and one pyramid for each mesh.
struct World {
    std::shared_ptr<const Scene> scene;
    Pose pose;        // in the middle of the exposure
    Shutter shutter;  // lights and sky keep their state from the middle of the exposure
    std::vector<PlacedLight> lights;
    Environment environment;
    std::vector<Pyramid> pyramids;  // one for each mesh of the scene
};

}  // namespace defocus::engine
