// Interpolates a vertex of the tessellated triangle and applies the lens shear (include/lens.glsl). Used for triangles
// that lie beyond the near plane and in which the slope of the circle of confusion C never jumps; refined.geom cuts all
// other triangles.

layout(triangles, equal_spacing, ccw) in;

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/layer_choice.glsl"
#include "include/surface_corners.glsl"
#include "include/surface_output.glsl"

in Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared[];

void main() {
    vec3 weights = gl_TessCoord;
    Surface surface = weightedSurface(weights);
    writeSurface(surface);
    precise vec3 pinhole = weights.x * unsheared[0].pinhole + weights.y * unsheared[1].pinhole + weights.z * unsheared[2].pinhole;
    precise vec2 own = weights.x * unsheared[0].ownBlur + weights.y * unsheared[1].ownBlur + weights.z * unsheared[2].ownBlur;
    if (chromatic) bandShift = unsheared[0].bandShift;
    gl_Position = throughLens(pinhole, own, unsheared[0].lensAndJitter);
    chooseLayer(surface.layer);
}
