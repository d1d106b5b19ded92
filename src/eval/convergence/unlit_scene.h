#pragma once
// Converts a scene to unlit, opaque materials with baked lighting, which all methods, ray tracers included, shade
// alike. Images can then differ only by geometry, visibility, the lens and sampling.

#include "scene/scene.h"

namespace defocus::engine {

// Returns the scene with unlit, opaque materials. A surface's colour is the mean colour of its texture, times Lambert
// shading baked into vertex colours. If the mesh moves, the baked shading stays the same. Geometry, nodes, cameras and
// environment stay unchanged.
Scene unlitScene(Scene scene);

}  // namespace defocus::engine
