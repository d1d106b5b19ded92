#pragma once
// Makes a scene that every method shades alike, ray tracers included: it is unlit and opaque, and a fixed light is
// painted on it. Then only geometry, visibility, the lens and its sampling can differ.

#include "scene/scene.h"

namespace defocus::engine {

// Each material becomes unlit and opaque and takes the mean colour of its texture. Lambert shading under one light,
// which is fixed to each mesh, goes into 8-bit vertex colours; the methods interpolate these linearly. Meshes, nodes,
// cameras and environment don't change.
Scene unlitScene(Scene scene);

}  // namespace defocus::engine
