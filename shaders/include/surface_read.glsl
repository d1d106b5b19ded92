// Returns the surface read from its varyings. The macro SURFACE_IN is an expression for the varyings' block; it may use
// `corner`, the index of a corner of the triangle. Attributes that the material doesn't need are 0, except the blur
// modifiers ownBlur, which are then (1, 0): factor 1 and no added blur.

#define ATTRIBUTE(type, name) s.name = SURFACE_IN.name;
Surface surfaceAt(int corner) {
    Surface s = Surface(vec4(0.0), vec4(0.0), vec4(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec2(0.0), 0.0, vec4(0.0),
                        vec4(0.0), vec2(1.0, 0.0), 0, 0.0, 0.0, vec3(0.0), vec3(0.0));
#include "include/surface_attributes.glsl"
    return s;
}
#undef ATTRIBUTE
