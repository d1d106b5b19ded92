#pragma once
// A view: from where, through which lens, at which size a posed scene is rendered.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "defocus/settings.h"
#include "lens/lens.h"
#include "lens/sequences.h"
#include "lod/pyramid/level_selection.h"
#include "scene/defaults.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace defocus {

struct View {
    glm::dmat4 worldFromCamera{1.0};  // rigid; the camera looks along its −z
    Lens lens;
    double nearPlane = 0.01;  // m, > 0
    int width = 1024;         // px
    int height = 768;         // px
    // worldFromCamera at the moments of World::shutter, as many as it has poses; empty: the camera stands still.
    std::vector<glm::dmat4> shutterCameras;
};

// What the scene does while the shutter is open.
struct Shutter {
    std::vector<Pose> poses;  // the same objects as World::pose; empty: the scene stands still
    // false: the moments are evenly spaced, opening and closing included, and vertices move in straight lines from one
    // to the next (Munkberg, Toth and Akenine-Möller 2012, with one such step); true: one moment a lens sample, at its
    // LensSample::time.
    bool perSample = false;
};

// A scene ready to be planned: posed, lit, with one pyramid a mesh.
struct World {
    std::shared_ptr<const Scene> scene;
    Pose pose;        // in the middle of the exposure
    Shutter shutter;  // lights and sky stay as they are in its middle
    std::vector<PlacedLight> lights;
    Environment environment;
    std::vector<Pyramid> pyramids;  // one a mesh of the scene
};

// A scene that its caller keeps alive for as long as the world.
inline std::shared_ptr<const Scene> borrowed(const Scene& scene) {
    return {std::shared_ptr<const void>(), &scene};
}

}  // namespace defocus
