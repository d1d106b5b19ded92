#include "lod/simplify/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "lod/simplify/damped_solve.h"
#include "lod/simplify/triangle.h"

namespace defocus::engine {

namespace {

constexpr int minResolution = 128;
constexpr int maxResolution = 512;
constexpr double cellsPerEdge = 16;  // approximate number of grid cells per triangle edge, for evenly sized triangles

constexpr double maxUnseen = 5e-3;   // max relative area difference that is not corrected
constexpr int localRounds = 2;       // number of followLocally() rounds, which move each edge to level 0's outline
constexpr int maxGlobalRounds = 12;  // max number of matchAreas() rounds, which match covered areas to level 0's
// Max relative difference between the covered areas of the level and of level 0 at which the fit ends. `passable` is
// for levels with more than `fewTriangles` triangles: they are slow to fit, and most of them already cover nearly the
// right area.
constexpr double goodEnough = 1.5e-3;
constexpr double passable = 3.5e-3;
constexpr std::size_t fewTriangles = 2048;
constexpr int maxVainRounds = 4;  // max number of consecutive rounds without improvement
// Max distance to level 0's outline, in grid cells. Outlines farther away belong to other parts of the mesh.
constexpr double maxWay = 48;
constexpr int maxEdgePoints = 24;
// Damping of displacements, relative to the total weight of a vertex's outline points.
constexpr double stiffness = 0.1;
constexpr double maxMoveShare = 0.25;  // max displacement per round, relative to the mean length of the vertex's edges
constexpr double constraintSlack = 1e-3;

// An edge between two vertex groups (vertices at the same position), with up to two of its faces.
struct Edge {
    std::uint32_t a = 0, b = 0;  // numbers of the vertex groups at the edge's ends, a < b
    std::uint32_t third = 0;     // vertex group at the third corner of face[0]
    std::uint32_t face[2] = {0, 0};
    // Direction in which each face runs along the edge. 1: from a to b; −1: from b to a; 0: no face.
    std::int8_t way[2] = {0, 0};
    bool closed = false;  // the edge has exactly two faces
};

struct Edges {
    std::vector<Edge> all;   // one edge per pair of vertex groups that an edge of the mesh joins
    std::vector<Edge> more;  // the third and further faces of edges, one entry each
};

Edges edgesOf(std::span<const std::uint32_t> corners, std::size_t placeCount) {
    // Index in `sides` of the first edge with the group as end `a`.
    std::vector<std::uint32_t> starts(placeCount + 1, 0);
    const auto forEachEdge = [&](const auto& visit) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = corners[i + k];
                const std::uint32_t b = corners[i + (k + 1) % 3];
                if (a == b) continue;
                Edge edge{std::min(a, b), std::max(a, b)};
                edge.third = corners[i + (k + 2) % 3];
                edge.face[0] = static_cast<std::uint32_t>(i / 3);
                edge.way[0] = a < b ? 1 : -1;
                visit(edge);
            }
    };
    forEachEdge([&](const Edge& edge) { ++starts[edge.a + 1]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Edge> sides(starts.back());
    std::vector<std::uint32_t> ends = starts;
    forEachEdge([&](const Edge& edge) { sides[ends[edge.a]++] = edge; });

    Edges edges;
    edges.all.reserve(sides.size() / 2);
    for (std::size_t place = 0; place < placeCount; ++place) {
        std::sort(sides.begin() + starts[place], sides.begin() + starts[place + 1],
                  [](const Edge& x, const Edge& y) { return x.b != y.b ? x.b < y.b : x.face[0] < y.face[0]; });
        for (std::size_t i = starts[place]; i < starts[place + 1]; ++i) {
            const Edge& side = sides[i];
            if (i == starts[place] || sides[i - 1].b != side.b) {
                edges.all.push_back(side);
                continue;
            }
            Edge& known = edges.all.back();
            known.closed = known.way[1] == 0;
            if (!known.closed) {
                edges.more.push_back(side);
                continue;
            }
            known.face[1] = side.face[0];
            known.way[1] = side.way[0];
        }
    }
    return edges;
}

// A sample point of a level's outline in the projection along one direction.
struct OutlinePoint {
    std::uint32_t a = 0, b = 0;  // vertex groups at the ends of the edge
    double share = 0;            // interpolation weight of vertex group b; the weight of group a is 1 − share
    double length = 0;           // outline length that the point represents, object units
    glm::dvec2 start{0};         // position of the sample point, in units of grid cells
    glm::dvec2 across{0};        // outward unit normal of the outline
};

// Returns the signed distance, in grid cells, from `start` along `outward` to level 0's outline. It is positive if
// level 0 covers `start`, and NaN if the outline is farther away than maxWay.
double wayToOutline(const CoverGrid& level0, const glm::dvec2& start, const glm::dvec2& outward) {
    const bool inside = level0.covers(start);
    const double sign = inside ? 1 : -1;
    for (double way = 0.5; way < maxWay; way += 0.5)
        if (level0.covers(start + sign * way * outward) != inside) return sign * (way - 0.25);
    return std::numeric_limits<double>::quiet_NaN();
}

class OutlineFit {
public:
    OutlineFit(std::vector<glm::vec3> places, std::span<const std::uint32_t> corners,
               std::span<const CoverGrid> outlines, const Bounds& box)
        : places_(std::move(places)),
          corners_(corners.begin(), corners.end()),
          edges_(edgesOf(corners, places_.size())),
          outlines_(outlines),
          box_(box),
          fill_(outlines.front().resolution()),
          turns_(corners.size() / 3) {
        original_ = places_;
        for (const CoverGrid& level0 : outlines) areas_.push_back(level0.area());
        std::vector<double> counts(places_.size(), 0);
        maxMove_.assign(places_.size(), 0);
        for (const Edge& edge : edges_.all)
            for (const std::uint32_t v : {edge.a, edge.b}) {
                maxMove_[v] += glm::distance(glm::dvec3(places_[edge.a]), glm::dvec3(places_[edge.b]));
                counts[v] += 1;
            }
        for (std::size_t v = 0; v < places_.size(); ++v)
            if (counts[v] > 0) maxMove_[v] *= maxMoveShare / counts[v];
    }

    // Returns the largest relative difference, over all projection directions, between the areas that the level and
    // level 0 cover.
    double worstArea() {
        double worst = 0;
        for (std::size_t d = 0; d < outlines_.size(); ++d) {
            CoverGrid own = outlines_[d].emptied();
            const double area = cover(own);
            if (areas_[d] > 0) worst = std::max(worst, std::abs(area / areas_[d] - 1));
        }
        return worst;
    }

    void followLocally() {
        std::vector<glm::dmat3> pulls(places_.size(), glm::dmat3(0));
        std::vector<glm::dvec3> targets(places_.size(), glm::dvec3(0));
        std::vector<double> weights(places_.size(), 0);
        for (const CoverGrid& level0 : outlines_)
            forEachPoint(level0, [&](const OutlinePoint& point) {
                const double way = level0.cell() * wayToOutline(level0, point.start, point.across);
                if (std::isnan(way)) return;
                const glm::dvec3 outward = level0.inSpace(point.across);
                const auto add = [&](std::uint32_t v, double weight) {
                    weight *= point.length;
                    pulls[v] += weight * glm::outerProduct(outward, outward);
                    targets[v] += weight * way * outward;
                    weights[v] += weight;
                };
                add(point.a, 1 - point.share);
                add(point.b, point.share);
            });
        std::vector<glm::dvec3> moves(places_.size(), glm::dvec3(0));
        for (std::size_t v = 0; v < moves.size(); ++v)
            if (weights[v] > 0) moves[v] = glm::inverse(pulls[v] + glm::dmat3(stiffness * weights[v])) * targets[v];
        move(moves);
    }

    // Moves the vertices as little as possible so that, to first order, the level covers the same area as level 0 in
    // each projection direction. Returns false, without moving vertices, if all areas agree within the relative
    // difference `enough` or recent rounds brought no improvement.
    bool matchAreas(double enough) {
        const std::size_t count = outlines_.size();
        gradients_.assign(count * places_.size(), glm::vec3(0));
        std::vector<double> missing(count, 0);
        double misfit = 0;
        double worst = 0;
        for (std::size_t d = 0; d < count; ++d) {
            const double own = forEachPoint(outlines_[d], [&](const OutlinePoint& point) {
                const glm::dvec3 outward = outlines_[d].inSpace(point.across);
                gradients_[count * point.a + d] += glm::vec3(point.length * (1 - point.share) * outward);
                gradients_[count * point.b + d] += glm::vec3(point.length * point.share * outward);
            });
            missing[d] = areas_[d] - own;
            if (!(areas_[d] > 0)) continue;
            const double relative = missing[d] / areas_[d];
            misfit += relative * relative;
            worst = std::max(worst, std::abs(relative));
        }
        const bool matched = worst <= enough;
        vainRounds_ = matched || misfit < minMisfit_ ? 0 : vainRounds_ + 1;
        if (vainRounds_ == 0) {
            minMisfit_ = misfit;
            worstOfBest_ = worst;
            best_ = places_;
        }
        if (matched || vainRounds_ == maxVainRounds) return false;
        const std::vector<double> factors = solved(gradients_, missing);
        std::vector<glm::dvec3> moves(places_.size(), glm::dvec3(0));
        for (std::size_t v = 0; v < moves.size(); ++v)
            for (std::size_t d = 0; d < count; ++d) moves[v] += factors[d] * glm::dvec3(gradients_[count * v + d]);
        move(moves);
        return true;
    }

    // Returns the current vertex positions, or the best earlier positions if the last rounds brought no improvement.
    [[nodiscard]] const std::vector<glm::vec3>& places() const { return vainRounds_ > 0 ? best_ : places_; }
    // Returns the result of worstArea() for the positions that places() returns.
    [[nodiscard]] double worst() { return vainRounds_ > 0 ? worstOfBest_ : worstArea(); }

private:
    // Marks the cells of the grid `own` that the level covers in the grid's projection direction, and returns the
    // covered area. Stores the projected positions and potential outline edges.
    double cover(CoverGrid& own) {
        cells_.clear();
        for (const glm::vec3& place : places_) cells_.push_back(own.cellsOf(place));
        for (std::size_t face = 0; face < turns_.size(); ++face) {
            const glm::dvec2& p = cells_[corners_[3 * face]];
            const glm::dvec2 q = cells_[corners_[3 * face + 1]] - p;
            const glm::dvec2 r = cells_[corners_[3 * face + 2]] - p;
            const double cross = q.x * r.y - q.y * r.x;
            turns_[face] = static_cast<std::int8_t>(std::isfinite(cross) ? (cross > 0) - (cross < 0) : 0);
        }
        rim_.clear();
        for (const Edge& edge : edges_.all) {
            const int first = turns_[edge.face[0]];
            const int second = turns_[edge.face[1]];
            const int left = edge.way[0] * first + edge.way[1] * second;
            if (left != 0) fill_.add(cells_[edge.a], cells_[edge.b], left);
            if (!edge.closed || first * second <= 0) rim_.push_back(&edge);
        }
        for (const Edge& edge : edges_.more)
            if (const int left = edge.way[0] * turns_[edge.face[0]]; left != 0)
                fill_.add(cells_[edge.a], cells_[edge.b], left);
        return own.cell() * own.cell() * static_cast<double>(fill_.fill(own));
    }

    // Calls `visit` for each sample point of the level's outline. Returns the covered area.
    template <typename Visit>
    double forEachPoint(const CoverGrid& level0, const Visit& visit) {
        CoverGrid own = level0.emptied();
        const double area = cover(own);
        for (const Edge* const rim : rim_) {
            const Edge& edge = *rim;
            const glm::dvec2& from = cells_[edge.a];
            const glm::dvec2 along = cells_[edge.b] - from;
            const double length = glm::length(along);
            if (!(length > 1e-6)) continue;
            glm::dvec2 across(along.y / length, -along.x / length);
            if (glm::dot(across, cells_[edge.third] - from) > 0) across = -across;
            const int count = std::clamp(static_cast<int>(std::ceil(length)), 1, maxEdgePoints);
            for (int i = 0; i < count; ++i) {
                const double share = (i + 0.5) / count;
                const glm::dvec2 start = from + share * along;
                if (own.covers(start + across) || own.covers(start + 2.0 * across)) continue;
                visit(OutlinePoint{edge.a, edge.b, share, own.cell() * length / count, start, across});
            }
        }
        return area;
    }

    // Solves (G Gᵀ) x = b for x, slightly damped. Row d of G is the gradient of the covered area in direction d. The
    // matrix is summed over the vertices; a vertex has a gradient only in directions where it lies on the outline, so
    // most gradients are zero and skipped.
    static std::vector<double> solved(const std::vector<glm::vec3>& gradients, const std::vector<double>& b) {
        const std::size_t n = b.size();
        std::vector<double> matrix(n * n, 0);
        std::vector<std::size_t> present;
        for (std::size_t first = 0; first < gradients.size(); first += n) {
            const glm::vec3* const at = &gradients[first];
            present.clear();
            for (std::size_t i = 0; i < n; ++i) {
                if (at[i] == glm::vec3(0)) continue;
                present.push_back(i);
                for (const std::size_t j : present) matrix[i * n + j] += glm::dot(glm::dvec3(at[i]), glm::dvec3(at[j]));
            }
        }
        return dampedSolution(matrix, b, constraintSlack);
    }

    void move(const std::vector<glm::dvec3>& moves) {
        for (std::size_t v = 0; v < places_.size(); ++v) {
            const double length = glm::length(moves[v]);
            if (!(length > 0) || !std::isfinite(length)) continue;
            const glm::dvec3 bounded = moves[v] * std::min(1.0, maxMove_[v] / length);
            places_[v] = glm::clamp(glm::vec3(glm::dvec3(places_[v]) + bounded), glm::vec3(box_.minimum),
                                    glm::vec3(box_.maximum));
        }
        keepFacesUpright(places_, original_, corners_.size() / 3, [&](std::size_t t) {
            return std::array{corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]};
        });
    }

    std::vector<glm::vec3> places_;
    std::vector<glm::vec3> original_;
    std::vector<std::uint32_t> corners_;
    Edges edges_;
    std::vector<double> maxMove_;  // max displacement of each vertex group per round
    std::span<const CoverGrid> outlines_;
    std::vector<double> areas_;  // area that level 0 covers in each grid of `outlines_`, object units squared
    const Bounds& box_;
    std::vector<glm::vec3> best_;  // positions after the best round
    // Sum of squared relative area differences after the best round.
    double minMisfit_ = std::numeric_limits<double>::infinity();
    double worstOfBest_ = std::numeric_limits<double>::infinity();
    int vainRounds_ = 0;                // rounds since the last improvement
    std::vector<glm::vec3> gradients_;  // gradients of the covered area: one per vertex group and direction
    // Temporary data of cover(), for one projection direction.
    EdgeFill fill_;
    std::vector<glm::dvec2> cells_;   // projected position of each vertex group
    std::vector<std::int8_t> turns_;  // per face: 1 counterclockwise, −1 clockwise, 0 edge-on
    std::vector<const Edge*> rim_;    // edges that may lie on the outline: not between two faces with the same winding
};

}  // namespace

