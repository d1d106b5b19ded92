// The rays of each pixel. Pixels take turns at VARIANTS sets of rays, each of which is well spread over the lens and the pixel: in a
// square of 8 × 8 pixels, or fewer, each has another one, and squares take them in another order (src/render/lens_space/ray_sets.h).

struct Ray {
    vec4 lensAndPixel;   // lens point (u, k·v), or the way of a line over the lens; place in the pixel, px from its centre
    vec4 values;         // a point: x: time in the part of the exposure. A line: how far it reaches backwards, share of its light that
                         // passes forwards
};

layout(std430, binding = 6) readonly buffer RayBlock { Ray rays[]; };   // ray · VARIANTS + variant

layout(location = 0) uniform ivec2 imageSize;
layout(location = 1) uniform uint firstRay;   // of the wave

uint mixedBits(uint x) {   // the finaliser of MurmurHash3 (Appleby)
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

// The place of a pixel in the order of Bayer's matrix (1973), which keeps successive numbers apart, turned by its square's own bits.
uint variantOf(uvec2 pixel) {
    uint order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) {
        uint x = (pixel.x >> bit) & 1u;
        uint y = (pixel.y >> bit) & 1u;
        order |= ((x ^ y) << 1u | y) << (2u * (2u - bit));
    }
    return (order ^ mixedBits((pixel.x >> 3u) + mixedBits(pixel.y >> 3u))) & (VARIANTS - 1u);
}

// Ray `ray` of the wave.
Ray rayOf(uint ray, uvec2 pixel) { return rays[(firstRay + ray) * VARIANTS + variantOf(pixel)]; }

// In normalised device coordinates.
vec2 placeOf(Ray ray, uvec2 pixel) { return 2.0 * (vec2(pixel) + 0.5 + ray.lensAndPixel.zw) / vec2(imageSize) - 1.0; }
