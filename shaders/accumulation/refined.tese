// Interpolates a vertex of the tessellated triangle from the triangle's corners.

layout(triangles, equal_spacing, ccw) in;

#include "include/surface_corners.glsl"
#include "include/surface_output.glsl"

in Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared[];

out Unsheared {
#include "include/unsheared_varyings.glsl"
} unshearedOut;

void main() {
    vec3 weights = gl_TessCoord;
    writeSurface(weightedSurface(weights));
    precise vec3 pinhole = weights.x * unsheared[0].pinhole + weights.y * unsheared[1].pinhole + weights.z * unsheared[2].pinhole;
    precise vec2 own = weights.x * unsheared[0].ownBlur + weights.y * unsheared[1].ownBlur + weights.z * unsheared[2].ownBlur;
    unshearedOut.pinhole = pinhole;
    unshearedOut.ownBlur = own;
    unshearedOut.lensAndJitter = unsheared[0].lensAndJitter;
    unshearedOut.bandShift = unsheared[0].bandShift;
    gl_Position = vec4(pinhole, 1.0);
}