std::array<glm::dvec3, outlineDirections> directionsOfOutlines() {
    std::array<glm::dvec3, outlineDirections> directions;
    for (int i = 0; i < 13; ++i)
        directions[static_cast<std::size_t>(i)] = glm::normalize(glm::dvec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
    return directions;
}

std::vector<CoverGrid> outlinesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                  const Bounds& box) {
    const double edges = std::sqrt(static_cast<double>(indices.size()) / 3);
    const int wanted = 64 * static_cast<int>(std::min(cellsPerEdge * edges, double{maxResolution}) / 64);
    const int resolution = std::clamp(wanted, minResolution, maxResolution);
    std::vector<CoverGrid> outlines;
    for (const glm::dvec3& direction : directionsOfOutlines())
        outlines.emplace_back(box, direction, resolution).add(positions, indices);
    return outlines;
}

void fitOutlines(std::span<glm::vec3> positions, std::span<const std::uint32_t> indices,
                 std::span<const std::uint32_t> places, std::span<const CoverGrid> outlines, const Bounds& box) {
    if (positions.empty() || outlines.empty() || !(outlines.front().cell() > 0)) return;
    std::vector<glm::vec3> at(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) at[places[v]] = positions[v];
    std::vector<std::uint32_t> corners;
    corners.reserve(indices.size());
    for (const std::uint32_t v : indices) corners.push_back(places[v]);
    const double enough = indices.size() > 3 * fewTriangles ? passable : goodEnough;
    OutlineFit fit(at, corners, outlines, box);
    if (fit.worstArea() <= maxUnseen) return;
    const auto matchAreas = [&](OutlineFit& own) {
        for (int round = 0; round < maxGlobalRounds && own.matchAreas(enough); ++round) {
        }
    };
    matchAreas(fit);
    std::vector<glm::vec3> best = fit.places();
    // If the fit is not good enough, try a second fit that starts with followLocally(), which fits the outline edge by
    // edge. The second fit moves vertices farther, and an edge may follow the outline of another part of the mesh. Use
    // it only if the covered area then differs less from level 0's in the worst projection direction.
    if (fit.worst() > maxUnseen) {
        OutlineFit other(std::move(at), corners, outlines, box);
        for (int round = 0; round < localRounds; ++round) other.followLocally();
        matchAreas(other);
        if (other.worst() < fit.worst()) best = other.places();
    }
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = best[places[v]];
}

}  // namespace defocus::engine
