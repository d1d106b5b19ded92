// Composites a batch (wave) of lens samples, one layer per sample, over the environment.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/compensated.glsl"
#include "include/environment.glsl"

layout(binding = 0) uniform sampler2DArray layers;
layout(binding = 1) uniform sampler2D sumSoFar;
layout(std140, binding = 3) uniform ShiftBlock {
    // xy: shift of the sky as seen by the lens sample, on the image plane at distance 1. With cocControls, xy is the
    // shift for C/w = 1 (circle of confusion C, depth w), and zw is the shift by the pixel jitter.
    vec4 sampleShifts[blockSamples];
};
layout(location = 0) uniform int layerCount;
layout(location = 1) uniform int firstInBlock;
// First layer pixel that pixel (0, 0) of the sum image covers. Each pixel of the sum image covers positionsPerAxis ×
// positionsPerAxis layer pixels, one per subpixel position.
layout(location = 2) uniform ivec2 firstPixel;
const int positions = positionsPerAxis * positionsPerAxis;

#ifdef WEIGHS_SAMPLES
layout(std140, binding = 4) uniform SampleBlock {
    // rgb: weights of the colour channels for the sample's wavelength; alpha: change that the wavelength causes in the
    // coefficient b of the circle of confusion a + b·depth.
    vec4 sampleBands[blockSamples];
    // xy: lens point (u, v), relative to the lens radius.
    vec4 sampleLenses[blockSamples];
};
vec4 bandOf(int layer) { return chromatic ? sampleBands[firstInBlock + layer] : vec4(1.0, 1.0, 1.0, 0.0); }
vec2 lensPointOf(int layer) { return sampleLenses[firstInBlock + layer].xy; }
#else
vec4 bandOf(int layer) { return vec4(1.0, 1.0, 1.0, 0.0); }
vec2 lensPointOf(int layer) { return vec2(0.0); }
#endif

// Returns the coordinates of the layer texel that belongs to this pixel of the sum image and to the subpixel position
// with index `position`, 0 to positions − 1.
ivec3 texelOf(int position, int layer) {
    ivec2 cell = ivec2(position % positionsPerAxis, position / positionsPerAxis);
    return ivec3(ivec2(gl_FragCoord.xy) * positionsPerAxis + firstPixel + cell, layer);
}

// Returns the point on the image plane at distance 1 for `place`, a position in the layers in px from the bottom left.
vec2 onImagePlane(vec2 place) {
    return (2.0 * (place + frame.window.xy) / frame.window.zw - 1.0) / frame.projection.xy;
}

// Returns the point on the image plane at distance 1 for the centre of this pixel of the sum image.
vec2 pixelOnImagePlane() {
    return onImagePlane(gl_FragCoord.xy * float(positionsPerAxis) + vec2(firstPixel));
}

// Returns the offset r (in lens radii) that causes the cat-eye vignetting of a pixel. The lens barrel's rim is a circle
// as large as the aperture, and light through lens point l passes it if |l + r| ≤ 1. r is proportional to the pixel's
// distance from the image's centre; |r| = catEye at the image's corners.
vec2 barrelRim(vec2 imagePlane) {
    float aspect = frame.window.z / frame.window.w;
    return catEye * imagePlane * frame.projection.xy * vec2(1.0, 1.0 / aspect) * inversesqrt(1.0 + 1.0 / (aspect * aspect));
}

// Returns true if the barrel clips the sample. `rim`: result of barrelRim().
bool isClipped(int layer, vec2 rim) {
    vec2 onLens = lensPointOf(layer) + rim;
    return dot(onLens, onLens) > 1.0;
}

// Returns the sky radiance that a sample sees through this pixel, for uniform and gradient environments. Environment
// maps are drawn into the layers instead.
vec3 behind(vec2 imagePlane, int layer) {
    if (backgroundType == 1) return lighting.environment[0].rgb;
    vec4 shifts = sampleShifts[firstInBlock + layer];
    vec2 p = imagePlane;
    if (cocControls) {
        if (chromatic) bandShift = bandOf(layer).w;
        vec2 place = imagePlane * frame.projection.xy;
        float blur = relativeCircleOfConfusion(0.0, place, vec2(1.0, 0.0));
        p += blur * shifts.xy;
        p += shifts.zw;
        if (aberrations) p -= aberration(place, -shifts.xy * frame.projection.xy) / frame.projection.xy;
    } else {
        p += shifts.xy;
    }
    vec3 up = vec3(frame.worldFromView[0].y, frame.worldFromView[1].y, frame.worldFromView[2].y);
    return gradientRadiance((dot(up.xy, p) - up.z) * inversesqrt(dot(p, p) + 1.0));
}

// Returns a pixel of a layer, composited over a uniform or gradient background. Without a background, alpha is the
// coverage.
vec4 layerLight(ivec3 texel) {
    vec4 value = texelFetch(layers, texel, 0);
    if (backgroundType == 1 || backgroundType == 2)
        value.rgb += (1.0 - min(value.a, 1.0)) * behind(onImagePlane(vec2(texel.xy) + 0.5), texel.z);
    return value;
}

void addLayer(inout vec4 sum, inout vec4 compensation, vec4 value, int layer) {
    if (backgroundType == 0) addCompensated(sum.a, compensation.a, value.a);
    addCompensated(sum.rgb, compensation.rgb, value.rgb * bandOf(layer).rgb);
}
