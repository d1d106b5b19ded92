// Kernel 1 of the lens-space methods: poses the vertices of a level of detail for transform feedback, and outputs their
// pinhole position and circle of confusion C.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/vertex.glsl"
#include "lens_space/clip_blur.glsl"

// x: index of a shutter time; y: fraction of the way to the next; z: time in the exposure, [0, 1]
layout(location = 0) uniform vec3 moment;

layout(xfb_buffer = 0, xfb_offset = 0) out vec4 clipOut;       // x, y, w in clip space, and the signed CoC C
#ifdef PASSES_OWN_BLUR
layout(xfb_buffer = 1, xfb_offset = 0) out vec2 ownBlurOut;    // the vertex's blur modifiers (include/lens.glsl)
#endif

void main() {
    vec3 pinhole = vertexAt(moment, vec3(0.0)).pinhole;
    vec2 own = vertexBlur(moment.z);
#ifdef PASSES_OWN_BLUR
    ownBlurOut = own;
#endif
    clipOut = vec4(pinhole, clipBlur(pinhole, own));
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
