#pragma once
// A scene that every method shades alike, ray tracers too: unlit and opaque, with a fixed light painted on. What is
// left to compare is geometry, visibility, the lens and its sampling.

#include "scene/scene.h"

namespace defocus {

// Each material becomes unlit and opaque and takes the mean colour of its texture; Lambert shading under one light,
// fixed to each mesh, goes into 8-bit vertex colours, which methods interpolate linearly. Meshes, nodes, cameras and
// surroundings stay.
Scene unlitScene(Scene scene);

}  // namespace defocus
