// Looks up the rays of each pixel. There are rayVariants sets of rays. Each set contains all rays of one pixel, well
// distributed over lens and pixel. The pixels of a square of up to 8 × 8 pixels use different sets, in a different
// order in each square (src/render/lens_space/ray_sets.h). Each pixel also scrambles its samples (lens point, position
// in the pixel, time), so that no two pixels have the same samples.

struct Ray {
    // xy: for a point sample, the lens point (u, k·v), where k is the image's aspect ratio; for a line sample (a line
    // through the lens centre), the vector along the line from the centre to the lens's rim. zw: position in px
    // relative to the pixel's centre.
    vec4 lensAndPixel;
    // Point sample: x is the time within the current part of the exposure, [0, 1]. Line sample: the line's points are
    // p · lensAndPixel.xy, with p from −x to 1. y is the fraction of the line's light that passes through its part with
    // p > 0. Each visible segment is shaded at one or more points, each in a piece of its own (writeRecords in
    // shaders/line/visible.glsl). z, in [0, 1), is the fraction of a piece's light before its shading point; if
    // areaWeights is false, of its length. If shadingStep is 0, z is ignored and the segment's middle is shaded.
    vec4 values;
};

layout(std430, binding = 6) readonly buffer RayBlock { Ray rays[]; };   // ray r of set s has index r · rayVariants + s

layout(location = 0) uniform ivec2 imageSize;
layout(location = 1) uniform uint firstRay;   // index of the first ray of the current batch (wave)

uint mixedBits(uint x) {   // finaliser of MurmurHash3 (Appleby)
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

// Returns the index of the set of rays that a pixel uses. Within a square of 8 × 8 pixels, Bayer's matrix (1973)
// assigns successive sets to distant pixels. In each square, random bits of the index are flipped.
uint variantOf(uvec2 pixel) {
    uint order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) {
        uint x = (pixel.x >> bit) & 1u;
        uint y = (pixel.y >> bit) & 1u;
        order |= ((x ^ y) << 1u | y) << (2u * (2u - bit));
    }
    return (order ^ mixedBits((pixel.x >> 3u) + mixedBits(pixel.y >> 3u))) & (rayVariants - 1u);
}

// Returns `x` in [0, 1) with bits flipped by `flips` (digital shift; Kollig and Keller 2002, Efficient Multidimensional
// Sampling). The shift keeps the stratification of (t, m, s)-nets in base 2.
float shifted(float x, uint flips) { return float(min(uint(x * 16777216.0), 16777215u) ^ (flips >> 8)) / 16777216.0; }

// Returns ray number `ray`, counted from firstRay, of a pixel. In all sets of rays, the rays with equal numbers pass
// through nearly the same small part of the lens. A point sample can therefore take its lens point from a randomly
// chosen set.
Ray rayOf(uint ray, uvec2 pixel) {
    uint first = (firstRay + ray) * rayVariants;
    Ray own = rays[first + variantOf(pixel)];
    if (lineSamples) return own;
    uint bits = mixedBits(pixel.x + mixedBits(pixel.y + 0x9e3779b9u));
    own.lensAndPixel.xy = rays[first + (mixedBits(bits + firstRay + ray) & (rayVariants - 1u))].lensAndPixel.xy;
    own.lensAndPixel.z = shifted(own.lensAndPixel.z + 0.5, mixedBits(bits + 0x85157af5u)) - 0.5;
    own.lensAndPixel.w = shifted(own.lensAndPixel.w + 0.5, mixedBits(bits + 0xd3833e80u)) - 0.5;
    own.values.x = shifted(own.values.x, mixedBits(bits + 0x4f1bbcddu));
    return own;
}

// Returns the image position of a pixel's ray, in normalised device coordinates.
vec2 placeOf(Ray ray, uvec2 pixel) { return 2.0 * (vec2(pixel) + 0.5 + ray.lensAndPixel.zw) / vec2(imageSize) - 1.0; }
