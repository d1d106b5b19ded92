#include "school/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "school/fins.h"
#include "school/surface.h"

namespace defocus::engine {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float eyeEdge = 0.75f;  // edge length on eyes relative to bodies; short edges make pupils crisp

// ---- body of the fish ------------------------------------------------------------------------------

struct Rings {
    std::vector<float> at;  // position of each ring: 0 (snout) to 1 (tail) along a body, or the polar angle on an eye
    std::vector<std::uint32_t> counts;
};

float ellipsePerimeter(float p, float q) {  // approximation by Ramanujan, 1914; p, q: semi-axes
    return pi * (3.0f * (p + q) - std::sqrt((3.0f * p + q) * (p + 3.0f * q)));
}

Rings bodyRings(const FishShape& shape, float edge) {
    // Tabulate the distance along the skin from the snout, averaged over back, belly and flank. Steps are finer at the
    // round snout.
    constexpr int pieces = 400;
    std::vector<float> distance{0.0f};
    std::vector<float> at{0.0f};
    FishSection before;
    for (int i = 1; i <= pieces; ++i) {
        const float q = static_cast<float>(i) / static_cast<float>(pieces);
        const float a = q * q * (1.5f - 0.5f * q * q);
        const FishSection here = fishSection(shape, a);
        const float step = a - at.back();
        const auto slanted = [&](float rise) { return std::sqrt(step * step + rise * rise); };
        const float top = here.centre + here.halfHeight - before.centre - before.halfHeight;
        const float bottom = here.centre - here.halfHeight - before.centre + before.halfHeight;
        const float width = here.halfWidth - before.halfWidth;
        distance.push_back(distance.back() + (slanted(top) + slanted(bottom) + 2.0f * slanted(width)) / 4.0f);
        at.push_back(a);
        before = here;
    }
    const auto steps = std::max(6, static_cast<int>(std::lround(distance.back() / (0.87f * edge))));
    Rings rings;
    std::size_t piece = 1;
    for (int i = 1; i < steps; ++i) {  // snout and tail end are single vertices, not rings
        const float wanted = distance.back() * static_cast<float>(i) / static_cast<float>(steps);
        while (piece < pieces && distance[piece] < wanted) ++piece;
        const float a =
            glm::mix(at[piece - 1], at[piece],
                     (wanted - distance[piece - 1]) / std::max(distance[piece] - distance[piece - 1], 1e-9f));
        const FishSection section = fishSection(shape, a);
        rings.at.push_back(a);
        rings.counts.push_back(std::max(5u, static_cast<std::uint32_t>(std::lround(
                                                ellipsePerimeter(section.halfHeight, section.halfWidth) / edge))));
    }
    return rings;
}

// Maps fractions of the perimeter of a body's cross-section to angles, from the back down the left flank and up the
// right flank.
class Girth {
public:
    explicit Girth(const FishSection& section) {
        for (std::size_t i = 1; i <= quarter; ++i) {
            const float angle = 0.5f * pi * (static_cast<float>(i) - 0.5f) / static_cast<float>(quarter);
            const float dy = section.halfHeight * std::sin(angle);
            const float dz = section.halfWidth * std::cos(angle);
            length_[i] = length_[i - 1] + 0.5f * pi / static_cast<float>(quarter) * std::sqrt(dy * dy + dz * dz);
        }
    }
    // Returns the ellipse's angle parameter at `fraction` (0 to 1) of the cross-section's perimeter; 0 at the back.
    [[nodiscard]] float angle(float fraction) const {
        const float turns = 4.0f * fraction;
        const float quadrant = std::floor(turns);
        const bool mirrored = (static_cast<int>(quadrant) & 1) != 0;
        const float wanted = length_[quarter] * (mirrored ? 1.0f - (turns - quadrant) : turns - quadrant);
        std::size_t i = 1;
        while (i < quarter && length_[i] < wanted) ++i;
        const float t = (wanted - length_[i - 1]) / std::max(length_[i] - length_[i - 1], 1e-12f);
        const float inQuarter = 0.5f * pi * (static_cast<float>(i - 1) + t) / static_cast<float>(quarter);
        return mirrored ? (quadrant + 1.0f) * 0.5f * pi - inQuarter : quadrant * 0.5f * pi + inQuarter;
    }
    [[nodiscard]] float perimeter() const { return 4.0f * length_[quarter]; }

private:
    static constexpr std::size_t quarter = 32;
    std::array<float, quarter + 1> length_{};
};

void addBody(const Fish& fish, const Rings& rings, float edge, FishSurface& surface) {
    const FishShape& shape = fish.shape;
    const auto snout = static_cast<std::uint32_t>(surface.positions.size());
    surface.add({0.0f, 0.0f, 0.0f}, skinColor(fish.pattern, shape, {}, {}));
    std::vector<VertexRow> rows;
    for (std::size_t ring = 0; ring < rings.at.size(); ++ring) {
        const float a = rings.at[ring];
        const FishSection section = fishSection(shape, a);
        const Girth girth(section);
        // Normals need the slope of the skin along the body. It is computed from the cross-sections at this distance
        // ahead and behind.
        const float reach = std::min(0.004f, 0.4f * std::min(a, 1.0f - a));
        const FishSection ahead = fishSection(shape, a - reach);
        const FishSection behind = fishSection(shape, a + reach);
        const VertexRow row{static_cast<std::uint32_t>(surface.positions.size()), rings.counts[ring],
                            (ring & 1u) != 0 ? 0.5f : 0.0f};
        for (std::uint32_t i = 0; i < row.count; ++i) {
            const float fraction = (static_cast<float>(i) + row.offset) / static_cast<float>(row.count);
            const float angle = girth.angle(fraction);
            const float up = std::cos(angle);
            const float left = std::sin(angle);
            const auto on = [&](float x, const FishSection& s) {
                return glm::vec3(x, s.centre + s.halfHeight * up, s.halfWidth * left);
            };
            const glm::vec3 around(0.0f, -section.halfHeight * left, section.halfWidth * up);
            const glm::vec3 alongBody = on(-a - reach, behind) - on(-a + reach, ahead);
            const glm::vec3 normal = glm::normalize(glm::cross(alongBody, around));
            FishSkinPoint point{
                .a = a, .y = section.centre + section.halfHeight * up, .halfHeight = section.halfHeight, .height = up};
            point.alongGirth = girth.perimeter() * (0.25f - (fraction <= 0.5f ? fraction : 1.0f - fraction));
            const FishRelief relief = fishRelief(shape, point, edge);
            surface.add(on(-a, section) + relief.displacement * normal, skinColor(fish.pattern, shape, point, relief));
        }
        rows.push_back(row);
    }
    const auto end = static_cast<std::uint32_t>(surface.positions.size());
    surface.add({-1.0f, 0.0f, 0.0f}, fish.pattern.caudalRoot);
    capRing(rows.front(), snout, false, surface.indices);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) stitchRings(rows[i], rows[i + 1], surface.indices);
    capRing(rows.back(), end, true, surface.indices);
}

