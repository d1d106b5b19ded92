// Shades a surface for one lens sample and writes it to the sample's layer.

#include "include/frame.glsl"
#if defined(TRANSMISSION) || defined(PEELED)
#include "include/lens.glsl"
#endif
#include "include/layer_format.glsl"
#include "include/environment.glsl"

#define SAMPLE_NUMBER (wave.firstSample + float(gl_Layer))
#include "include/shading.glsl"

in Surface {
#include "include/surface_varyings.glsl"
} surface;
flat in float ditherOffset;

layout(location = 0) out vec4 layerOut;

#ifdef PEELED
#include "layered/peel.glsl"
#elif defined(OWN_BLUR) && defined(READS_OWN_BLUR)
layout(location = 1) out vec4 ownBlurOut;
#endif

#ifdef LEVEL_COLOR_RANGE
// Min of the level's vertex colours.
layout(location = 0) uniform vec4 levelMin;
layout(location = 1) uniform vec4 levelMax;
#endif

// Clamps interpolated colours to the range of the corner values. Rasterizers round corners to a fraction of a pixel, so
// a very narrow triangle may cover pixels far outside its plane equations. Normals need no clamp, because only their
// direction counts. Texture coordinates need none, because steep ones select the smallest mip level.
vec4 surfaceColor() {
#if defined(VERTEX_COLOR_RANGES)
    return clamp(surface.color, surface.minColor, surface.maxColor);
#elif defined(LEVEL_COLOR_RANGE)
    return clamp(surface.color, material.baseColor * levelMin, material.baseColor * levelMax);
#else
    return surface.color;
#endif
}

#define SURFACE_TEXTURE(map, slot) texture(map, uvOf(slot, surface.uv))
#define SURFACE_SHOWS_FRONT gl_FrontFacing

float surfaceFootprint(vec3 normal) {
    vec3 right = dFdx(normal);   // of the surface normal: mip levels give the mean of normal maps
    vec3 up = dFdy(normal);
    return dot(right, right) + dot(up, up);
}

#ifdef TRANSMISSION
// This layer and the others, as they were before this object.
layout(binding = 17) uniform sampler2DArray backdrop;

vec2 ndcThroughLens(vec3 viewPosition) {
    vec4 clip = throughLens(pinholePosition(viewPosition), vec2(1.0, 0.0), vec4(surface.lens, 0.0, 0.0));
    return clip.xy / clip.w;
}

// Returns the colour seen through the surface at `offset` (m, along the world's axes). `roughness` in [0, 1] blurs it
// as in KHR_materials_transmission's sample viewer; 1 blurs over the whole image. Each lens sample shifts the square
// mip texels, so that they average out over the samples.
vec4 seenBehind(vec3 offset, float roughness) {
#ifdef CHROMATIC
    bandShift = surface.bandShift;
#endif
    ivec2 size = textureSize(backdrop, 0).xy;
    vec2 at = gl_FragCoord.xy / vec2(size);
    if (offset != vec3(0.0)) {
        mat3 worldFromView = mat3(frame.worldFromView);
        at += 0.5 * (ndcThroughLens((surface.position + offset) * worldFromView) - ndcThroughLens(surface.position * worldFromView));
    }
    float level = roughness * log2(float(size.x));
    at += (exp2(level) - 1.0) * (fract(vec2(1.0, 17.0) * ditherOffset) - 0.5) / vec2(size);
    return textureLod(backdrop, vec3(at, gl_Layer), level);
}
#endif

#include "include/surface_shading.glsl"

#ifdef SCREEN_DOOR
// Returns true if this pixel of a boundary sample draws the coarser level. The ordered dither is the R2 sequence x/ρ +
// y/ρ² modulo 1 with ρ³ = ρ + 1. Source: Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences. Integer
// arithmetic in units of 2⁻³² gives identical results on all devices. The chosen pixels are evenly spread; each object
// has its own offset.
bool drawsCoarser() {
    uvec2 pixel = uvec2(gl_FragCoord.xy + frame.window.xy);
    uint place = pixel.x * 3242174889u + pixel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return float(place >> 8) < object.values.y * 16777216.0;
}
#endif

void main() {
#ifdef PEELED
    peel();
#endif
#ifdef SCREEN_DOOR
    if (drawsCoarser() != SCREEN_DOOR) discard;
#endif
    vec4 baseColor = texturedColor(surfaceColor());
#ifdef ALPHA_MASK
    if (baseColor.a < material.emissiveCutoff.w) discard;
#endif
    vec3 radiance = surfaceRadiance(baseColor.rgb);
#ifdef TRANSMISSION
    vec4 light = vec4(radiance, surfaceCoverage);
#ifdef ALPHA_BLEND
    light = mix(texelFetch(backdrop, ivec3(gl_FragCoord.xy, gl_Layer), 0), light, baseColor.a);
#endif
#elif defined(ALPHA_BLEND)
    vec4 light = vec4(radiance * baseColor.a, baseColor.a);
#else
    vec4 light = vec4(radiance, 1.0);
#endif

#if defined(OWN_BLUR) && defined(READS_OWN_BLUR) && !defined(PEELED)
    ownBlurOut = vec4(surface.ownBlur, 0.0, 1.0);
#endif
    layerOut = light;
#ifdef LAYER_LARGEST
    layerOut.rgb = roundedToHalf(layerOut.rgb);
#endif
}
