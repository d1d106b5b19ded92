// Traces one lens sample: outputs, for each pixel, the nearest surface over all layers that its lens ray hits.
//
// A surface of signed blur c px (diameter) at position q of the pinhole image appears in pixel p through the lens point
// (u, v) if q = p − c/2·(u, v). The ray is therefore a line in the pinhole image, with the parameter c. In each pixel
// of a layer the surface is a plane, c = c₀ + slope·(q − centre). The ray hits the plane if it enters the pixel on one
// side of the plane (in front or behind) and leaves the pixel on the other side.
//
// Neighbouring pixels whose planes differ by less than a pixel of blur form one surface without a gap between them.
// Rays start at a random position in their pixel, which smooths blurred surfaces and does not affect focused ones.
#include "include/frame.glsl"
#include "include/layer_format.glsl"

in Sky {
#include "include/sky_varyings.glsl"
} sky;

layout(binding = 0) uniform sampler2DArray layerColors;     // premultiplied colours of the depth layers
layout(binding = 1) uniform sampler2DArray layerSurfaces;   // surfaceOut of layered/peel.frag
layout(binding = 2) uniform sampler2DArray layerReach;      // min and max blur that each pixel's rays may meet
layout(location = 0) uniform int layerCount;
layout(location = 1) uniform int border;                    // border in px by which the layers extend beyond the image
layout(location = 2) uniform vec2 pinhole;                  // subpixel position (px) at which the layers were drawn

layout(location = 0) out vec4 layerOut;

const float rounded = 0.05;   // tolerance for rounding errors where a ray hits a surface, in px of blur diameter
// Two neighbouring pixels show one surface if the blur diameters of their planes differ by less than this (px) at the
// pixels' common border.
const float oneSurface = 1.0;
const int maxSurfaces = blendedLayers ? 16 : 1;

struct Hit {
    float depth;   // reversed depth; < 0: no hit
    float end;     // position along the ray, measured as signed blur (px), at which the ray leaves the hit's pixel
    ivec3 texel;
};

// A ray as a line in the pinhole image, parameterised by the signed blur of the surfaces that it meets.
struct Ray {
    vec2 start;      // position in px where the ray crosses the focus plane (blur 0)
    vec2 slope;      // change of position in px per px of blur
    vec2 perSlope;   // 1 / slope, for x and y
    float shift;     // blur in px that is added to all surfaces
};

vec2 placeAt(Ray ray, float blur) { return ray.start + blur * ray.slope; }

// Updates `hit` if the ray meets a nearer surface in this layer. Only surfaces behind the reversed depth `limit` are
// considered.
void traceLayer(Ray ray, int layer, float limit, inout Hit hit) {
    vec2 reach = texelFetch(layerReach, ivec3(gl_FragCoord.xy, layer), 0).xy + vec2(-rounded, rounded) + ray.shift;
    // Blur grows with depth along the ray, so surfaces with more blur than hit.end are farther away than `hit`. This
    // does not hold if surfaces modify their blur.
    if (!usesOwnBlur) reach.y = min(reach.y, hit.end);
    ivec2 size = textureSize(layerSurfaces, 0).xy;
    vec2 toFirst = -ray.start * ray.perSlope;
    vec2 toLast = (vec2(size) - ray.start) * ray.perSlope;
    vec2 enters = min(toFirst, toLast);
    vec2 leaves = max(toFirst, toLast);
    reach = vec2(max(reach.x, max(enters.x, enters.y)), min(reach.y, min(leaves.x, leaves.y)));
    if (reach.x > reach.y) return;

    ivec2 forward = ivec2(ray.slope.x < 0.0 ? -1 : 1, ray.slope.y < 0.0 ? -1 : 1);
    ivec2 texel = clamp(ivec2(floor(placeAt(ray, reach.x))), ivec2(0), size - 1);
    float begin = reach.x;
    bool connected = false;   // true if the previous pixel on the ray has a surface, which this pixel may continue
    float before = 0.0;       // how far the ray was behind the surface, in px of blur, when it left the previous pixel
    while (true) {
        vec2 ends = (vec2(texel + max(forward, 0)) - ray.start) * ray.perSlope;
        float end = min(min(ends.x, ends.y), reach.y);
        vec4 surface = texelFetch(layerSurfaces, ivec3(texel, layer), 0);
        bool there = surface.w >= 0.0 && surface.w < limit;
        if (there) {
            vec2 centre = vec2(texel) + 0.5;
            float behindFirst = begin - ray.shift - surface.x - dot(surface.yz, placeAt(ray, begin) - centre);
            float behindLast = end - ray.shift - surface.x - dot(surface.yz, placeAt(ray, end) - centre);
            bool meets = min(behindFirst, behindLast) <= rounded && max(behindFirst, behindLast) >= -rounded;
            bool between = connected && before * behindFirst < 0.0 && abs(before - behindFirst) < oneSurface;
            if ((meets || between) && surface.w > hit.depth) {
                hit = Hit(surface.w, end, ivec3(texel, layer));
                if (!usesOwnBlur) return;
            }
            before = behindLast;
        }
        connected = there;
        if (end >= reach.y) return;
        begin = end;
        if (ends.x < ends.y)
            texel.x += forward.x;
        else
            texel.y += forward.y;
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) return;
    }
}

void main() {
    vec2 lens = vec2(sky.lensAndJitter.x, sky.lensAndJitter.y * frame.window.w / frame.window.z);
    vec2 inPixel = -0.5 * sky.lensAndJitter.zw * frame.window.zw - pinhole;
    // The clamp leaves a margin for rounding errors, so that each ray crosses the focus plane inside the pixel where it
    // starts.
    vec2 start = gl_FragCoord.xy + vec2(border) + clamp(inPixel, -0.47, 0.47);
    vec2 slope = -0.5 * lens;
    vec2 perSlope = vec2(abs(slope.x) > 1e-9 ? 1.0 / slope.x : 1e9, abs(slope.y) > 1e-9 ? 1.0 / slope.y : 1e9);
    Ray ray = Ray(start, slope, perSlope, sky.bandShift * frame.coc.z);

    vec4 light = vec4(0.0);
    float limit = 2.0;
    for (int n = 0; n < maxSurfaces; ++n) {
        Hit hit = Hit(-1.0, 1e30, ivec3(0));
        for (int layer = 0; layer < layerCount; ++layer) traceLayer(ray, layer, limit, hit);
        if (hit.depth < 0.0) break;
        light += (1.0 - light.a) * texelFetch(layerColors, hit.texel, 0);
        if (light.a > 0.999) break;
        limit = hit.depth;
    }
    layerOut = vec4(roundedToLayer(light.rgb), light.a);
}
