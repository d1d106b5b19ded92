#include "lod/simplify/wedges.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <type_traits>

namespace defocus::engine {

namespace {

// Min range by which blur values are divided: dimensionless for blur factors, in mm for added blur.
constexpr float minBlurRange = 1e-3f;
// Triangles of lower quality are slivers. Quality: twice the area / sum of the squared edge lengths; 0.29 for an
// equilateral triangle.
constexpr double minQuality = 1e-3;

// Returns the attribute differences `to` − `from` between two wedges with n attributes each.
template <std::size_t n>
AttributeRow<n> changeBetween(std::span<const float> from, std::span<const float> to) {
    AttributeRow<n> result;
    for (std::size_t j = 0; j < n; ++j) result[j] = to[j] - from[j];
    return result;
}

template <std::size_t n>
AttributeRow<n> rowOf(std::span<const float> row) {
    AttributeRow<n> result;
    std::copy_n(row.begin(), n, result.begin());
    return result;
}

// Returns the sum of the squared differences of the weighted attributes [first, last).
double squares(std::span<const float> a, std::span<const float> b, std::size_t first, std::size_t last) {
    float sum = 0;
    for (std::size_t j = first; j < last; ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
    return double{sum};
}

template <std::size_t n>
AttributeQuadric<n> quadricOf(const WedgeTable& table, const WedgeNumber* corners, const glm::dvec3* places,
                              float weight) {
    AttributeRow<n> rows[3];
    const AttributeRow<n>* rowsOf[3];
    const glm::dvec3* points[3];
    for (std::size_t i = 0; i < 3; ++i) {
        rows[i] = rowOf<n>(table.row(corners[i]));
        rowsOf[i] = &rows[i];
        points[i] = &places[i];
    }
    AttributeQuadric<n> face;
    face.addFace(attributeGradients(points, rowsOf), weight);
    return face;
}

}  // namespace

void WedgeTable::assign(const Vertices& vertices, float uvScale) {
    hasColors_ = !vertices.colors.empty();
    hasBlurs_ = !vertices.blurs.empty();
    hasUv_ = !vertices.uv0.empty();
    attributeCount_ = std::size_t{3} + (hasColors_ ? 3 : 0) + (hasBlurs_ ? 3 : 0) + (hasUv_ ? 2 : 0);
    const VertexBlurBounds blurs = boundsOf(vertices.blurs);
    const float perFactor = blurWeight / std::max(blurs.factorMax - blurs.factorMin, minBlurRange);
    const float perMillimetre = blurWeight / std::max(blurs.addedMax - blurs.addedMin, minBlurRange);
    sources_.resize(vertices.count());
    rows_.clear();
    rows_.reserve(attributeCount_ * vertices.count());
    for (std::size_t v = 0; v < sources_.size(); ++v) {
        sources_[v] = itemAt<MeshVertexNumber>(v);
        const glm::vec3 normal = vertices.normals.empty() ? glm::vec3(0) : normalWeight * vertices.normals[v];
        rows_.insert(rows_.end(), {normal.x, normal.y, normal.z});
        if (hasColors_) {
            const glm::vec3 color = colorWeight * glm::vec3(vertices.colors[v]);
            rows_.insert(rows_.end(), {color.x, color.y, color.z});
        }
        if (hasBlurs_) {
            const VertexBlur& blur = vertices.blurs[v];
            rows_.insert(rows_.end(),
                         {perFactor * blur.factor, perMillimetre * blur.opening, perMillimetre * blur.closing});
        }
        if (hasUv_) {
            const glm::vec2 uv = uvWeight * uvScale * vertices.uv0[v];
            rows_.insert(rows_.end(), {uv.x, uv.y});
        }
    }
}

bool WedgeTable::changes(const WedgeNumber* corners) const {
    const auto first = row(corners[0]);
    return !std::ranges::equal(first, row(corners[1])) || !std::ranges::equal(first, row(corners[2]));
}

void WedgeTable::startQuadrics(const std::vector<bool>& changing) {
    const std::size_t count = sources_.size();
    switch (attributeCount_) {
        case 3:
            if (2 * static_cast<std::size_t>(std::ranges::count(changing, true)) < count)
                quadrics_.emplace<SparseQuadrics<3>>(changing);
            else
                quadrics_.emplace<DenseQuadrics<3>>(count);
            break;
        case 5:
            quadrics_.emplace<DenseQuadrics<5>>(count);
            break;
        case 6:
            quadrics_.emplace<DenseQuadrics<6>>(count);
            break;
        case 8:
            quadrics_.emplace<DenseQuadrics<8>>(count);
            break;
        case 9:
            quadrics_.emplace<DenseQuadrics<9>>(count);
            break;
        default:
            quadrics_.emplace<DenseQuadrics<11>>(count);
            break;
    }
}

void WedgeTable::keep(std::span<const WedgeNumber> order) {
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t w = order[i].value;
        sources_[i] = sources_[w];
        std::copy_n(&rows_[w * attributeCount_], attributeCount_, &rows_[i * attributeCount_]);
    }
    sources_.resize(order.size());
    rows_.resize(order.size() * attributeCount_);
    giveBackRoom(sources_);
    giveBackRoom(rows_);
    std::visit([&](auto& quadrics) { quadrics.keep(order); }, quadrics_);
}

double WedgeTable::uvDifference(WedgeNumber a, WedgeNumber b) const {
    if (!hasUv_) return 0;
    return squares(row(a), row(b), attributeCount_ - 2, attributeCount_) / double{uvWeight * uvWeight};
}

double WedgeTable::difference(WedgeNumber a, WedgeNumber b) const {
    const double normals = squares(row(a), row(b), 0, 3) / double{normalWeight * normalWeight};
    const double colors = hasColors_ ? squares(row(a), row(b), 3, 6) / double{colorWeight * colorWeight} : 0;
    const std::size_t first = hasColors_ ? 6 : 3;
    const double blurs = hasBlurs_ ? squares(row(a), row(b), first, first + 3) / double{blurWeight * blurWeight} : 0;
    return normals + 4 * (colors + blurs) + uvDifference(a, b);
}

void WedgeTable::addFace(const WedgeNumber* corners, const glm::dvec3* places) {
    double squaredEdges = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = places[(i + 1) % 3] - places[i];
        squaredEdges += glm::dot(edge, edge);
    }
    const double doubleArea = glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
    if (!(doubleArea > minQuality * squaredEdges)) return;
    std::visit(
        [&](auto& quadrics) {
            constexpr std::size_t n = std::remove_cvref_t<decltype(quadrics)>::attributes;
            const auto face = quadricOf<n>(*this, corners, places, static_cast<float>(doubleArea / 6));
            for (std::size_t i = 0; i < 3; ++i) quadrics.addFace(corners[i], face);
        },
        quadrics_);
}

