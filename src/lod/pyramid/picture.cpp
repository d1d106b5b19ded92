#include "lod/pyramid/picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "lod/pyramid/four.h"
#include "lod/pyramid/picture_shading.h"

namespace defocus::engine {

namespace {

constexpr float backBias = 1e-3f;  // depth offset of back faces, in pixels, so that a front face wins at equal depth
constexpr float nothing = -std::numeric_limits<float>::infinity();  // depth of a pixel that no surface covers

constexpr int narrow = 8;  // if a triangle's box has at most this many columns, all of its pixels are tested

constexpr int lanes = 4;

// Returns the index of the first pixel in [first, end] whose centre is at or after the coordinate `place`.
int firstAt(float place, int first, int end) {
    const float bounded = std::min(std::max(static_cast<float>(first), place - 0.5f), static_cast<float>(end));
    const int truncated = static_cast<int>(bounded);
    return truncated + (static_cast<float>(truncated) < bounded ? 1 : 0);
}

// Computes the range of pixels in a row at which the barycentric weights of a triangle are positive.
class RowBounds {
public:
    explicit RowBounds(const Weights& weights)
        : steps_{weights.stepB, weights.stepC, -(weights.stepB + weights.stepC)}, origin_(weights.origin) {
        for (std::size_t k = 0; k < 3; ++k) inverse_[k] = 1 / steps_[k].x;
    }

