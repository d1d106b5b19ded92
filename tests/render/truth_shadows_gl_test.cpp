// Compares soft sun shadows drawn by the GPU with those of the ray tracer.

#include "render/ball_shadows.h"

namespace defocus::engine {
namespace {

// With the same sample points on the lens and the sun, the GPU and the ray tracer give the same penumbrae, up to the
// size of shadow-map texels. A shadow map rounds the edge of a shadow to texels, differently in each sample. A bias
// also moves shadow-map lookups by part of a texel, which is visible where light grazes the ball of the test scene.
TEST_F(TruthOfShadows, rasteriserAndRayTracerSeeTheSamePenumbrae) {
    expectTheSameShadows(*ballBeforeAWall(), 64, 37);
}

}  // namespace
}  // namespace defocus::engine
