// Surfaces of one material, shaded from the attributes of their vertices.

// All samples of a block are shaded alike: as the one whose share of a pixel is the mean of a frame's first 64.
#define SAMPLE_NUMBER (wave.firstOfBlock + 12.5)
#include "include/shading.glsl"

struct Attributes {
    vec4 position;   // from the camera along the world's axes, m
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
    vec4 uvRight;       // where the same lens point sees it a pixel to the right, and one up
    vec4 uvUp;
    vec3 normalRight;
    vec3 normalUp;
};
// Functions above those that fill it in read it, and drivers warn of what has no value.
Surface surface = Surface(vec4(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec4(0.0), vec4(0.0), 1.0, true, vec4(0.0), vec4(0.0), vec3(0.0),
                          vec3(0.0));

#define SURFACE_TEXTURE(map, slot)                                                                                 \
    textureGrad(map, uvOf(slot, surface.uv), uvOf(slot, surface.uvRight) - uvOf(slot, surface.uv),                 \
                uvOf(slot, surface.uvUp) - uvOf(slot, surface.uv))
#define SURFACE_SHOWS_FRONT surface.showsFront

float surfaceFootprint(vec3 normal) {
    vec3 right = normalize(surface.normalRight) - normal;
    vec3 up = normalize(surface.normalUp) - normal;
    return dot(right, right) + dot(up, up);
}

#include "include/surface_shading.glsl"
