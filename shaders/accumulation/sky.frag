// Draws the environment as seen by one lens sample.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/layer_format.glsl"
#include "include/environment.glsl"

in Sky {
#include "include/sky_varyings.glsl"
} sky;

layout(location = 0) out vec4 layerOut;

// Returns the view-space direction, not normalised, in which the lens sample sees the sky in this pixel. A fixed-point
// iteration finds the direction, because the circle of confusion at infinity may depend on the position in the pinhole
// image.
vec3 directionOfSky() {
    if (chromatic) bandShift = sky.bandShift;
    vec2 unblurred = sky.place - sky.lensAndJitter.zw;
    vec2 pinhole = unblurred - shiftThroughLens(0.0, unblurred, vec2(1.0, 0.0), sky.lensAndJitter.xy);
    if (cocControls)
        for (int i = 0; i < 3; ++i) pinhole = unblurred - shiftThroughLens(0.0, pinhole, vec2(1.0, 0.0), sky.lensAndJitter.xy);
    return vec3(pinhole / frame.projection.xy, -1.0);
}

void main() {
    vec3 direction = normalize(mat3(frame.worldFromView) * directionOfSky());
    layerOut = vec4(roundedToLayer(skyRadiance(environmentType, direction)), 1.0);
}
