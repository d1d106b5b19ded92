// Writes the attributes of the surface `s` to the varyings SURFACE_OUT.

#define ATTRIBUTE(type, name) SURFACE_OUT.name = s.name;
void writeSurface(Surface s) {
#include "include/surface_attributes.glsl"
}
#undef ATTRIBUTE
