// Computes pseudo-random thresholds. They decide in which pixels and lens samples a surface with alpha < 1 is drawn,
// and in which pixels the coarser of two levels of detail is drawn.

// Returns an evenly distributed number in [0, 2³²) for each pixel. `stream`: index or seed of the surface, which
// offsets the pattern. The pattern is the R2 sequence x/ρ + y/ρ² modulo 1 with ρ³ = ρ + 1, in units of 2⁻³² (Roberts
// 2018, The Unreasonable Effectiveness of Quasirandom Sequences). Integer arithmetic gives identical results on all
// devices.
uint pixelPattern(uvec2 pixel, uint stream) { return pixel.x * 3242174889u + pixel.y * 2447445414u + stream * 2654435769u; }

// Returns a fraction, given in units of 2⁻³², as a float in [0, 1).
float fractionOf(uint bits) { return float(bits >> 8) / 16777216.0; }

// Returns the threshold of the current object in a pixel. All lens samples have the same threshold.
float objectThreshold(uvec2 pixel) { return fractionOf(pixelPattern(pixel, uint(object.values.z))); }

#ifdef CHOOSES_BY_ALPHA
// Mixes the bits of an integer (fmix32 of MurmurHash3).
uint mixed(uint bits) {
    bits = (bits ^ (bits >> 16)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13)) * 0xc2b2ae35u;
    return bits ^ (bits >> 16);
}

// Returns the threshold for the alpha of this fragment. A lens sample shows the fragment if alpha exceeds the
// threshold. The samples' thresholds are the van der Corput sequence in a random order, so that the error of the mean
// falls as 1/N. The order differs between triangles and between front and back, so that overlapping surfaces are
// independent. Over neighbouring pixels, the thresholds of a triangle are evenly distributed.
float alphaThreshold(uvec2 pixel) {
    uint surfaceSeed = mixed(uint(object.values.z) * 0x9e3779b9u + uint(surface.facet) * 2u + uint(gl_FrontFacing));
    uint seed = mixed(surfaceSeed + pixel.x * 0x85ebca6bu + pixel.y * 0xc2b2ae35u);
    // Reverses the bits of the sample index (van der Corput) and scrambles them. In each aligned block of 2ᵏ samples,
    // each interval of length 2⁻ᵏ still contains one threshold (Laine and Karras 2011, Stratified Sampling for
    // Stochastic Transparency).
    uint order = bitfieldReverse(uint(surface.sampleNumber));
    order ^= order * 0x3d20adeau;
    order += seed;
    order *= (seed >> 16) | 1u;
    order ^= order * 0x05526c56u;
    order ^= order * 0x53a22864u;
    return fractionOf(order + pixelPattern(pixel, surfaceSeed));
}
#endif