// ---- eyes of the fish ------------------------------------------------------------------------------

Rings eyeRings(const FishShape& shape, float edge) {
    const float radius = shape.eyeRadius;
    const auto steps = std::max(3, static_cast<int>(std::lround(pi * radius / (0.87f * edge))));
    Rings rings;
    for (int i = 1; i < steps; ++i) {
        const float angle = pi * static_cast<float>(i) / static_cast<float>(steps);
        rings.at.push_back(angle);
        const float perimeter = 2.0f * pi * radius * std::sin(angle);
        rings.counts.push_back(std::max(5u, static_cast<std::uint32_t>(std::lround(perimeter / edge))));
    }
    return rings;
}

// Adds an eye: a flattened sphere whose pole points outwards and slightly forwards.
void addEye(const Fish& fish, const Rings& rings, float side, FishSurface& surface) {
    const FishShape& shape = fish.shape;
    const FishSection section = fishSection(shape, shape.eyeA);
    const float up = shape.eyeHeight;
    const float left = std::sqrt(1.0f - up * up);
    const glm::vec3 outwards = glm::normalize(glm::vec3(0.25f, 0.3f * up, side));
    const glm::vec3 skin(-shape.eyeA, section.centre + section.halfHeight * up, side * section.halfWidth * left);
    const glm::vec3 centre = skin - 0.3f * shape.eyeRadius * outwards;
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), outwards));
    const glm::vec3 top = glm::cross(outwards, right);
    const auto at = [&](float angle, float turn) {
        const float across = shape.eyeRadius * std::sin(angle);
        return centre + 0.68f * shape.eyeRadius * std::cos(angle) * outwards +
               across * (std::cos(turn) * right + std::sin(turn) * top);
    };
    const auto pole = static_cast<std::uint32_t>(surface.positions.size());
    surface.add(at(0.0f, 0.0f), eyeColor(fish.pattern, 0.0f));
    std::vector<VertexRow> rows;
    for (std::size_t ring = 0; ring < rings.at.size(); ++ring) {
        const VertexRow row{static_cast<std::uint32_t>(surface.positions.size()), rings.counts[ring],
                            (ring & 1u) != 0 ? 0.5f : 0.0f};
        for (std::uint32_t i = 0; i < row.count; ++i) {
            const float turn = 2.0f * pi * (static_cast<float>(i) + row.offset) / static_cast<float>(row.count);
            surface.add(at(rings.at[ring], turn), eyeColor(fish.pattern, rings.at[ring]));
        }
        rows.push_back(row);
    }
    const auto end = static_cast<std::uint32_t>(surface.positions.size());
    surface.add(at(pi, 0.0f), eyeColor(fish.pattern, pi));
    capRing(rows.front(), pole, false, surface.indices);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) stitchRings(rows[i], rows[i + 1], surface.indices);
    capRing(rows.back(), end, true, surface.indices);
}

