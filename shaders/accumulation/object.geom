// Selects the layer on drivers without ARB_shader_viewport_layer_array, where the vertex shader cannot set it.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Surface {
#include "include/surface_varyings.glsl"
} corners[];
flat in vec2 ditherAndLayer[];

out Surface {
#include "include/surface_varyings.glsl"
} surface;
flat out float ditherOffset;

#define SURFACE_CORNERS corners
#define SURFACE_OUT surface
#include "include/surface_weighted.glsl"

void main() {
    const vec3 units[3] = vec3[3](vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_Layer = int(ditherAndLayer[i].y);
        ditherOffset = ditherAndLayer[i].x;
        writeSurface(units[i]);
        EmitVertex();
    }
    EndPrimitive();
}
