// Draws the rendered image to the window, with tone mapping, side-by-side comparison and overlays.

#include "include/tone_map.glsl"

layout(binding = 0) uniform sampler2D firstImage;    // linear, premultiplied
layout(binding = 1) uniform sampler2D secondImage;
layout(binding = 2) uniform sampler2D cocImage;      // signed CoC diameter (px)
layout(binding = 3) uniform sampler2D levelImage;    // fractional level of detail λ (0: full detail); −1: no surface
layout(binding = 4) uniform sampler2D wireImage;     // display-encoded
layout(binding = 5) uniform sampler2D workImage;     // number of triangles over a pixel, summed over lens samples
layout(binding = 6) uniform sampler2D mapColours;    // linear colour map of the overlay

layout(location = 0) uniform vec4 size;        // xy: output size in px; z: exposure gain; w: gain of difference image
layout(location = 1) uniform ivec4 choices;    // x: tone curve; y: overlay; z: flags; w: unused
layout(location = 2) uniform float divider;    // fraction of the width, from the left, that shows the first image
layout(location = 3) uniform float cocScale;   // output px per px of cocImage
// x: 1 / number of lens samples in workImage; y: 1 / log2(1 + n), where n is the number of triangles per lens sample
// that the last colour of the colour map stands for.
layout(location = 4) uniform vec2 workScale;

layout(location = 0) out vec4 display;

const int OVERLAY_COC = 1;
const int OVERLAY_LEVEL = 2;
const int OVERLAY_WORK = 3;
const int FLAG_DIFFERENCE = 1;
const int FLAG_PEAKING = 2;
const int FLAG_FOCUS_PLANE = 4;
const int FLAG_WIREFRAME = 8;

const vec3 luma = vec3(0.2126, 0.7152, 0.0722);

float cocAt(vec2 uv) { return texture(cocImage, uv).r * cocScale; }

vec3 encodedAt(sampler2D image, vec2 uv) {
    vec4 value = texture(image, uv);
    vec3 colour = displayEncoded(value.rgb, size.z, choices.x);
    // A transparent background is drawn as a checkerboard, as in image editors.
    ivec2 tile = ivec2(gl_FragCoord.xy) / 12;
    float board = ((tile.x + tile.y) & 1) == 0 ? 0.42 : 0.50;
    return colour + (1.0 - clamp(value.a, 0.0, 1.0)) * board;
}

// Returns the display colour of the first image, the second image, or their difference, without overlays. Unused
// features are excluded at compile time, because drivers that draw on the CPU execute both sides of each branch.
vec3 shown(vec2 uv) {
    vec3 first = encodedAt(firstImage, uv);
    if (!compares) return first;
    vec3 second = encodedAt(secondImage, uv);
    if (uv.x < divider) return first;
    return (choices.z & FLAG_DIFFERENCE) == 0 ? second : min(size.w * abs(first - second), 1.0);
}

// Returns the overlay colour for a signed CoC diameter (px): orange in front of the focus plane, blue behind the focus
// plane, and grey where the image is sharp. `grey` is the brightness of the image.
vec3 cocColour(float coc, float grey) {
    float amount = clamp(log2(1.0 + abs(coc)) / 6.0, 0.0, 1.0);
    vec3 side = coc < 0.0 ? vec3(1.0, 0.55, 0.10) : vec3(0.20, 0.55, 1.0);
    vec3 shaded = side * (0.30 + 0.70 * grey);
    return mix(vec3(grey), shaded, smoothstep(0.0, 0.5, amount) * 0.9);
}

vec3 withOverlay(vec3 colour, vec2 uv) {
    if (!overlays) return colour;
    float grey = dot(colour, luma);
    if (choices.y == OVERLAY_COC) return cocColour(cocAt(uv), grey);
    if (choices.y == OVERLAY_LEVEL) {
        float level = texture(levelImage, uv).r;
        if (level < 0.0) return 0.35 * vec3(grey);
        return srgbEncoded(texture(mapColours, vec2(level / 8.0, 0.5)).rgb) * (0.55 + 0.65 * grey);
    }
    if (choices.y == OVERLAY_WORK) {
        float work = log2(1.0 + texture(workImage, uv).r * workScale.x) * workScale.y;
        return srgbEncoded(texture(mapColours, vec2(work, 0.5)).rgb);
    }
    return colour;
}

// Returns the strength in [0, 1] of focus peaking, which marks high-contrast edges whose blur is below about one pixel.
float peaking(vec2 uv) {
    vec2 step = 1.0 / size.xy;
    float right = dot(shown(uv + vec2(step.x, 0.0)), luma) - dot(shown(uv - vec2(step.x, 0.0)), luma);
    float up = dot(shown(uv + vec2(0.0, step.y)), luma) - dot(shown(uv - vec2(0.0, step.y)), luma);
    float sharp = 1.0 - smoothstep(1.0, 2.5, abs(cocAt(uv)));
    return sharp * smoothstep(0.06, 0.16, length(vec2(right, up)));
}

void main() {
    vec2 uv = gl_FragCoord.xy / size.xy;
    vec3 colour = shown(uv);
    if (compares && uv.x >= divider && (choices.z & FLAG_DIFFERENCE) != 0) {  // no overlays over the difference image
        display = vec4(colour, 1.0);
        return;
    }
    colour = withOverlay(colour, uv);
    if (marks && (choices.z & FLAG_FOCUS_PLANE) != 0) {
        float inFocus = 1.0 - smoothstep(0.5, 1.5, abs(cocAt(uv)));
        colour = mix(colour, vec3(0.15, 0.95, 0.60), 0.50 * inFocus);
    }
    if (marks && (choices.z & FLAG_PEAKING) != 0) colour = mix(colour, vec3(1.0, 0.25, 0.15), peaking(uv));
    if (marks && (choices.z & FLAG_WIREFRAME) != 0) {
        vec4 wire = texture(wireImage, uv);
        colour = colour * (1.0 - 0.85 * wire.a) + 0.85 * wire.rgb * wire.a;
    }
    display = vec4(colour, 1.0);
}
