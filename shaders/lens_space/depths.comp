// Computes each triangle's min depth w over time. The bits of the depth are stored as an integer, because they sort
// like the depth. The result is 0 if the triangle extends in front of the near plane.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/triangles.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 6) writeonly buffer DepthBlock { uint depths[]; };

layout(location = 0) uniform uint triangleCount;

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= triangleCount) return;
    float minimum = minDepthOf(triangles[index].xyz);
    depths[index] = minimum < frame.projection.z ? 0u : floatBitsToUint(minimum);
}
