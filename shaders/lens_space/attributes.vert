// Kernel 1 of the lens-space methods: poses the vertices of a level of detail for transform feedback, and outputs their
// shading attributes.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/vertex.glsl"

layout(location = 0) uniform vec3 moment;   // index of a shutter time, fraction of the way to the next, time in [0, 1]

layout(xfb_buffer = 0, xfb_offset = 0) out vec4 positionOut;   // position relative to the camera, in m, world axes
// xyz: normal in world axes; w: length of the mesh's normal
layout(xfb_buffer = 0, xfb_offset = 16) out vec4 normalOut;
layout(xfb_buffer = 0, xfb_offset = 32) out vec4 colorOut;
layout(xfb_buffer = 0, xfb_offset = 48) out vec4 uvOut;        // texture coordinates of both UV sets
layout(xfb_buffer = 0, xfb_offset = 64) out vec4 tangentOut;

void main() {
    Posed view = vertexAt(moment, vec3(0.0)).view;
    mat3 worldFromView = mat3(frame.worldFromView);
    positionOut = vec4(worldFromView * view.position, 1.0);
    normalOut = vec4(worldFromView * view.normal, length(normalIn));
    colorOut = vertexColors ? colorIn : vec4(1.0);
    uvOut = vec4(uv0In, uv1In);
    tangentOut = vec4(worldFromView * view.tangent, tangentIn.w);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
