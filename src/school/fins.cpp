#include "school/fins.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "school/surface.h"

namespace defocus::engine {
namespace {

constexpr float rimHalfThickness = 0.0013f;  // half the thickness at a fin's edge, body lengths
constexpr float rootHalfThickness = 0.007f;
constexpr float rayRelief = 0.0018f;

float rayLength(const std::array<float, 6>& heights, float t) {
    const float x = t * 5.0f;
    const auto i = static_cast<std::size_t>(std::min(x, 4.999f));
    const auto at = [&](std::size_t k) { return heights[std::min<std::size_t>(k, 5)]; };
    const float p0 = i == 0 ? 2.0f * at(0) - at(1) : at(i - 1);
    const float p1 = at(i);
    const float p2 = at(i + 1);
    const float p3 = i + 2 > 5 ? 2.0f * at(5) - at(4) : at(i + 2);
    const float f = x - static_cast<float>(i);
    // Interpolate the fin ray lengths with a Catmull-Rom spline.
    const float length =
        p1 + 0.5f * f * (p2 - p0 + f * (2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3 + f * (3.0f * (p1 - p2) + p3 - p0)));
    return std::max(length, 0.0f);
}

// Returns a cosine wave over the position t across a fin (0 at the first fin ray, 1 at the last). The wave is 1 on each
// fin ray and 0 halfway between two fin rays; `rays` is the number of periods, one less than the number of fin rays.
float rayWave(float t, int rays) {
    return 0.5f + 0.5f * std::cos(2.0f * std::numbers::pi_v<float> * t * static_cast<float>(rays));
}

Fin medianFin(const FishShape& shape, const MedianFin& fin) {
    const float up = fin.kind == FinKind::dorsal ? 1.0f : -1.0f;
    const auto ray = [&shape, fin, up](float t) {
        const float a = glm::mix(fin.start, fin.end, t);
        const FishSection section = fishSection(shape, a);
        // The fin's root lies slightly below the skin, so that the fin blends into the body.
        const float sunk = std::min(0.018f, 0.5f * section.halfHeight);
        const glm::vec3 root(-a, section.centre + up * (section.halfHeight - sunk), 0.0f);
        const float length = sunk + rayLength(fin.heights, t) * (1.0f - fin.scallop * (1.0f - rayWave(t, fin.rays)));
        const float lean = glm::mix(fin.leanFront, fin.leanRear, t);
        const glm::vec3 along(-std::sin(lean), up * std::cos(lean), 0.0f);
        const glm::vec3 tip = root + length * along + glm::vec3(-fin.curl * length, 0.0f, 0.0f);
        return FinRay{root, root + 0.55f * length * along, tip};
    };
    return {.kind = fin.kind,
            .ray = ray,
            .ripple = shape.finRipple,
            .phase = shape.finPhase,
            .rays = fin.rays,
            .rowsAlongRays = true};
}

Fin caudalFin(const FishShape& shape) {
    const CaudalFin fin = shape.caudal;
    const FishSection stem = fishSection(shape, 0.95f);
    const auto ray = [fin, stem](float t) {
        const float s = 1.0f - 2.0f * t;
        const float outer = std::abs(s);
        const glm::vec3 root(-0.94f, stem.centre + 0.82f * s * stem.halfHeight, 0.0f);
        const float notch = 1.0f - 0.025f * (1.0f - rayWave(t, fin.rays));
        const float length = (0.05f + fin.length * (1.0f - fin.fork * (1.0f - std::pow(outer, 1.5f))) *
                                          (1.0f - fin.rounding * std::pow(outer, 5.0f))) *
                             notch;
        const float angle = s * fin.spread;
        const glm::vec3 middle =
            root + 0.5f * length * glm::vec3(-std::cos(0.75f * angle), std::sin(0.75f * angle), 0.0f);
        const glm::vec3 tip = root + length * glm::vec3(-std::cos(angle), std::sin(angle), 0.0f);
        return FinRay{root, middle, tip};
    };
    return {.kind = FinKind::caudal,
            .ray = ray,
            .ripple = 1.6f * shape.finRipple,
            .phase = shape.finPhase + 1.0f,
            .rays = fin.rays};
}

Fin pairedFin(const FishShape& shape, const PairedFin& fin, float side) {
    const FishSection section = fishSection(shape, fin.a);
    const float halfWidth = section.halfWidth * std::sqrt(std::max(1.0f - fin.height * fin.height, 0.0f));
    const glm::vec3 root(-fin.a, section.centre + fin.height * section.halfHeight,
                         side * std::max(halfWidth - 0.012f, 0.01f));
    const glm::vec3 along(-std::cos(fin.outwards) * std::cos(fin.downwards), -std::sin(fin.downwards),
                          side * std::sin(fin.outwards) * std::cos(fin.downwards));
    const glm::vec3 upwards =
        glm::normalize(glm::vec3(-std::sin(fin.downwards), std::cos(fin.downwards), 0.35f * side));
    const glm::vec3 across = glm::normalize(upwards - glm::dot(upwards, along) * along);
    const auto ray = [=](float t) {
        const float s = 1.0f - 2.0f * t;
        const float notch = 1.0f - 0.03f * (1.0f - rayWave(t, fin.rays));
        // Fin rays are longest slightly above the middle of the fin; both ends of the fin are round.
        const float off = (s - 0.35f) / 1.35f;
        const float length =
            fin.length * notch * (1.0f - 0.45f * off * off) * (1.0f - 0.3f * std::pow(std::abs(s), 6.0f));
        const float angle = 0.5f * fin.spread * s;
        const glm::vec3 start = root + 0.5f * fin.rootWidth * s * across;
        const glm::vec3 tip = start + length * (std::cos(angle) * along + std::sin(angle) * across);
        const glm::vec3 middle =
            start + 0.5f * length * (std::cos(0.8f * angle) * along + std::sin(0.8f * angle) * across);
        return FinRay{start, middle, tip};
    };
    return {.kind = fin.kind,
            .ray = ray,
            .sideways = glm::cross(along, across),
            .ripple = 0.8f * shape.finRipple,
            .phase = shape.finPhase + 2.0f * side,
            .rays = fin.rays};
}

glm::vec3 pointOnRay(const Fin& fin, const FinRay& ray, float t, float r) {
    const float q = 1.0f - r;
    const glm::vec3 curve = q * q * ray.root + 2.0f * q * r * ray.middle + r * r * ray.tip;
    const float swing = std::sin(2.0f * std::numbers::pi_v<float> * 1.7f * t + fin.phase + 2.2f * r) +
                        0.3f * std::sin(2.0f * std::numbers::pi_v<float> * 4.3f * t - fin.phase + 1.3f * r);
    return curve + fin.ripple * r * std::sqrt(r) * swing * fin.sideways;
}

glm::vec3 pointOf(const Fin& fin, float t, float r) {
    return pointOnRay(fin, fin.ray(t), t, r);
}

float halfThickness(const Fin& fin, float t, float r) {
    const float ends = glm::smoothstep(0.0f, 0.08f, std::min(t, 1.0f - t));
    const float root = rootHalfThickness * std::pow(1.0f - r, 1.5f) * (0.3f + 0.7f * ends);
    return rimHalfThickness + root + rayRelief * ends * rayWave(t, fin.rays) * (1.0f - 0.7f * r);
}

// Returns the length of a fin's vertex row at position `at` (see FinRows).
float rowLength(const Fin& fin, float at) {
    constexpr int pieces = 24;
    float sum = 0.0f;
    glm::vec3 before(0.0f);
    for (int i = 0; i <= pieces; ++i) {
        const float s = static_cast<float>(i) / static_cast<float>(pieces);
        const glm::vec3 here = fin.rowsAlongRays ? pointOf(fin, at, s) : pointOf(fin, s, at);
        if (i > 0) sum += glm::length(here - before);
        before = here;
    }
    return sum;
}

// Returns the distance between a fin's vertex rows at positions `from` and `to`, perpendicular to the rows. The
// distance varies along the rows, because they diverge like a fan; several distances are averaged.
float rowGap(const Fin& fin, float from, float to) {
    float sum = 0.0f;
    constexpr std::array<float, 3> places{0.15f, 0.45f, 0.8f};
    for (const float place : places) {
        const auto at = [&](float row, float along) {
            return fin.rowsAlongRays ? pointOf(fin, row, along) : pointOf(fin, along, row);
        };
        const glm::vec3 gap = at(to, place) - at(from, place);
        const glm::vec3 along = glm::normalize(at(from, place + 0.01f) - at(from, place) + glm::vec3(1e-9f));
        sum += glm::length(gap - glm::dot(gap, along) * along);
    }
    return sum / static_cast<float>(places.size());
}

}  // namespace

std::vector<Fin> fishFins(const FishShape& shape) {
    std::vector<Fin> fins;
    for (const MedianFin& fin : shape.medianFins) fins.push_back(medianFin(shape, fin));
    fins.push_back(caudalFin(shape));
    for (const float side : {1.0f, -1.0f}) {
        fins.push_back(pairedFin(shape, shape.pectoral, side));
        fins.push_back(pairedFin(shape, shape.pelvic, side));
    }
    return fins;
}

FinRows finRows(const Fin& fin, float edge) {
    constexpr int pieces = 64;
    std::array<float, pieces + 1> distance{};
    for (int i = 1; i <= pieces; ++i) {
        const float from = static_cast<float>(i - 1) / static_cast<float>(pieces);
        const float to = static_cast<float>(i) / static_cast<float>(pieces);
        distance[static_cast<std::size_t>(i)] = distance[static_cast<std::size_t>(i) - 1] + rowGap(fin, from, to);
    }
    const auto steps = std::max(2, static_cast<int>(std::lround(distance.back() / (0.87f * edge))));
    FinRows rows;
    std::size_t piece = 1;
    for (int i = 0; i <= steps; ++i) {
        const float wanted = distance.back() * static_cast<float>(i) / static_cast<float>(steps);
        while (piece < pieces && distance[piece] < wanted) ++piece;
        const float span = std::max(distance[piece] - distance[piece - 1], 1e-9f);
        const float inPiece = glm::clamp((wanted - distance[piece - 1]) / span, 0.0f, 1.0f);
        const float at = (static_cast<float>(piece - 1) + inPiece) / static_cast<float>(pieces);
        rows.at.push_back(at);
        rows.counts.push_back(std::max(2u, 1u + static_cast<std::uint32_t>(std::lround(rowLength(fin, at) / edge))));
    }
    return rows;
}

void addFin(const Fin& fin, const FinRows& rows, const FishPattern& pattern, FishSurface& surface) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    std::vector<VertexRow> strips;
    std::vector<glm::vec3> halves;  // per vertex: vector from the fin's middle surface to its front surface
    for (std::size_t row = 0; row < rows.at.size(); ++row) {
        const std::uint32_t count = rows.counts[row];
        strips.push_back({first + static_cast<std::uint32_t>(halves.size()), count, 0.0f});
        const FinRay shared = fin.ray(rows.at[row]);
        for (std::uint32_t i = 0; i < count; ++i) {
            const float along = static_cast<float>(i) / static_cast<float>(count - 1);
            const float t = fin.rowsAlongRays ? rows.at[row] : along;
            const float r = fin.rowsAlongRays ? along : rows.at[row];
            const FinRay ray = fin.rowsAlongRays ? shared : fin.ray(t);
            // The normal of the fin's front is the cross product of the surface's derivatives by t (across the fin) and
            // r (from root to edge), computed as differences over this step.
            constexpr float step = 0.004f;
            const float tStep = t + step > 1.0f ? -step : step;
            const float rStep = r + step > 1.0f ? -step : step;
            const glm::vec3 here = pointOnRay(fin, ray, t, r);
            const glm::vec3 byT =
                (pointOf(fin, t + tStep, std::max(r, 0.02f)) - pointOnRay(fin, ray, t, std::max(r, 0.02f))) / tStep;
            const glm::vec3 byR = (pointOnRay(fin, ray, t, r + rStep) - here) / rStep;
            const glm::vec3 normal = fin.rowsAlongRays ? glm::cross(byT, byR) : glm::cross(byR, byT);
            const float size = glm::length(normal);
            halves.push_back(size > 1e-12f ? halfThickness(fin, t, r) / size * normal : glm::vec3(0.0f));
            surface.add(here, finColor(pattern, fin.kind, t, r, rayWave(t, fin.rays)));
        }
    }
    const auto count = static_cast<std::uint32_t>(halves.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        surface.positions.push_back(surface.positions[first + i] - halves[i]);
        surface.colors.push_back(surface.colors[first + i]);
    }
    for (std::uint32_t i = 0; i < count; ++i) surface.positions[first + i] += halves[i];
    stitchShell(strips, count, surface.positions, surface.indices);
}

}  // namespace defocus::engine
