// Depth peeling for shaders/accumulation/object.frag: keeps surfaces behind the last peeled layer and outputs their
// blur plane.

// Same content as surfaceOut. w: 0 before the first layer, < 0 if the last layer is empty.
layout(binding = 20) uniform sampler2DArray frontLayer;

// Plane of the surface in this pixel: signed blur (px), its change per pixel to the right and up, and reversed depth.
layout(location = 1) out vec4 surfaceOut;

const float steepest = 16.0;   // px of blur per pixel; steeper surfaces are seen almost edge-on

void peel() {
#ifdef OWN_BLUR
    vec2 own = surface.ownBlur;
#else
    const vec2 own = vec2(1.0, 0.0);
#endif
    float blur = circleOfConfusion(gl_FragCoord.z, ndcOfPixel(gl_FragCoord.xy, textureSize(frontLayer, 0).xy), own);
    vec2 slope = clamp(vec2(dFdx(blur), dFdy(blur)), -steepest, steepest);
    vec4 front = texelFetch(frontLayer, ivec3(gl_FragCoord.xy, 0), 0);
    if (front.w != 0.0) {
        if (gl_FragCoord.z >= front.w) discard;   // w = −1: no more surfaces
#ifndef BLENDED
        // Discards surfaces in the umbra of the front pixel, which are hidden from the entire lens. The shifts of the
        // two surfaces differ by less than a pixel.
        if (abs(blur - front.x) * (1.0 + abs(front.y) + abs(front.z)) < 1.0) discard;
#endif
    }
    surfaceOut = vec4(blur, slope, gl_FragCoord.z);
}
