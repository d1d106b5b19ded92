// Computes taps of the complex separable kernels F(x), where x = tap / radius (Niemitalo 2010; Garcia 2018).
// src/render/circular/circular_kernel.h documents the mathematics. With exactTaps, there is one tap per pixel;
// otherwise eight taps on each side of the centre are spread over the radius.

// Per component: decay a and frequency b of the kernel F(x) = e^(−a·x²)·(cos b·x² + i·sin b·x²); weights A of Re F and
// B of Im F.
layout(location = 0) uniform vec4 kernel[kernelSize];

struct Taps {
    int count;      // number of taps on each side of the centre
    float radius;   // radius of the disk, in taps
    float spacing;  // distance between taps, px
};

Taps tapsOf(float radius) {
    // With exactTaps, taps fade in as the radius grows: tap i has the fade weight clamp(radius + 1/2 − i, 0, 1).
    if (exactTaps) return Taps(int(ceil(radius - 0.5)), max(radius, 0.5), 1.0);
    return Taps(8, 8.0, radius / 8.0);
}

float fade(Taps taps, int i) { return exactTaps ? clamp(taps.radius + 0.5 - float(i), 0.0, 1.0) : 1.0; }

// Returns the number of taps of the kernel. With exactTaps, the outermost taps count only by their weight fade().
float tapCount(Taps taps) {
    float sum = 1.0;
    for (int i = 1; i <= taps.count; ++i) sum += 2.0 * fade(taps, i);
    return sum;
}

vec2 times(vec2 p, vec2 q) { return vec2(p.x * q.x - p.y * q.y, p.x * q.y + p.y * q.x); }

// Returns q = F(1/R), the complex kernel F of a component at the first tap, for a radius of R taps. The recurrence
// F((i + 1)/R) = F(i/R)·q^(2i + 1) evaluates F at all taps without further exponentials.
vec2 firstRatio(vec4 component, Taps taps) {
    float u = 1.0 / (taps.radius * taps.radius);
    return exp(-component.x * u) * vec2(cos(component.y * u), sin(component.y * u));
}

// Returns the sum of a component's complex kernel F over all taps, each multiplied by its weight fade().
vec2 tapSum(vec4 component, Taps taps) {
    vec2 ratio = firstRatio(component, taps);
    vec2 grow = times(ratio, ratio);
    vec2 f = vec2(1.0, 0.0);
    vec2 sum = f;
    for (int i = 1; i <= taps.count; ++i) {
        f = times(f, ratio);
        ratio = times(ratio, grow);
        sum += 2.0 * fade(taps, i) * f;
    }
    return sum;
}

// Returns a component's complex weight A − i·B. Re((A − i·B)·z) is A·Re z + B·Im z, the weighted sum of the real and
// imaginary parts of z.
vec2 weightOf(vec4 component) { return vec2(component.z, -component.w); }
