// Interpolates the surface attributes of a triangle's corners, for tessellation and geometry shaders, which create
// vertices.

#include "include/surface.glsl"

in SurfaceVaryings {
#include "include/surface_varyings.glsl"
} corners[];

#define SURFACE_IN corners[corner]
#include "include/surface_read.glsl"

// Returns the surface interpolated between the three corners. On an edge (one weight is 0), both adjacent triangles
// obtain the same result.
Surface weightedSurface(vec3 weights) {
    Surface a = surfaceAt(0);
    Surface b = surfaceAt(1);
    Surface c = surfaceAt(2);
    Surface s = a;   // flat attributes come from the first corner
    s.color = weights.x * a.color + weights.y * b.color + weights.z * c.color;
    s.normal = weights.x * a.normal + weights.y * b.normal + weights.z * c.normal;
    s.agreement = weights.x * a.agreement + weights.y * b.agreement + weights.z * c.agreement;
    s.toEye = weights.x * a.toEye + weights.y * b.toEye + weights.z * c.toEye;
    s.position = weights.x * a.position + weights.y * b.position + weights.z * c.position;
    s.uv = weights.x * a.uv + weights.y * b.uv + weights.z * c.uv;
    s.tangent = weights.x * a.tangent + weights.y * b.tangent + weights.z * c.tangent;
    s.opening = weights.x * a.opening + weights.y * b.opening + weights.z * c.opening;
    s.closing = weights.x * a.closing + weights.y * b.closing + weights.z * c.closing;
    s.ownBlur = weights.x * a.ownBlur + weights.y * b.ownBlur + weights.z * c.ownBlur;
    return s;
}
