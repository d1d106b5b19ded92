// Kernel 1 of the lens-space methods: poses the vertices of a level for transform feedback, and outputs their pinhole
// position and circle of confusion C.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/vertex.glsl"

layout(location = 0) uniform vec3 moment;   // index of a shutter time, fraction of the way to the next, time in [0, 1]

layout(xfb_buffer = 0, xfb_offset = 0) out vec4 clipOut;       // x, y, w of clip space; C

void main() {
    vec3 pinhole = vertexAt(moment, vec3(0.0)).pinhole;
    float c = frame.coc.x + frame.coc.y * pinhole.z;
    if (cocControls) {
        // The circle of confusion C is linear at and behind the near plane, because the lens-space methods reject
        // objects on which C has kinks there. Only w = 0 must be avoided.
        float w = pinhole.z == 0.0 ? 1e-20 : pinhole.z;
        c = w * relativeCircleOfConfusion(1.0 / w, pinhole.xy / w, vertexBlur(moment.z));
    }
    clipOut = vec4(pinhole, c);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
