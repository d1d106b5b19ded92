#include "lod/simplify/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/memory.h"
#include "lod/simplify/damped_solve.h"
#include "lod/simplify/triangle.h"

namespace defocus::engine {

namespace {

using LightRow = std::array<float, lightCount>;

// Directions to the lights, one array per coordinate, so that compilers vectorise loops over them.
struct Lights {
    LightRow x, y, z;
};

Lights lights() {
    Lights result;
    const auto directions = directionsToLights();
    for (std::size_t l = 0; l < lightCount; ++l) {
        result.x[l] = static_cast<float>(directions[l].x);
        result.y[l] = static_cast<float>(directions[l].y);
        result.z[l] = static_cast<float>(directions[l].z);
    }
    return result;
}

struct LitPoint {
    glm::vec3 weights{0};  // barycentric coordinates of the point
    glm::vec3 normal{0};   // unit normal, or zero if undefined
    float agreement = 1;
    float area = 0;
    float light = 0;  // area times the mean of the three channels of the vertex colour
};

// Calls visit(corners, point) for sample points of the surface; `corners` are the vertex indices of the point's
// triangle. Returns the surface area.
template <typename Visit>
double forEachLitPoint(const LitSurface& surface, std::size_t minPoints, const Visit& visit) {
    const std::size_t triangles = surface.indices.size() / 3;
    const double wanted = std::sqrt(static_cast<double>(minPoints) / static_cast<double>(3 * triangles + 1));
    const int parts = std::max(1, static_cast<int>(std::ceil(wanted)));
    double areas = 0;
    for (std::size_t i = 0; i < 3 * triangles; i += 3) {
        const std::uint32_t* const v = &surface.indices[i];
        const glm::dvec3 a = surface.positions[v[0]];
        const double area = 0.5 * glm::length(glm::cross(glm::dvec3(surface.positions[v[1]]) - a,
                                                         glm::dvec3(surface.positions[v[2]]) - a));
        if (!(area > 0) || !std::isfinite(area)) continue;
        areas += area;
        float lengths[3];
        float colors[3];
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] = surface.coarse ? glm::length(surface.normals[v[k]]) : 1;
            const glm::vec4 color = surface.colors.empty() ? glm::vec4(1) : surface.colors[v[k]];
            colors[k] = (color.r + color.g + color.b) / 3;
        }
        forEachTrianglePoint(parts, [&](const glm::dvec3& at, double share) {
            LitPoint point;
            const glm::vec3 w = point.weights = glm::vec3(at);
            const glm::vec3 normal =
                w.x * surface.normals[v[0]] + w.y * surface.normals[v[1]] + w.z * surface.normals[v[2]];
            const float length = glm::length(normal);
            if (length > 0) point.normal = normal / length;
            point.agreement =
                std::clamp(w.x * lengths[0] + w.y * lengths[1] + w.z * lengths[2], minShownAgreement, 1.0f);
            point.area = static_cast<float>(share * area);
            point.light = point.area * (w.x * colors[0] + w.y * colors[1] + w.z * colors[2]);
            visit(v, point);
        });
    }
    return areas;
}

constexpr std::size_t pairCount = lightCount / 2;  // number of pairs of opposite lights
using PairRow = std::array<float, pairCount>;

// Derivatives of the surface's mean radiance under each light with respect to the x, y and z coordinates of a normal.
struct LightSlopes {
    LightRow x, y, z;
};

// Derivatives of the surface's mean radiance under each light with respect to the normal of a vertex group, as a sum of
// two terms. For a light direction d, the first term is M · d with a symmetric matrix M; it changes sign with d. The
// second term is the same for opposite lights.
struct GroupSlopes {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // elements of the matrix M
    PairRow x{}, y{}, z{};                                 // second term, for each pair of opposite lights

    void add(float weight, const GroupSlopes& other) {
        xx += weight * other.xx;
        xy += weight * other.xy;
        xz += weight * other.xz;
        yy += weight * other.yy;
        yz += weight * other.yz;
        zz += weight * other.zz;
        for (std::size_t l = 0; l < pairCount; ++l) {
            x[l] += weight * other.x[l];
            y[l] += weight * other.y[l];
            z[l] += weight * other.z[l];
        }
    }

    [[nodiscard]] LightSlopes of(const Lights& lights) const {
        LightSlopes all;
        for (std::size_t l = 0; l < lightCount; ++l) {
            const std::size_t pair = l % pairCount;
            all.x[l] = xx * lights.x[l] + xy * lights.y[l] + xz * lights.z[l] + x[pair];
            all.y[l] = xy * lights.x[l] + yy * lights.y[l] + yz * lights.z[l] + y[pair];
            all.z[l] = xz * lights.x[l] + yz * lights.y[l] + zz * lights.z[l] + z[pair];
        }
        return all;
    }
};

