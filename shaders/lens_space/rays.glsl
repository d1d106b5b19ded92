// Rays of each pixel. There are rayVariants sets of rays, each well distributed over lens and pixel. Pixels of a square of
// up to 8 × 8 pixels use different sets, and each square has its own order (src/render/lens_space/ray_sets.h).

struct Ray {
    // Lens point (u, k·v), or the direction of a line over the lens; then the position in the pixel, in px from its
    // centre.
    vec4 lensAndPixel;
    // Point: x is the time in the part of the exposure. Line: its backward extent, and the share of its light that
    // passes forwards.
    vec4 values;
};

layout(std430, binding = 6) readonly buffer RayBlock { Ray rays[]; };   // ray · rayVariants + variant

layout(location = 0) uniform ivec2 imageSize;
layout(location = 1) uniform uint firstRay;   // first ray of the wave

uint mixedBits(uint x) {   // finaliser of MurmurHash3 (Appleby)
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

// Returns the ray set of a pixel. Bayer's matrix (1973) separates successive sets, and each square flips the index with
// its own bits.
uint variantOf(uvec2 pixel) {
    uint order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) {
        uint x = (pixel.x >> bit) & 1u;
        uint y = (pixel.y >> bit) & 1u;
        order |= ((x ^ y) << 1u | y) << (2u * (2u - bit));
    }
    return (order ^ mixedBits((pixel.x >> 3u) + mixedBits(pixel.y >> 3u))) & (rayVariants - 1u);
}

// Returns ray `ray` of the wave.
Ray rayOf(uint ray, uvec2 pixel) { return rays[(firstRay + ray) * rayVariants + variantOf(pixel)]; }

// Returns the ray's position in the image, in normalised device coordinates.
vec2 placeOf(Ray ray, uvec2 pixel) { return 2.0 * (vec2(pixel) + 0.5 + ray.lensAndPixel.zw) / vec2(imageSize) - 1.0; }
