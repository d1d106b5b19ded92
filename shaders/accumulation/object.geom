// Selects the layer of each triangle on drivers whose vertex shaders cannot write gl_Layer (no
// ARB_shader_viewport_layer_array).

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

#include "include/surface_corners.glsl"
#include "include/surface_output.glsl"

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        Surface corner = surfaceAt(i);
        gl_Layer = int(corner.layer);
        writeSurface(corner);
        EmitVertex();
    }
    EndPrimitive();
}
