// Draws a triangle at infinite depth over each sample's layer, so that uncovered pixels show the environment.
#ifdef VERTEX_LAYER
#extension GL_ARB_shader_viewport_layer_array : enable
#extension GL_AMD_vertex_shader_layer : enable
#endif

#include "include/frame.glsl"

layout(location = 6) in vec4 lensAndJitterIn;
layout(location = 7) in vec4 eyeAndDitherIn;
#ifdef CHROMATIC
layout(location = 14) in float bandShiftIn;
#else
const float bandShiftIn = 0.0;
#endif

#ifdef VERTEX_LAYER
out vec2 place;                // in normalised device coordinates
flat out vec4 lensAndJitter;
flat out float skyBandShift;
#else
flat out vec4 lensAndJitterToGeometry;
flat out float bandShiftToGeometry;
flat out int layerToGeometry;
#endif

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    gl_Position = vec4(corner, 0.0, 1.0);  // reversed depth: 0 is infinity
#ifdef VERTEX_LAYER
    place = corner;
    lensAndJitter = lensAndJitterIn;
    skyBandShift = bandShiftIn;
    gl_Layer = int(eyeAndDitherIn.w);
#else
    lensAndJitterToGeometry = lensAndJitterIn;
    bandShiftToGeometry = bandShiftIn;
    layerToGeometry = int(eyeAndDitherIn.w);
#endif
}
