// Selects the layer of each triangle on drivers whose vertex shaders cannot write gl_Layer (no
// ARB_shader_viewport_layer_array).

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Sky {
#include "include/sky_varyings.glsl"
} corners[];

out Sky {
#include "include/sky_varyings.glsl"
} sky;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_Layer = int(corners[i].layer);
        sky.place = corners[i].place;
        sky.lensAndJitter = corners[i].lensAndJitter;
        sky.bandShift = corners[i].bandShift;
        sky.layer = corners[i].layer;
        EmitVertex();
    }
    EndPrimitive();
}
