// Kernel 1 of the lens-space methods: poses the vertices of a level for transform feedback, and outputs their pinhole
// position and C.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/vertex.glsl"

layout(location = 0) uniform vec3 moment;   // as in vertexAt()

layout(xfb_buffer = 0, xfb_offset = 0) out vec4 clipOut;       // x, y, w of clip space; C

void main() {
    vec3 pinhole = vertexAt(moment, vec3(0.0)).pinhole;
    float c = frame.coc.x + frame.coc.y * pinhole.z;
    if (cocControls) {
        // Vertices at the near plane have one linear C, because the methods reject objects with a kinked C there.
        float w = pinhole.z == 0.0 ? 1e-20 : pinhole.z;
        c = w * relativeCircleOfConfusion(1.0 / w, pinhole.xy / w, vertexBlur(moment.z));
    }
    clipOut = vec4(pinhole, c);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
