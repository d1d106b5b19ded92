#pragma once
// Makes a scene that every method shades alike, ray tracers included: unlit and opaque, with baked lighting. Images can
// then differ only by geometry, visibility, the lens and its sampling.

#include "scene/scene.h"

namespace defocus::engine {

// Returns the scene with unlit, opaque materials in the mean colours of their textures. Lambert shading by one light,
// fixed to each mesh, is baked into vertex colours. Geometry, nodes, cameras and environment don't change.
Scene unlitScene(Scene scene);

}  // namespace defocus::engine
