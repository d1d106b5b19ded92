// Tests soft shadows of lamps on the GPU against the ray tracer.

#include "render/ball_shadows.h"

namespace defocus::engine {
namespace {

// Disk-shaped lamps cast the same penumbrae on the GPU as in the ray tracer, on average over the samples. Single
// samples differ, because the disks face each lit point in the ray tracer, but the scene's centre on the GPU. A lamp
// without a cone has wider shadow-map texels, so its PSNR bound is lower.
TEST_F(TruthOfShadows, lampsThrowTheSamePenumbrae) {
    for (const LightType type : {LightType::point, LightType::spot}) {
        const auto small = ballBeforeAWall();
        PlacedLight lamp;
        lamp.light.type = type;
        lamp.light.intensity = 20;
        lamp.light.radius = 0.15f;
        lamp.light.innerConeAngle = 0.5f;
        lamp.light.outerConeAngle = 0.7f;
        lamp.position = {2, 1, -1.5};
        lamp.direction = glm::normalize(glm::dvec3(0, 0, -4.5) - lamp.position);
        small->world.lights = {lamp};
        expectTheSameShadows(*small, 256, type == LightType::spot ? 35 : 29.5);
    }
}

}  // namespace
}  // namespace defocus::engine
