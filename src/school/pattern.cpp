#include "school/pattern.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "school/random.h"

namespace defocus::engine {
namespace {

constexpr float softness = 0.012f;  // half the width of a soft colour border, in body lengths; spans a few mesh edges

// Returns 1 for |distance| < halfWidth and 0 elsewhere, with a soft transition of half width `soft`.
float painted(float distance, float halfWidth, float soft = softness) {
    return 1.0f - glm::smoothstep(halfWidth - soft, halfWidth + soft, std::abs(distance));
}

float within(float value, float from, float to, float soft) {
    return glm::smoothstep(from - soft, from + soft, value) * (1.0f - glm::smoothstep(to - soft, to + soft, value));
}

void paintBands(const FishPattern& pattern, float a, float height, float wobble, glm::vec3& color) {
    for (const FishBand& band : pattern.bands) {
        const float distance = a - band.a - band.bow * height * height - band.slant * height + 0.012f * wobble;
        if (band.rimWidth > 0.0f) {
            color = glm::mix(color, band.rim, painted(distance, band.halfWidth + band.rimWidth, 0.008f));
        }
        color = glm::mix(color, band.color, painted(distance, band.halfWidth, 0.008f));
    }
}

void paintStripes(const FishPattern& pattern, float a, float height, float wobble, glm::vec3& color) {
    const FishStripes& stripes = pattern.stripes;
    if (stripes.count <= 0.0f) return;
    const float phase = 0.5f * stripes.count * (height - stripes.slant * (a - 0.5f)) + stripes.wave * wobble;
    const float distance = std::abs(phase - std::floor(phase) - 0.5f);
    const float line = 1.0f - glm::smoothstep(0.5f * stripes.share - 0.09f, 0.5f * stripes.share + 0.09f, distance);
    color = glm::mix(color, stripes.color, line * within(a, stripes.from, stripes.to, 0.03f));
}

void paintSpots(const FishPattern& pattern, float a, float y, float height, glm::vec3& color) {
    const FishSpots& spots = pattern.spots;
    if (spots.size <= 0.0f) return;
    const glm::vec2 p = glm::vec2(a, y) / spots.size;
    const glm::ivec2 home(glm::floor(p));
    float nearest = 10.0f;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const glm::ivec2 cell = home + glm::ivec2(i, j);
            const float shift = (cell.y & 1) != 0 ? 0.5f : 0.0f;
            const glm::vec2 jitter(latticeValue(cell.x, cell.y, pattern.seed),
                                   latticeValue(cell.x, cell.y, pattern.seed + 1u));
            const glm::vec2 centre = glm::vec2(cell) + 0.5f + glm::vec2(shift - 0.25f, 0.0f) + 0.3f * (jitter - 0.5f);
            const float grow = 0.8f + 0.5f * latticeValue(cell.x, cell.y, pattern.seed + 2u);
            nearest = std::min(nearest, glm::length(p - centre) / grow);
        }
    }
    const float where = within(a, spots.from, spots.to, 0.05f) * within(height, spots.lowest, spots.highest, 0.12f);
    const float halo = 1.0f - glm::smoothstep(spots.radius + 0.04f, spots.radius + 0.26f, nearest);
    color = glm::mix(color, spots.halo, where * spots.haloAmount * halo);
    color = glm::mix(color, spots.color,
                     where * (1.0f - glm::smoothstep(spots.radius - 0.1f, spots.radius + 0.06f, nearest)));
}

}  // namespace

glm::vec3 linearColor(std::uint32_t srgb) {
    glm::vec3 color(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float encoded = static_cast<float>((srgb >> (16u - 8u * static_cast<unsigned>(i))) & 255u) / 255.0f;
        color[i] = encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
    }
    return color;
}

