// Evaluates a vertex of the tessellated triangle.

layout(triangles, equal_spacing, ccw) in;

in Surface {
#include "include/surface_varyings.glsl"
} corners[];
in Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared[];

out Surface {
#include "include/surface_varyings.glsl"
} toNext;
out Unsheared {
#include "include/unsheared_varyings.glsl"
} unshearedOut;

#define SURFACE_CORNERS corners
#define SURFACE_OUT toNext
#include "include/surface_weighted.glsl"

void main() {
    vec3 weights = gl_TessCoord;
    writeSurface(weights);
    precise vec3 pinhole = weights.x * unsheared[0].pinhole + weights.y * unsheared[1].pinhole + weights.z * unsheared[2].pinhole;
    precise vec2 own = weights.x * unsheared[0].ownBlur + weights.y * unsheared[1].ownBlur + weights.z * unsheared[2].ownBlur;
    unshearedOut.pinhole = pinhole;
    unshearedOut.ownBlur = own;
    unshearedOut.lensAndJitter = unsheared[0].lensAndJitter;
    unshearedOut.ditherAndLayer = unsheared[0].ditherAndLayer;
    unshearedOut.bandShift = unsheared[0].bandShift;
    gl_Position = vec4(pinhole, 1.0);
}