// ---- layout of vertex rows for the complete fish -------------------------------------------------

struct Layout {
    float edge = 0;
    Rings body;
    Rings eye;
    std::vector<FinRows> fins;
    std::uint64_t triangles = 0;
};

Layout layout(const FishShape& shape, const std::vector<Fin>& fins, float edge) {
    Layout result{.edge = edge, .body = bodyRings(shape, edge), .eye = eyeRings(shape, eyeEdge * edge), .fins = {}};
    result.triangles = ringTriangles(result.body.counts) + 2u * ringTriangles(result.eye.counts);
    for (const Fin& fin : fins) {
        result.fins.push_back(finRows(fin, edge));
        result.triangles += shellTriangles(result.fins.back().counts);
    }
    return result;
}

// Returns the layout of vertex rows whose triangle count is closest to `triangles`. The count is inversely proportional
// to the squared edge length.
Layout layoutFor(const FishShape& shape, const std::vector<Fin>& fins, int triangles) {
    const auto wanted = static_cast<double>(triangles);
    Layout best = layout(shape, fins, static_cast<float>(1.6 / std::sqrt(wanted)));
    for (int round = 0; round < 5; ++round) {
        const double ratio = static_cast<double>(best.triangles) / wanted;
        if (std::abs(ratio - 1.0) < 0.004) break;
        const auto edge = std::min(best.edge * static_cast<float>(std::sqrt(ratio)), 0.5f);
        Layout next = layout(shape, fins, edge);
        const double nextRatio = static_cast<double>(next.triangles) / wanted;
        if (std::abs(nextRatio - 1.0) >= std::abs(ratio - 1.0)) break;
        best = std::move(next);
    }
    return best;
}

}  // namespace

void FishSurface::add(const glm::vec3& position, const glm::vec3& color) {
    positions.push_back(position);
    // Quantise colours to 8 bits, as most file formats do.
    const glm::vec3 steps = glm::floor(glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f);
    colors.emplace_back(steps / 255.0f, 1);
}

Mesh fishMesh(const Fish& fish, int triangles, int skinMaterial, int eyeMaterial) {
    const std::vector<Fin> fins = fishFins(fish.shape);
    const Layout plan = layoutFor(fish.shape, fins, triangles);

    // Build the straight fish, with coordinates in body lengths: first the body and the fins, then the eyes.
    FishSurface surface;
    surface.positions.reserve(plan.triangles / 2 + 64);
    surface.colors.reserve(plan.triangles / 2 + 64);
    surface.indices.reserve(3 * plan.triangles);
    addBody(fish, plan.body, plan.edge, surface);
    for (std::size_t i = 0; i < fins.size(); ++i) addFin(fins[i], plan.fins[i], fish.pattern, surface);
    const std::size_t skinIndices = surface.indices.size();
    for (const float side : {1.0f, -1.0f}) addEye(fish, plan.eye, side, surface);

    // Bend the fish as if it were swimming, then compute normals from the bent surface.
    const FishSpine spine(fish.shape);
    for (glm::vec3& position : surface.positions) position = fish.shape.length * spine.bend(position);
    Mesh mesh;
    mesh.name = fish.species;
    mesh.vertices.normals = smoothNormals(surface.positions, surface.indices);
    mesh.vertices.positions = std::move(surface.positions);
    mesh.vertices.colors = std::move(surface.colors);
    const auto split = surface.indices.begin() + static_cast<std::ptrdiff_t>(skinIndices);
    mesh.primitives.push_back({skinMaterial, {surface.indices.begin(), split}});
    mesh.primitives.push_back({eyeMaterial, {split, surface.indices.end()}});
    return mesh;
}

}  // namespace defocus::engine