float WedgeTable::cost(WedgeNumber from, WedgeNumber to, const glm::vec3& step) const {
    return std::visit(
        [&](const auto& quadrics) {
            constexpr std::size_t n = std::remove_cvref_t<decltype(quadrics)>::attributes;
            return quadrics[from].at(step, changeBetween<n>(row(from), row(to))) + quadrics.costInPlace(to);
        },
        quadrics_);
}

void WedgeTable::moveQuadric(WedgeNumber from, WedgeNumber to, const glm::vec3& step) {
    std::visit(
        [&](auto& quadrics) {
            constexpr std::size_t n = std::remove_cvref_t<decltype(quadrics)>::attributes;
            if (!(quadrics[from].squares.weight > 0)) return;
            quadrics.move(from, to, step, changeBetween<n>(row(from), row(to)));
        },
        quadrics_);
}

void WedgeTable::prefetchStart(WedgeNumber w) const {
    __builtin_prefetch(&rows_[w.value * attributeCount_]);
    std::visit([&](const auto& quadrics) { quadrics.prefetchStart(w); }, quadrics_);
}

void WedgeTable::prefetch(WedgeNumber w) const {
    __builtin_prefetch(&rows_[w.value * attributeCount_]);
    std::visit([&](const auto& quadrics) { quadrics.prefetch(w); }, quadrics_);
}

}  // namespace defocus::engine
