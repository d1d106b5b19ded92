// Sources of the curves. sRGB: IEC 61966-2-1.
//
// ACES: Stephen Hill's fit of the RRT and the Rec.709 ODT, published in MJP's BakingLab. The input matrix converts
// linear sRGB to AP1 and applies the RRT's saturation. The output matrix applies the ODT's saturation and converts to
// linear sRGB.
//
// AgX: Troy Sobotka's view transform. Matrices and polynomial of the base look are from Benjamin Wrensch, "Minimal AgX
// Implementation", 2023. AgX's output is encoded for a display with gamma 2.2.
//
// Neutral: Khronos PBR Neutral Tone Mapper, specification 1.0, 2024. It subtracts the 4 % specular reflection of
// dielectrics, so that a surface under grey light shows its base colour, and compresses values above 0.8.

#include "image/tone_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

// Inputs are clamped to this value, where all curves are flat, so that their squares stay finite.
constexpr float brightest = 1e6f;

// Clamps to [0, brightest]. NaN gives 0, because comparisons with NaN are false.
float finite(float value) {
    return value > 0 ? std::min(value, brightest) : 0.0f;
}

glm::vec3 srgbEncoded(const glm::vec3& linear) {
    return {srgbEncode(linear.r), srgbEncode(linear.g), srgbEncode(linear.b)};
}

glm::vec3 acesEncoded(const glm::vec3& linear) {
    const glm::mat3 input(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    const glm::mat3 output(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f,
                           1.07602f);
    const glm::vec3 v = input * linear;
    const glm::vec3 fitted = (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
    return srgbEncoded(output * fitted);
}

// Returns the sigmoid of AgX's base look, fitted by a polynomial of degree 6. `x` is the log2 exposure normalised to
// [0, 1].
float agxContrast(float x) {
    return ((((((15.5f * x - 40.14f) * x + 31.96f) * x - 6.868f) * x + 0.4298f) * x + 0.1191f) * x) - 0.00232f;
}

glm::vec3 agxEncoded(const glm::vec3& linear) {
    constexpr float darkest = -12.47393f;  // log2 of the linear value at which the curve begins
    constexpr float lightest = 4.026069f;
    const glm::mat3 inset(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f,
                          0.878468636469772f, 0.0784336f, 0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const glm::mat3 outset(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f, -0.0980208811401368f,
                           1.15190312990417f, -0.0980434501171241f, -0.0990297440797205f, -0.0989611768448433f,
                           1.15107367264116f);
    glm::vec3 v = inset * linear;
    for (int c = 0; c < 3; ++c) {
        const float exposure = std::log2(std::max(v[c], 1e-10f));
        v[c] = agxContrast(std::clamp((exposure - darkest) / (lightest - darkest), 0.0f, 1.0f));
    }
    v = outset * v;
    for (int c = 0; c < 3; ++c) v[c] = std::clamp(v[c], 0.0f, 1.0f);
    return v;
}

glm::vec3 neutralEncoded(glm::vec3 v) {
    constexpr float mirrored = 0.04f;
    constexpr float kept = 0.8f - mirrored;  // values up to this limit are not compressed
    constexpr float desaturation = 0.15f;
    const float min = std::min({v.r, v.g, v.b});
    v -= min < 2 * mirrored ? min - min * min / (4 * mirrored) : mirrored;
    const float peak = std::max({v.r, v.g, v.b});
    if (peak <= kept) return srgbEncoded(v);
    constexpr float left = 1 - kept;
    const float compressed = 1 - left * left / (peak + left - kept);
    const float white = 1 - 1 / (desaturation * (peak - compressed) + 1);
    return srgbEncoded(glm::mix(v * (compressed / peak), glm::vec3(compressed), white));
}

glm::vec3 encoded(const glm::vec3& linear, ToneMap toneMap) {
    switch (toneMap) {
        case ToneMap::aces:
            return acesEncoded(linear);
        case ToneMap::agx:
            return agxEncoded(linear);
        case ToneMap::neutral:
            return neutralEncoded(linear);
        case ToneMap::none:
            break;
    }
    return srgbEncoded(linear);
}

}  // namespace

float srgbEncode(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float srgbDecode(float encoded) {
    if (!(encoded > 0)) return 0;
    if (encoded >= 1) return 1;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Image displayEncoded(const ImageView& linear, ToneMap toneMap, double exposure) {
    Image display(linear.width, linear.height, linear.channels);
    const auto gain = static_cast<float>(std::exp2(exposure));
    const bool grey = linear.channels < 3;
    parallelFor(static_cast<std::size_t>(linear.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < linear.width; ++x) {
            const float* in = linear.at(x, y);
            float* out = display.at(x, y);
            if (grey) {
                // All curves map grey to grey except for rounding, so one channel suffices. Use green, which carries
                // most of the luminance.
                out[0] = encoded(glm::vec3(finite(gain * in[0])), toneMap).g;
                continue;
            }
            const glm::vec3 colour =
                encoded({finite(gain * in[0]), finite(gain * in[1]), finite(gain * in[2])}, toneMap);
            for (int c = 0; c < 3; ++c) out[c] = colour[c];
            if (linear.channels == 4) out[3] = std::min(finite(in[3]), 1.0f);
        }
    });
    return display;
}

}  // namespace defocus::engine
