// Depth peeling: shades surfaces behind the last peeled layer and outputs their blur plane.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_light.glsl"

// Same content as surfaceOut. w: 0 before the first layer, < 0 if the last layer is empty.
layout(binding = 25) uniform sampler2DArray frontLayer;

// Plane of the surface in this pixel: signed blur (px), its change per pixel to the right and up, and reversed depth.
layout(location = 1) out vec4 surfaceOut;
layout(location = 0) out vec4 layerOut;

const float steepest = 16.0;   // px of blur per pixel; steeper surfaces are seen almost edge-on

void peel() {
    float blur = circleOfConfusion(gl_FragCoord.z, ndcOfPixel(gl_FragCoord.xy, textureSize(frontLayer, 0).xy), surface.ownBlur);
    vec2 slope = clamp(vec2(dFdx(blur), dFdy(blur)), -steepest, steepest);
    vec4 front = texelFetch(frontLayer, ivec3(gl_FragCoord.xy, 0), 0);
    if (front.w != 0.0) {
        if (gl_FragCoord.z >= front.w) discard;   // w = −1: no more surfaces
        // Discards surfaces in the umbra of the front pixel, which are hidden from the entire lens. The shifts of the
        // two surfaces differ by less than a pixel.
        if (!blendedLayers && abs(blur - front.x) * (1.0 + abs(front.y) + abs(front.z)) < 1.0) discard;
    }
    surfaceOut = vec4(blur, slope, gl_FragCoord.z);
}

void main() {
    readSurface();
    peel();
    layerOut = surfaceLight();
}
