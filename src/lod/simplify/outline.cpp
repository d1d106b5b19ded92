#include "lod/simplify/outline.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "lod/simplify/triangle.h"

namespace defocus {

namespace {

constexpr int leastResolution = 128;
constexpr int mostResolution = 512;
constexpr double cellsPerEdge = 16;  // about, of an even mesh
constexpr double gridMargin = 1.04;  // of the box's diagonal; levels may stand out a little

constexpr int localRounds = 2;        // each edge of an outline follows level 0's
constexpr int mostGlobalRounds = 12;  // the covered area of each direction becomes level 0's
// Relative differences of areas. Levels of many triangles take time, and mostly cover enough.
constexpr double goodEnough = 1.5e-3;
constexpr double passable = 3.5e-3;
constexpr std::size_t fewTriangles = 2048;
constexpr double mostWay = 48;  // cells between an edge and level 0's outline, beyond which it is another part's
constexpr int mostEdgePoints = 24;
constexpr double stiffness = 0.1;       // of a vertex against moves that few outlines ask for, as a share of all
constexpr double mostMoveShare = 0.25;  // of the mean length of the edges at a vertex, a round
constexpr double constraintSlack = 1e-3;

// Solves (M + slack·d) x = b by Cholesky's decomposition (Eigen would be a dependency for these lines alone), d the
// mean of M's diagonal; of the n × n values of `matrix`, row by row, those on and below the diagonal are read. M is
// positive semi-definite, slack > 0. Zero where M is.
std::vector<double> solvedSymmetric(std::vector<double> matrix, std::vector<double> b, double slack) {
    const std::size_t n = b.size();
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += matrix[i * n + i];
    if (!(trace > 0)) return std::vector<double>(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        matrix[i * n + i] += slack * trace / static_cast<double>(n);
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = matrix[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= matrix[i * n + k] * matrix[j * n + k];
            matrix[i * n + j] = i == j ? std::sqrt(sum) : sum / matrix[j * n + j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= matrix[i * n + k] * b[k];
        b[i] /= matrix[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= matrix[k * n + i] * b[k];
        b[i] /= matrix[i * n + i];
    }
    return b;
}

// An edge with one or two of its faces.
struct Edge {
    std::uint32_t a = 0, b = 0;  // places, a < b
    std::uint32_t third[2] = {0, 0};
    std::uint32_t face[2] = {0, 0};
    int faces = 0;  // more than two: it counts as an open one
};

std::vector<Edge> edgesOf(std::span<const std::uint32_t> corners) {
    std::vector<Edge> all;
    all.reserve(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[i + k];
            const std::uint32_t b = corners[i + (k + 1) % 3];
            if (a == b) continue;
            Edge edge{std::min(a, b), std::max(a, b)};
            edge.third[0] = corners[i + (k + 2) % 3];
            edge.face[0] = static_cast<std::uint32_t>(i / 3);
            edge.faces = 1;
            all.push_back(edge);
        }
    std::stable_sort(all.begin(), all.end(),
                     [](const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    std::vector<Edge> edges;
    for (const Edge& edge : all) {
        if (edges.empty() || edges.back().a != edge.a || edges.back().b != edge.b) {
            edges.push_back(edge);
            continue;
        }
        Edge& known = edges.back();
        if (known.faces == 1) {
            known.third[1] = edge.third[0];
            known.face[1] = edge.face[0];
        }
        ++known.faces;
    }
    return edges;
}

// A part of a level's outline: where it lies on an edge, and how far level 0's is beyond it.
struct OutlinePoint {
    std::uint32_t a = 0, b = 0;  // places
    double share = 0;            // of b in the point
    double length = 0;           // object units of the outline
    glm::dvec3 outward{0};       // unit length
    double way = 0;              // object units along it; NaN where level 0's outline is out of reach
};

// Cells from `start` along `outward` to where level 0 begins or ends to be covered; NaN if that is far.
double wayToOutline(const CoverGrid& level0, const glm::dvec2& start, const glm::dvec2& outward) {
    const bool inside = level0.covers(start);
    const double sign = inside ? 1 : -1;
    for (double way = 0.5; way < mostWay; way += 0.5)
        if (level0.covers(start + sign * way * outward) != inside) return sign * (way - 0.25);
    return std::numeric_limits<double>::quiet_NaN();
}

// The largest relative difference of a covered area.
double worstArea(std::span<const glm::vec3> places, std::span<const std::uint32_t> corners,
                 std::span<const CoverGrid> outlines) {
    double worst = 0;
    for (const CoverGrid& level0 : outlines) {
        CoverGrid own = level0.emptied();
        own.add(places, corners);
        if (const double wanted = level0.area(); wanted > 0) worst = std::max(worst, std::abs(own.area() / wanted - 1));
    }
    return worst;
}

class OutlineFit {
public:
    OutlineFit(std::vector<glm::vec3> places, std::span<const std::uint32_t> corners, const Bounds& box)
        : places_(std::move(places)), corners_(corners.begin(), corners.end()), edges_(edgesOf(corners)), box_(box) {
        original_ = places_;
        std::vector<double> counts(places_.size(), 0);
        mostMove_.assign(places_.size(), 0);
        for (const Edge& edge : edges_)
            for (const std::uint32_t v : {edge.a, edge.b}) {
                mostMove_[v] += glm::distance(glm::dvec3(places_[edge.a]), glm::dvec3(places_[edge.b]));
                counts[v] += 1;
            }
        for (std::size_t v = 0; v < places_.size(); ++v)
            if (counts[v] > 0) mostMove_[v] *= mostMoveShare / counts[v];
    }

    void followLocally(std::span<const CoverGrid> outlines) {
        std::vector<glm::dmat3> pulls(places_.size(), glm::dmat3(0));
        std::vector<glm::dvec3> targets(places_.size(), glm::dvec3(0));
        std::vector<double> weights(places_.size(), 0);
        for (const CoverGrid& level0 : outlines)
            forEachPoint(level0, [&](const OutlinePoint& point) {
                if (std::isnan(point.way)) return;
                const auto add = [&](std::uint32_t v, double weight) {
                    weight *= point.length;
                    pulls[v] += weight * glm::outerProduct(point.outward, point.outward);
                    targets[v] += weight * point.way * point.outward;
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

    // The smallest moves after which each direction has its area, to first order. False where all have it already.
    bool matchAreas(std::span<const CoverGrid> outlines) {
        std::vector<std::vector<glm::dvec3>> gradients(outlines.size(),
                                                       std::vector<glm::dvec3>(places_.size(), glm::dvec3(0)));
        std::vector<double> missing(outlines.size(), 0);
        bool matched = true;
        for (std::size_t d = 0; d < outlines.size(); ++d) {
            const double own = forEachPoint(outlines[d], [&](const OutlinePoint& point) {
                gradients[d][point.a] += point.length * (1 - point.share) * point.outward;
                gradients[d][point.b] += point.length * point.share * point.outward;
            });
            missing[d] = outlines[d].area() - own;
            matched = matched && std::abs(missing[d]) <= goodEnough * outlines[d].area();
        }
        if (matched) return false;
        const std::vector<double> factors = solved(gradients, missing);
        std::vector<glm::dvec3> moves(places_.size(), glm::dvec3(0));
        for (std::size_t d = 0; d < outlines.size(); ++d)
            for (std::size_t v = 0; v < moves.size(); ++v) moves[v] += factors[d] * gradients[d][v];
        move(moves);
        return true;
    }

    [[nodiscard]] const std::vector<glm::vec3>& places() const { return places_; }

private:
    // Visits points of the level's outline; the area that the level covers.
    template <typename Visit>
    double forEachPoint(const CoverGrid& level0, const Visit& visit) const {
        CoverGrid own = level0.emptied();
        own.add(places_, corners_);
        std::vector<glm::dvec2> cells;
        cells.reserve(places_.size());
        for (const glm::vec3& place : places_) cells.push_back(own.cellsOf(place));
        const auto turn = [&](std::uint32_t face) {
            const glm::dvec2& p = cells[corners_[3 * face]];
            const glm::dvec2 q = cells[corners_[3 * face + 1]] - p;
            const glm::dvec2 r = cells[corners_[3 * face + 2]] - p;
            return q.x * r.y - q.y * r.x;
        };
        for (const Edge& edge : edges_) {
            if (edge.faces == 2 && turn(edge.face[0]) * turn(edge.face[1]) > 0) continue;
            const glm::dvec2& from = cells[edge.a];
            const glm::dvec2 along = cells[edge.b] - from;
            const double length = glm::length(along);
            if (!(length > 1e-6)) continue;
            glm::dvec2 outward(along.y / length, -along.x / length);
            if (glm::dot(outward, cells[edge.third[0]] - from) > 0) outward = -outward;
            const int count = std::clamp(static_cast<int>(std::ceil(length)), 1, mostEdgePoints);
            for (int i = 0; i < count; ++i) {
                const double share = (i + 0.5) / count;
                const glm::dvec2 start = from + share * along;
                if (own.covers(start + outward) || own.covers(start + 2.0 * outward)) continue;
                const double way = wayToOutline(level0, start, outward);
                visit(OutlinePoint{edge.a, edge.b, share, own.cell() * length / count, own.inSpace(outward),
                                   own.cell() * way});
            }
        }
        return own.area();
    }

    // The least factors x with (G Gᵀ) x = b, slightly damped.
    static std::vector<double> solved(const std::vector<std::vector<glm::dvec3>>& gradients, std::vector<double> b) {
        const std::size_t n = b.size();
        std::vector<double> matrix(n * n, 0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                for (std::size_t v = 0; v < gradients[i].size(); ++v)
                    matrix[i * n + j] += glm::dot(gradients[i][v], gradients[j][v]);
        return solvedSymmetric(std::move(matrix), std::move(b), constraintSlack);
    }

    void move(const std::vector<glm::dvec3>& moves) {
        for (std::size_t v = 0; v < places_.size(); ++v) {
            const double length = glm::length(moves[v]);
            if (!(length > 0) || !std::isfinite(length)) continue;
            const glm::dvec3 bounded = moves[v] * std::min(1.0, mostMove_[v] / length);
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
    std::vector<Edge> edges_;
    std::vector<double> mostMove_;  // of each place
    const Bounds& box_;
};

}  // namespace

std::array<glm::dvec3, outlineDirections> directionsOfOutlines() {
    std::array<glm::dvec3, outlineDirections> directions;
    for (int i = 0; i < 13; ++i)
        directions[static_cast<std::size_t>(i)] = glm::normalize(glm::dvec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
    return directions;
}

CoverGrid::CoverGrid(const Bounds& box, const glm::dvec3& direction, int resolution)
    : centre_(box.centre()), cell_(gridMargin * glm::length(box.size()) / resolution), resolution_(resolution) {
    const glm::dvec3 other = std::abs(direction.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    across_ = glm::normalize(glm::cross(direction, other));
    up_ = glm::cross(direction, across_);
    if (!(cell_ > 0) || !std::isfinite(cell_)) resolution_ = 0;
    cells_.assign(static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_) / 64, 0);
}

CoverGrid CoverGrid::emptied() const {
    CoverGrid result = *this;
    std::fill(result.cells_.begin(), result.cells_.end(), 0);
    return result;
}

glm::dvec2 CoverGrid::cellsOf(const glm::vec3& position) const {
    const glm::dvec3 p = (glm::dvec3(position) - centre_) / cell_;
    return 0.5 * resolution_ + glm::dvec2(glm::dot(p, across_), glm::dot(p, up_));
}

bool CoverGrid::covers(const glm::dvec2& cells) const {
    if (!(cells.x >= 0 && cells.y >= 0 && cells.x < resolution_ && cells.y < resolution_)) return false;
    const auto column = static_cast<std::size_t>(cells.x);
    const std::size_t row = static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(resolution_) / 64;
    return (cells_[row + column / 64] >> column % 64 & 1) != 0;
}

double CoverGrid::area() const {
    std::size_t count = 0;
    for (const std::uint64_t word : cells_) count += static_cast<std::size_t>(std::popcount(word));
    return cell_ * cell_ * static_cast<double>(count);
}

void CoverGrid::add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    if (resolution_ == 0) return;
    std::vector<glm::dvec2> cells;
    cells.reserve(positions.size());
    for (const glm::vec3& position : positions) cells.push_back(cellsOf(position));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        cover(cells[indices[i]], cells[indices[i + 1]], cells[indices[i + 2]]);
}

void CoverGrid::cover(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    if (!std::isfinite(a.x + a.y + b.x + b.y + c.x + c.y)) return;
    // The first of the cells' middles at or after a place, which is brought into the grid.
    const double end = resolution_;
    const auto firstAt = [&](double place) {
        const double bounded = std::min(std::max(place - 0.5, 0.0), end);
        const int whole = static_cast<int>(bounded);
        return whole + (whole < bounded ? 1 : 0);
    };
    const int firstRow = firstAt(std::min(std::min(a.y, b.y), c.y));
    const int endRow = firstAt(std::max(std::max(a.y, b.y), c.y));
    if (firstRow == endRow) return;
    const glm::dvec2* const corners[4] = {&a, &b, &c, &a};
    for (int row = firstRow; row < endRow; ++row) {
        const double y = row + 0.5;
        double from = end;
        double to = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2& p = *corners[k];
            const glm::dvec2& q = *corners[k + 1];
            if ((p.y <= y) == (q.y <= y)) continue;
            const double x = p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        const int first = firstAt(from);
        const int last = firstAt(to);
        std::uint64_t* const words =
            &cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_) / 64];
        for (int word = first / 64; 64 * word < last; ++word) {
            const int low = std::max(first - 64 * word, 0);
            const int high = std::min(last - 64 * word, 64);
            if (low < high) words[word] |= (~std::uint64_t{0} >> (64 - (high - low))) << low;
        }
    }
}

std::vector<CoverGrid> outlinesOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                  const Bounds& box) {
    const double edges = std::sqrt(static_cast<double>(indices.size()) / 3);
    const int wanted = 64 * static_cast<int>(std::min(cellsPerEdge * edges, double{mostResolution}) / 64);
    const int resolution = std::clamp(wanted, leastResolution, mostResolution);
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
    if (worstArea(at, corners, outlines) <= enough) return;
    OutlineFit fit(std::move(at), corners, box);
    for (int round = 0; round < localRounds; ++round) fit.followLocally(outlines);
    for (int round = 0; round < mostGlobalRounds && fit.matchAreas(outlines); ++round) {
    }
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = fit.places()[places[v]];
}

}  // namespace defocus