    // Returns the pixels of row y in [left, right) whose centres may lie in the triangle. The range is up to one pixel
    // too wide on each side.
    [[nodiscard]] std::array<int, 2> within(int y, int left, int right) const {
        const float dy = static_cast<float>(y) + 0.5f - origin_.y;
        for (std::size_t k = 0; k < 3; ++k) {
            if (steps_[k].x == 0) continue;
            const float zero = origin_.x - ((k == 2 ? 1.0f : 0.0f) + steps_[k].y * dy) * inverse_[k];
            if (steps_[k].x > 0)
                left = firstAt(zero - 1, left, right);
            else
                right = firstAt(zero + 1, left, right);
        }
        return {left, right};
    }

private:
    glm::vec2 steps_[3];
    glm::vec2 origin_;
    float inverse_[3];
};

// Returns the box of pixels that `bounds` covers, enlarged by one pixel on each side for rounding.
CellBox cellsAround(const Eye& eye, const Bounds& bounds) {
    glm::vec3 min(std::numeric_limits<float>::infinity());
    glm::vec3 max = -min;
    for (const glm::dvec3& corner : bounds.corners()) {
        const glm::vec3 place = eye.place(glm::vec3(corner));
        min = glm::min(min, place);
        max = glm::max(max, place);
    }
    const auto down = [](int cell) { return cell / boxAlignment * boxAlignment; };
    const auto up = [&](int cell) { return std::min(down(cell + boxAlignment - 1), eye.resolution); };
    return {down(firstAt(min.x - 1, 0, eye.resolution)), up(firstAt(max.x + 1, 0, eye.resolution)),
            down(firstAt(min.y - 1, 0, eye.resolution)), up(firstAt(max.y + 1, 0, eye.resolution))};
}

// Returns the primitive that contains entry `first` of Pyramid::indices.
std::size_t primitiveAt(const PyramidLevel& level, std::uint32_t first) {
    const auto next = std::upper_bound(level.primitives.begin(), level.primitives.end(), first,
                                       [](std::uint32_t i, const IndexRange& range) { return i < range.first; });
    return static_cast<std::size_t>(next - level.primitives.begin()) - 1;
}

}  // namespace

glm::vec3 Eye::place(const glm::vec3& position) const {
    const glm::dvec3 p = cellsPerUnit * (glm::dvec3(position) - centre);
    return {glm::dot(p, right) + 0.5 * resolution, glm::dot(p, up) + 0.5 * resolution, glm::dot(p, towards)};
}

Eye eyeAlong(const Pyramid& pyramid, const glm::dvec3& towards, int resolution) {
    Eye eye;
    eye.centre = pyramid.bounds.centre();
    eye.towards = towards;
    eye.right = glm::normalize(glm::cross(glm::dvec3(0.36, 0.48, 0.8), towards));
    eye.up = glm::cross(towards, eye.right);
    eye.cellsPerUnit = resolution / glm::length(pyramid.bounds.size());
    eye.resolution = resolution;
    eye.box = cellsAround(eye, pyramid.bounds);
    return eye;
}

Painter::Painter(const Pyramid& pyramid, const Eye& eye, std::span<const Finish> finishes)
    : pyramid_(pyramid), eye_(eye), finishes_(finishes) {}

void Painter::drawTriangle(std::uint32_t first) {
    const std::uint32_t* const corners = &pyramid_.indices[first];
    const glm::vec3& p = places_[corners[0]];
    const glm::vec3& q = places_[corners[1]];
    const glm::vec3& r = places_[corners[2]];
    const CellBox& box = eye_.box;
    const int left = firstAt(std::min(std::min(p.x, q.x), r.x), box.left, box.right);
    const int right = firstAt(std::max(std::max(p.x, q.x), r.x), box.left, box.right);
    if (left >= right) return;
    const int bottom = firstAt(std::min(std::min(p.y, q.y), r.y), box.bottom, box.top);
    const int top = firstAt(std::max(std::max(p.y, q.y), r.y), box.bottom, box.top);
    if (bottom >= top) return;
    const Weights weights(p, q, r);
    if (weights.flat) return;
    const float stepZ1 = q.z - p.z;
    const float stepZ2 = r.z - p.z;
    const float z0 = p.z - (weights.back ? backBias : 0);
    std::optional<RowBounds> bounds;
    if (right - left > narrow) bounds.emplace(weights);
    for (int y = bottom; y < top; ++y) {
        const auto [begin, end] = bounds ? bounds->within(y, left, right) : std::array{left, right};
        const std::size_t row = box.indexOf(begin, y);
        for (int x = begin; x < end; x += lanes) {
            const Four places = static_cast<float>(x) + Four{0, 1, 2, 3};
            const auto [b, c] = weights.at(places, static_cast<float>(y));
            const Four z = z0 + b * stepZ1 + c * stepZ2;
            float* const depths = &depths_[row + static_cast<std::size_t>(x - begin)];
            std::uint32_t* const firsts = &firsts_[row + static_cast<std::size_t>(x - begin)];
            const Four before = loaded<Four>(depths);
            const auto nearer = (b >= 0) & (c >= 0) & (b + c <= 1) & (places < static_cast<float>(end)) & (z > before);
            store(depths, nearer ? z : before);
            store(firsts, nearer ? FourWords{} + first : loaded<FourWords>(firsts));
        }
    }
}

void Painter::draw(std::size_t number, Picture& picture) {
    const PyramidLevel& level = pyramid_.levels[number];
    const CellBox& box = eye_.box;
    // Pad the array of depths, because SIMD access to the last pixels reaches past their end.
    depths_.assign(box.count() + lanes, nothing);
    firsts_.resize(box.count() + lanes);
    places_.clear();
    for (const glm::vec3& position : level.positions) places_.push_back(eye_.place(position));
    for (const IndexRange& range : level.primitives)
        for (std::uint32_t i = 0; i < range.count; i += 3) drawTriangle(range.first + i);

    picture.light.assign(box.count(), glm::vec3(0));
    Shading shading(level, number > 0, eye_, picture.light);
    SeenTriangle triangle;
    for (int y = box.bottom; y < box.top; ++y) {
        std::size_t cell = box.indexOf(box.left, y);
        for (int x = box.left; x < box.right; ++x, ++cell) {
            if (depths_[cell] == nothing) continue;
            const std::uint32_t* const corners = &pyramid_.indices[firsts_[cell]];
            if (corners != triangle.corners)
                triangle = {corners, &finishes_[primitiveAt(level, firsts_[cell])],
                            Weights(places_[corners[0]], places_[corners[1]], places_[corners[2]]),
                            shading.lengths(corners)};
            shading.shade(triangle, cell, x, y);
        }
        shading.endRow();
    }
    picture.sum = shading.sum;
    picture.covered = shading.covered;
}

Picture pictureOf(const Pyramid& pyramid, std::size_t number, const Eye& eye, std::span<const Finish> finishes) {
    Picture picture;
    Painter(pyramid, eye, finishes).draw(number, picture);
    return picture;
}

}  // namespace defocus::engine
