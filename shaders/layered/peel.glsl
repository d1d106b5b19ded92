// Depth peeling for shaders/accumulation/object.frag: keeps what lies behind the layer that was peeled last, and says where.

layout(binding = 20) uniform sampler2DArray frontLayer;   // as surfaceOut; w: 0 before the first layer, < 0 where the last is empty

// Signed blur (px), how it grows from pixel to pixel to the right and up, and reversed depth: the plane of the surface in this
// pixel.
layout(location = 1) out vec4 surfaceOut;

const float steepest = 16.0;   // px of blur a pixel: edges seen almost from the side

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
        if (gl_FragCoord.z >= front.w) discard;   // also where nothing more lies: −1
#ifndef BLENDED
        // The umbra of a pixel that hides what lies behind it from the whole lens: images of the two move by less than a pixel
        // against each other.
        if (abs(blur - front.x) * (1.0 + abs(front.y) + abs(front.z)) < 1.0) discard;
#endif
    }
    surfaceOut = vec4(blur, slope, gl_FragCoord.z);
}
