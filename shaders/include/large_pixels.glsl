// Layers whose pixels are `rate` times larger (frame.glsl's pixelGrid): the four around a pixel of the image, for linear interpolation.
// Such a layer has one more pixel on all sides.

struct LargePixels {
    ivec2 texel;    // the lower left one
    vec4 weights;   // of it, its right, its upper and its upper right neighbour
};

LargePixels largePixels(ivec2 pixel, float rate) {
    vec2 at = (vec2(pixel) + 0.5) / rate + 0.5;
    vec2 texel = floor(at);
    vec2 f = at - texel;
    return LargePixels(ivec2(texel), vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y));
}
