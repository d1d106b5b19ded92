// Shades surfaces of one material from the attributes of their vertices.

struct Attributes {
    vec4 position;   // m from the camera along the world's axes
    vec4 normal;     // w: agreement
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
    vec4 uvRight;       // UV that the same lens point sees one pixel to the right; uvUp: one pixel up
    vec4 uvUp;
    vec3 normalRight;
    vec3 normalUp;
};
// Initialised, because functions above the assignment read it and drivers warn about uninitialised values.
Surface surface = Surface(vec4(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec4(0.0), vec4(0.0), 1.0, true, vec4(0.0), vec4(0.0), vec3(0.0),
                          vec3(0.0));

#include "include/material_textures.glsl"
#include "include/shading.glsl"
#include "include/surface_shading.glsl"

vec4 surfaceTexel(int unit, int slot) {
    return textureGrad(materialTextures[unit], uvOf(slot, surface.uv), uvOf(slot, surface.uvRight) - uvOf(slot, surface.uv),
                       uvOf(slot, surface.uvUp) - uvOf(slot, surface.uv));
}

// All samples of a block use the same sample number, whose pixel share is the mean of a frame's first 64 samples.
float sampleNumber() { return wave.firstOfBlock + 12.5; }

bool showsFront() { return surface.showsFront; }

float surfaceFootprint(vec3 normal) {
    vec3 right = normalize(surface.normalRight) - normal;
    vec3 up = normalize(surface.normalUp) - normal;
    return dot(right, right) + dot(up, up);
}
