// Soft shadows of the sun on the GPU against the ray tracer.

#include "render/ball_shadows.h"

namespace defocus::engine {
namespace {

// With the same points on lens and sun, the images differ only by shadow-map texels. Maps round a shadow's edge to
// different texels in each sample. They also lift lookups by part of a texel, which shows where light grazes the ball.
TEST_F(TruthOfShadows, rasteriserAndRayTracerSeeTheSamePenumbrae) {
    expectTheSameShadows(*ballBeforeAWall(), 64, 37);
}

}  // namespace
}  // namespace defocus::engine
