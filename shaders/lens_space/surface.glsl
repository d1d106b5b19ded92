// Shades surfaces of one material in compute shaders. Without a rasterizer, they must interpolate the vertex attributes
// in their own code.

struct Attributes {
    vec4 position;   // position relative to the camera, in m, world axes
    vec4 normal;     // w: length of the mesh's normal; 1 except in coarse levels of detail
    vec4 color;
    vec4 uv;
    vec4 tangent;
};

layout(std430, binding = 3) readonly buffer AttributeBlock { Attributes attributes[]; };

struct Surface {
    vec4 color;
    vec3 normal;
    vec3 toEye;
    vec3 position;
    vec4 uv;
    vec4 tangent;
    float agreement;
    bool showsFront;
    // UV at the right and upper edges of the texture filter's footprint, as seen from the ray's lens point.
    vec4 uvRight;
    vec4 uvUp;
    // Interpolated normals one pixel to the right and one pixel up, as seen from the ray's lens point.
    vec3 normalRight;
    vec3 normalUp;
};
// Initialised only to avoid driver warnings: functions read this variable before the source line that assigns it.
Surface surface = Surface(vec4(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec4(0.0), vec4(0.0), 1.0, true, vec4(0.0), vec4(0.0), vec3(0.0),
                          vec3(0.0));

#include "include/material_textures.glsl"
#include "include/shading.glsl"
#include "include/surface_shading.glsl"

vec4 surfaceTexel(int unit, int slot) {
    return textureGrad(materialTextures[unit], uvOf(slot, surface.uv), uvOf(slot, surface.uvRight) - uvOf(slot, surface.uv),
                       uvOf(slot, surface.uvUp) - uvOf(slot, surface.uv));
}

bool showsFront() { return surface.showsFront; }

void addNormalChanges(inout SurfacePoint point, vec3 normal) {
    point.normalRight = normalize(surface.normalRight) - normal;
    point.normalUp = normalize(surface.normalUp) - normal;
}
