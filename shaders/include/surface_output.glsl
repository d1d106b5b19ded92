// The varyings that a stage passes on.

out SurfaceVaryings {
#include "include/surface_varyings.glsl"
} passedOn;

#define SURFACE_OUT passedOn
#include "include/surface_write.glsl"
