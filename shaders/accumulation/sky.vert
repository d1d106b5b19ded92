// Draws a triangle at infinite depth over the layer of each lens sample, so that the environment fills pixels without a
// surface.

#include "include/layer_choice.glsl"

layout(location = 6) in vec4 lensAndJitterIn;
layout(location = 7) in vec4 eyeAndSampleIn;
layout(location = 14) in float bandShiftIn;

out Sky {
#include "include/sky_varyings.glsl"
} sky;

void main() {
    sky.place = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    sky.lensAndJitter = lensAndJitterIn;
    sky.bandShift = chromatic ? bandShiftIn : 0.0;
    sky.layer = eyeAndSampleIn.w;
    gl_Position = vec4(sky.place, 0.0, 1.0);  // reversed depth: 0 is infinity
    chooseLayer(sky.layer);
}
