// Splits the pinhole image into a far field (behind the focus plane) and a near field (in front of the focus plane).
// Each field holds weighted radiance and the weight. A pixel of a field (field pixel) averages reduction × reduction
// image pixels. A further output per field is the blur radius in field pixels.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/pinhole.glsl"
#include "circular/clear_image.glsl"

layout(location = 0) uniform float largestRadius;   // max blur radius, in image px
layout(location = 1) uniform float perFarDiameter;  // 1 / (largest CoC diameter in px behind the focus plane)
layout(location = 2) uniform float perNearDiameter; // 1 / (largest CoC diameter in px in front of the focus plane)

layout(location = 0) out vec4 farField;
layout(location = 1) out float farRadius;
layout(location = 2) out float nearRadius;
layout(location = 3) out vec4 nearField;

void main() {
    ivec2 first = reduction * ivec2(gl_FragCoord.xy);
    ivec2 last = min(first + reduction, textureSize(pinholeColor, 0)) - 1;
    vec4 farSum = vec4(0.0);
    vec4 nearSum = vec4(0.0);
    vec2 farBlur = vec2(0.0);   // x: weighted sum of the blur radii; y: sum of the weights
    nearRadius = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            float diameter = pinholeCircleOfConfusion(ivec2(x, y), 0);
            vec4 color = vec4(clearColor(ivec2(x, y)), 1.0);
            // Weights of the pixel in the far and the near field. Below a blur diameter of one pixel, the pixel belongs
            // partly to the sharp image. In the far field, the weight is also proportional to the blur diameter
            // (Garcia's premultiplied far field). Nearly sharp surfaces thus add little to the blur behind them.
            float behind = clamp(diameter, 0.0, 1.0) * min(diameter * perFarDiameter, 1.0);
            float before = clamp(-diameter, 0.0, 1.0);
            if (nearPremultiplied) before *= min(-diameter * perNearDiameter, 1.0);
            farSum += behind * color;
            nearSum += before * color;
            farBlur += vec2(behind * min(0.5 * diameter, largestRadius), behind);
            nearRadius = max(nearRadius, min(-0.5 * diameter, largestRadius));
        }
    ivec2 size = last - first + 1;
    float perPixel = 1.0 / float(size.x * size.y);
    farRadius = farBlur.y > 0.0 ? farBlur.x / farBlur.y / float(reduction) : 0.0;
    nearRadius /= float(reduction);
    farField = farSum * perPixel;
    nearField = nearSum * perPixel;
    if (bracketed) {
        farField = inTenBits(farField);
        nearField = inTenBits(nearField);
    }
}
