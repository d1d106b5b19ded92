// Reads the interpolated attributes of the fragment's surface into the global variable `surface`. main() must call
// readSurface() first.

#include "include/surface.glsl"

in SurfaceVaryings {
#include "include/surface_varyings.glsl"
} varyings;

#define SURFACE_IN varyings
#include "include/surface_read.glsl"

Surface surface;

void readSurface() { surface = surfaceAt(0); }
