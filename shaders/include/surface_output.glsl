// Declares the output varyings of a stage before the fragment stage, and writeSurface(), which sets them.

out SurfaceVaryings {
#include "include/surface_varyings.glsl"
} passedOn;

#define SURFACE_OUT passedOn
#include "include/surface_write.glsl"