glm::vec3 skinColor(const FishPattern& pattern, const FishShape& shape, const FishSkinPoint& point,
                    const FishRelief& relief) {
    const float a = point.a;
    const float y = point.y;
    const float height = point.height;
    const float wobble = 2.0f * valueNoise({7.0f * a, 7.0f * y}, pattern.seed + 5u) - 1.0f;

    // Apply countershading from the dark back to the pale belly, then the colours of the rear part and the face.
    glm::vec3 color = glm::mix(pattern.flank, pattern.back, glm::smoothstep(0.05f, 0.95f, height + 0.1f * wobble));
    const float bellyAmount =
        1.0f - glm::smoothstep(pattern.bellyEdge - 0.45f, pattern.bellyEdge + 0.3f, height + 0.1f * wobble);
    color = glm::mix(color, pattern.belly, bellyAmount);
    const float rearEdge = pattern.rearStart + pattern.rearSlant * height + 0.03f * wobble;
    color = glm::mix(color, pattern.rear,
                     glm::smoothstep(rearEdge - pattern.rearSoftness, rearEdge + pattern.rearSoftness, a));
    const float beforeGill =
        1.0f - glm::smoothstep(0.75f * shape.gillA, 1.1f * shape.gillA, a + 0.03f * height * height);
    color = glm::mix(color, pattern.face, pattern.faceAmount * beforeGill);

    paintStripes(pattern, a, height, wobble, color);
    paintSpots(pattern, a, y, height, color);
    paintBands(pattern, a, height, wobble, color);
    const float nearMouth = 1.0f - glm::smoothstep(0.4f, 1.3f, a / std::max(shape.mouthLength, 0.02f));
    color = glm::mix(color, pattern.lips, pattern.lipsAmount * nearMouth);

    // At the tail, the body's colour blends into the tail fin's colour.
    color = glm::mix(color, pattern.caudalRoot, glm::smoothstep(0.905f, 0.95f, a + 0.008f * wobble));

    // Apply the scale relief: each scale has its own brightness and a pale rim; grooves are dark.
    color *= 1.0f + pattern.scaleVariation * relief.scaleTone + 0.05f * wobble;
    const float brightness = std::max({color.r, color.g, color.b});
    const float rims = pattern.scaleEdgeAmount * glm::smoothstep(0.02f, 0.4f, brightness);
    color = glm::mix(color, pattern.scaleEdge, rims * relief.scaleEdge);
    return color * (1.0f - 0.5f * relief.groove);
}

glm::vec3 finColor(const FishPattern& pattern, FinKind kind, float t, float r, float ray) {
    glm::vec3 color(0.0f);
    if (kind == FinKind::caudal) {
        color = glm::mix(pattern.caudalRoot, pattern.caudalEdge, glm::smoothstep(0.15f, 0.9f, r));
        const float outer = std::min(t, 1.0f - t);
        const float rim = 1.0f - glm::smoothstep(pattern.caudalRimWidth - 0.03f, pattern.caudalRimWidth + 0.03f, outer);
        if (pattern.caudalRimWidth > 0.0f) color = glm::mix(color, pattern.caudalRim, rim);
    } else if (kind == FinKind::dorsal || kind == FinKind::anal) {
        color = glm::mix(pattern.medianRoot, pattern.medianEdge, glm::smoothstep(0.1f, 0.95f, r));
        const float rim =
            glm::smoothstep(1.0f - pattern.medianRimWidth - 0.05f, 1.0f - pattern.medianRimWidth + 0.05f, r);
        if (pattern.medianRimWidth > 0.0f) color = glm::mix(color, pattern.medianRim, rim);
    } else {
        color = glm::mix(pattern.pairedRoot, pattern.pairedEdge, glm::smoothstep(0.1f, 0.9f, r));
    }
    // The membrane between the fin rays is thinner and transmits some light.
    const float web = 1.0f - ray;
    return color * (0.82f + 0.18f * ray) + 0.06f * web * glm::smoothstep(0.2f, 1.0f, r) * glm::vec3(0.5f, 0.8f, 1.0f);
}

glm::vec3 eyeColor(const FishPattern& pattern, float angle) {
    const float fromPupil = angle / std::numbers::pi_v<float>;
    const glm::vec3 black(0.004f, 0.006f, 0.012f);
    glm::vec3 color = glm::mix(0.55f * pattern.iris, pattern.iris, 1.0f - glm::smoothstep(0.2f, 0.34f, fromPupil));
    const glm::vec3 ring = glm::mix(pattern.iris, glm::vec3(1.0f, 0.92f, 0.7f), 0.55f);
    color = glm::mix(color, ring, 1.0f - glm::smoothstep(0.215f, 0.235f, fromPupil));
    color = glm::mix(color, black, 1.0f - glm::smoothstep(0.175f, 0.195f, fromPupil));
    return glm::mix(color, black, glm::smoothstep(0.36f, 0.42f, fromPupil));
}

}  // namespace defocus::engine