// Returns the derivatives of meanCosine() under each light with respect to the point's normal. The derivative in the
// direction of the normal is 0. `values` receives the values of meanCosine().
GroupSlopes slopesAt(const Lights& lights, const LitPoint& point, LightRow& values) {
    // Lower bound of `root`, by which the derivatives are divided. `root` approaches 0 at grazing incidence if the
    // normals averaged into `point.normal` are nearly parallel.
    constexpr float minRoot = 0.02f;
    const glm::vec3& n = point.normal;
    const float half = 0.5f * point.agreement;
    const float spread = normalSpread(point.agreement);
    GroupSlopes slopes;
    slopes.xx = half * (1 - n.x * n.x);
    slopes.xy = half * -n.x * n.y;
    slopes.xz = half * -n.x * n.z;
    slopes.yy = half * (1 - n.y * n.y);
    slopes.yz = half * -n.y * n.z;
    slopes.zz = half * (1 - n.z * n.z);
    for (std::size_t l = 0; l < pairCount; ++l) {
        const float cosine = n.x * lights.x[l] + n.y * lights.y[l] + n.z * lights.z[l];
        const float mean = point.agreement * cosine;
        const float root = std::sqrt(mean * mean + spread * std::max(1 - cosine * cosine, 0.0f));
        values[l] = 0.5f * (root + mean);
        values[l + pairCount] = 0.5f * (root - mean);
        const float even = 0.5f * (point.agreement * mean - spread * cosine) / std::max(root, minRoot);
        slopes.x[l] = even * (lights.x[l] - cosine * n.x);
        slopes.y[l] = even * (lights.y[l] - cosine * n.y);
        slopes.z[l] = even * (lights.z[l] - cosine * n.z);
    }
    return slopes;
}

// Mean radiance under each light, and its derivatives with respect to the normals of vertex groups.
struct FollowingMeans {
    LightMeans means{};
    std::vector<float> areas;  // area of each vertex group, as a fraction of the surface's area
    LargeVector<GroupSlopes> slopes;
};

// Computes the mean radiance of the surface under each light, and the derivatives of this mean with respect to the
// normals of the vertex groups. Reuses the memory of `result`.
void follow(const LitSurface& surface, std::span<const std::uint32_t> groups, std::size_t minPoints,
            FollowingMeans& result) {
    const Lights from = lights();
    result.means = {};
    result.areas.assign(groups.size(), 0);
    result.slopes.assign(groups.size(), GroupSlopes{});
    const double area = forEachLitPoint(surface, minPoints, [&](const std::uint32_t* corners, const LitPoint& point) {
        LightRow values;
        const GroupSlopes slopes = slopesAt(from, point, values);
        for (std::size_t l = 0; l < lightCount; ++l) result.means[l] += double{point.light * values[l]};
        for (glm::length_t k = 0; k < 3; ++k) {
            const std::uint32_t group = groups[corners[k]];
            result.areas[group] += point.weights[k] * point.area;
            result.slopes[group].add(point.weights[k] * point.light, slopes);
        }
    });
    if (!(area > 0)) return;
    for (double& mean : result.means) mean /= area;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        GroupSlopes scaled;
        scaled.add(static_cast<float>(1 / area), result.slopes[g]);
        result.slopes[g] = scaled;
        result.areas[g] *= static_cast<float>(1 / area);
    }
}

