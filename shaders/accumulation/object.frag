// Shades one lens sample of a surface into its layer.

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

#ifdef LAYER_RGB9E5
layout(location = 0) out uint layerOut;
#else
layout(location = 0) out vec4 layerOut;
#endif

#ifdef PEELED
#include "layered/peel.glsl"
#elif defined(OWN_BLUR) && defined(READS_OWN_BLUR)
layout(location = 1) out vec4 ownBlurOut;
#endif

#ifdef LEVEL_COLOR_RANGE
layout(location = 0) uniform vec4 levelMin;   // what the level's vertices have
layout(location = 1) uniform vec4 levelMax;
#endif

// Rasterisers round corners to a fraction of a pixel, so a triangle that is narrower than that can cover a pixel far outside its own
// plane equations. What the corners have bounds what lies between them. Normals and directions need no bound, as only their way
// counts, and texture coordinates that run as fast pick the smallest mipmap.
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
    vec3 right = dFdx(normal);   // of the surface's: what a normal texture's mean is, its mipmaps say
    vec3 up = dFdy(normal);
    return dot(right, right) + dot(up, up);
}

#ifdef TRANSMISSION
layout(binding = 17) uniform sampler2DArray backdrop;   // this layer and the others, as they were before this object

vec2 ndcThroughLens(vec3 viewPosition) {
    vec4 clip = throughLens(pinholePosition(viewPosition), vec2(1.0, 0.0), vec4(surface.lens, 0.0, 0.0));
    return clip.xy / clip.w;
}

// What this pixel shows at `offset` (m, along the world's axes) behind the surface. `roughness` 0 … 1 spreads it, as
// KHR_materials_transmission's sample viewer does: 1 over the whole image. Mipmaps are made of squares; each lens sample shifts
// them within a square, so that their sum has none.
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
// Does this pixel of a boundary sample belong to the coarser level? Roberts 2018, The Unreasonable Effectiveness of
// Quasirandom Sequences: the R2 sequence as an ordered dither, x/ρ + y/ρ² modulo 1 with ρ³ = ρ + 1, in whole numbers
// of 2⁻³² and so the same on each device. Any share of the pixels is spread evenly; each object has its own offset.
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
#ifdef LAYER_RGB9E5
    layerOut = encodeLayer(light, ditherOffset);
#else
    layerOut = light;
#ifdef LAYER_LARGEST
    layerOut.rgb = roundedToHalf(layerOut.rgb);
#endif
#endif
}
