// Tests of soft shadows of the sun on the GPU against the ray tracer.

#include "render/ball_shadows.h"

namespace defocus::engine {
namespace {

// With the same points on lens and sun, both renderers give the same penumbrae, up to shadow-map texels. In each
// sample, a map rounds a shadow's edge to different texels. Maps also lift lookups by part of a texel, which shows
// where light grazes the ball.
TEST_F(TruthOfShadows, rasteriserAndRayTracerSeeTheSamePenumbrae) {
    expectTheSameShadows(*ballBeforeAWall(), 64, 37);
}

}  // namespace
}  // namespace defocus::engine