// Returns the smallest change in the vertex groups' normals that changes the mean radiance under each light by
// approximately `wanted`. `damping` is relative to the mean diagonal element of the linear system's matrix; a larger
// value gives a smaller change. Damping is needed because the matrix is nearly singular: of the mean radiances under
// the 26 lights, only about nine are independent.
std::vector<glm::vec3> smallestChange(const FollowingMeans& at, const LightMeans& wanted, double damping) {
    const Lights from = lights();
    std::vector<double> matrix(lightCount * lightCount, 0);
    for (std::size_t g = 0; g < at.areas.size(); ++g) {
        if (!(at.areas[g] > 0)) continue;
        const LightSlopes slopes = at.slopes[g].of(from);
        const float weight = 1 / at.areas[g];
        for (std::size_t i = 0; i < lightCount; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                matrix[i * lightCount + j] += double{
                    weight * (slopes.x[i] * slopes.x[j] + slopes.y[i] * slopes.y[j] + slopes.z[i] * slopes.z[j])};
    }
    const std::vector<double> factors = dampedSolution(matrix, wanted, damping);
    std::vector<glm::vec3> change(at.areas.size(), glm::vec3(0));
    for (std::size_t g = 0; g < change.size(); ++g) {
        if (!(at.areas[g] > 0)) continue;
        const LightSlopes slopes = at.slopes[g].of(from);
        for (std::size_t l = 0; l < lightCount; ++l)
            change[g] +=
                static_cast<float>(factors[l]) / at.areas[g] * glm::vec3(slopes.x[l], slopes.y[l], slopes.z[l]);
    }
    return change;
}

// Adds `change` to the normals of each vertex group and restores the lengths of the normals.
void turn(std::span<const glm::vec3> before, std::span<const std::uint32_t> groups, std::span<const glm::vec3> change,
          std::span<glm::vec3> after) {
    for (std::size_t v = 0; v < before.size(); ++v) {
        const float length = glm::length(before[v]);
        const glm::vec3 changed = before[v] + length * change[groups[v]];
        const float changedLength = glm::length(changed);
        after[v] = changedLength > 0 && std::isfinite(changedLength) ? changed * (length / changedLength) : before[v];
    }
}

// Returns the area-weighted RMS of the difference between two sets of normals.
double turned(std::span<const glm::vec3> before, std::span<const glm::vec3> after,
              std::span<const std::uint32_t> groups, const FollowingMeans& at) {
    double sum = 0;
    double areas = 0;
    for (std::size_t v = 0; v < before.size(); ++v) {
        const double area = at.areas[groups[v]];
        const glm::dvec3 change = glm::dvec3(after[v]) - glm::dvec3(before[v]);
        sum += area * glm::dot(change, change);
        areas += area;
    }
    return areas > 0 ? std::sqrt(sum / areas) : 0;
}

}  // namespace

std::array<glm::dvec3, lightCount> directionsToLights() {
    std::array<glm::dvec3, lightCount> directions;
    for (int i = 0; i < 13; ++i) {
        const auto d = static_cast<std::size_t>(i);
        directions[d] = glm::normalize(glm::dvec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
        directions[d + 13] = -directions[d];
    }
    return directions;
}

LightMeans lightMeans(const LitSurface& surface, std::size_t minPoints) {
    const Lights from = lights();
    LightMeans means{};
    const double area = forEachLitPoint(surface, minPoints, [&](const std::uint32_t*, const LitPoint& point) {
        const glm::vec3& n = point.normal;
        const float spread = normalSpread(point.agreement);
        LightRow values;
        for (std::size_t l = 0; l < lightCount; ++l) {
            const float cosine = n.x * from.x[l] + n.y * from.y[l] + n.z * from.z[l];
            values[l] = meanCosine(point.agreement * cosine, cosine, spread);
        }
        for (std::size_t l = 0; l < lightCount; ++l) means[l] += double{point.light * values[l]};
    });
    for (double& mean : means) mean = area > 0 ? mean / area : 0;
    return means;
}

void fitLight(std::span<const glm::vec3> positions, std::span<const glm::vec4> colors,
              std::span<const std::uint32_t> indices, std::span<const std::uint32_t> groups, const LightMeans& target,
              std::span<glm::vec3> normals) {
    constexpr int maxRounds = 8;
    constexpr double enough = 5e-4;
    // Rotating normals changes the shading at each point, and this change remains visible under a narrow blur. The RMS
    // change in the normals is therefore limited to this multiple of the reduction of the mean radiance's error (the
    // max over the lights).
    constexpr double maxTurn = 16;
    const std::vector<glm::vec3> original(normals.begin(), normals.end());
    std::vector<glm::vec3> best = original;
    double worstAtFirst = 0;
    FollowingMeans at;
    const auto followNormals = [&] { follow({positions, normals, colors, indices, true}, groups, pointsOfLight, at); };
    LightMeans wanted{};
    double minSquares = std::numeric_limits<double>::infinity();
    // Damping is strong at first, so that normals rotate no further than necessary and highlights keep their positions.
    double damping = 1;
    for (int round = 0; round < maxRounds; ++round) {
        followNormals();
        LightMeans rest{};
        double squares = 0;
        double worst = 0;
        for (std::size_t l = 0; l < lightCount; ++l) {
            rest[l] = target[l] - at.means[l];
            squares += rest[l] * rest[l];
            worst = std::max(worst, std::abs(rest[l]));
        }
        if (round == 0) worstAtFirst = worst;
        if (squares < minSquares) {
            if (round > 0 && turned(original, normals, groups, at) > maxTurn * (worstAtFirst - worst)) break;
            minSquares = squares;
            std::copy(normals.begin(), normals.end(), best.begin());
            wanted = rest;
            if (worst <= enough) break;
            damping *= 0.3;
        } else if (round > 0) {
            std::copy(best.begin(), best.end(), normals.begin());
            followNormals();
            damping *= 10;
        } else {
            return;  // the first round's squared error is NaN: keep the given normals
        }
        turn(best, groups, smallestChange(at, wanted, damping), normals);
    }
    std::copy(best.begin(), best.end(), normals.begin());
}

}  // namespace defocus::engine
