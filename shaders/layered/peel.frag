// Depth peeling: shades surfaces behind the previously peeled layer. Also outputs their blur, its slope in the image,
// and their depth.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_light.glsl"

// surfaceOut of the previous layer; its w is 0 before the first layer, and < 0 if the previous layer has no surface.
layout(binding = 31) uniform sampler2DArray frontLayer;

// Signed blur (px) of the surface in this pixel, the blur's change per pixel to the right and up, and reversed depth.
layout(location = 1) out vec4 surfaceOut;
layout(location = 0) out vec4 layerOut;

const float steepest = 16.0;   // max change of blur (px) per pixel; surfaces seen almost edge-on exceed it

void peel() {
    float blur = circleOfConfusion(gl_FragCoord.z, ndcOfPixel(gl_FragCoord.xy, textureSize(frontLayer, 0).xy), surface.ownBlur);
    vec2 slope = clamp(vec2(dFdx(blur), dFdy(blur)), -steepest, steepest);
    vec4 front = texelFetch(frontLayer, ivec3(gl_FragCoord.xy, 0), 0);
    if (front.w != 0.0) {
        if (gl_FragCoord.z >= front.w) discard;   // front.w < 0: the pixel has no further surfaces
        // Discards surfaces in the umbra of the front surface, where they are hidden from the entire lens: for every
        // lens point the two surfaces are shifted by less than a pixel relative to each other.
        if (!blendedLayers && abs(blur - front.x) * (1.0 + abs(front.y) + abs(front.z)) < 1.0) discard;
    }
    surfaceOut = vec4(blur, slope, gl_FragCoord.z);
}

void main() {
    readSurface();
    peel();
    layerOut = surfaceLight();
}
