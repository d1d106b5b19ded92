// Picks the layer where the vertex shader may not (no ARB_shader_viewport_layer_array).

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Surface {
#include "include/surface_varyings.glsl"
} toGeometry[];
flat in vec2 ditherAndLayer[];

out Surface {
#include "include/surface_varyings.glsl"
} surface;
flat out float ditherOffset;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_Layer = int(ditherAndLayer[i].y);
        ditherOffset = ditherAndLayer[i].x;
        surface.color = toGeometry[i].color;
#ifndef UNLIT
        surface.normal = toGeometry[i].normal;
#ifdef COARSE_LEVEL
        surface.agreement = toGeometry[i].agreement;
#endif
        surface.toEye = toGeometry[i].toEye;
#endif
#if defined(LOCAL_LIGHTS)
        surface.position = toGeometry[i].position;
#endif
#ifdef TEXTURED
        surface.uv = toGeometry[i].uv;
#endif
#ifdef NORMAL_TEXTURE
        surface.tangent = toGeometry[i].tangent;
#endif
        EmitVertex();
    }
    EndPrimitive();
}
