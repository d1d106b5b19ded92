// Members of the interface block SurfaceVaryings.

#define ATTRIBUTE(type, name) type name;
#include "include/surface_attributes.glsl"
#undef ATTRIBUTE
