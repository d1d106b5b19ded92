#include "lod/pyramid/blurred_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "core/parallel.h"

namespace defocus {

namespace {

// Over the whole sphere, and along no axis of a mesh: of a Fibonacci lattice.
constexpr std::size_t viewCount = 4;
constexpr int leastResolution = 64;
constexpr int mostResolution = 512;  // its patches of 2, 4, … 512 cells fill a table
static_assert(mostResolution == 1 << (blurSizes - 1));
constexpr float ambient = 0.2f;
constexpr double leastBlurredGrowth = 1.1;  // from level to level
constexpr double leastError = 1e-6;         // of level 1
constexpr float backBias = 1e-3f;           // cells by which a face that looks away lies behind one at its place
constexpr float leastAgreement = 0.05f;     // as the shaders bound it

std::array<glm::dvec3, viewCount> directionsToEyes() {
    std::array<glm::dvec3, viewCount> directions;
    for (std::size_t i = 0; i < viewCount; ++i) {
        const double height = 1 - (2 * static_cast<double>(i) + 1) / viewCount;
        const double turn = 2 * std::numbers::pi * (static_cast<double>(i) * std::numbers::phi + 0.1);
        const double radius = std::sqrt(1 - height * height);
        directions[i] = {radius * std::cos(turn), radius * std::sin(turn), height};
    }
    return directions;
}

// ---- a pattern where a texture may be

// Natural images have about equal contrast at every scale (Field 1987): as much in each octave. Textures aren't part of
// a mesh, so such a pattern stands for them: it moves where texture coordinates do.
class Pattern {
public:
    static constexpr int side = 256;

    Pattern() : values_(std::size_t{side} * side, 0) {
        for (int lattice = 4; lattice <= side; lattice *= 2)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) values_[at(x, y)] += octave(x, y, lattice);
        double squares = 0;
        for (const float value : values_) squares += double{value} * value;
        const auto scale = static_cast<float>(contrast / std::sqrt(squares / (side * side)));
        for (float& value : values_) value = std::max(0.0f, 1 + scale * value);
    }

    // By texture coordinates; it repeats as they do.
    [[nodiscard]] float operator()(const glm::vec2& uv) const {
        if (!(std::abs(uv.x) < 1e6f && std::abs(uv.y) < 1e6f)) return 1;
        const auto wrapped = [](float u) { return static_cast<int>(std::floor((u - std::floor(u)) * side)) % side; };
        return values_[at(wrapped(uv.x), wrapped(uv.y))];
    }

private:
    static constexpr double contrast = 0.4;  // standard deviation over the mean

    static std::size_t at(int x, int y) { return static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x); }

    static float noise(int x, int y, int lattice) {
        std::uint32_t h = static_cast<std::uint32_t>((x % lattice) + lattice * ((y % lattice) + lattice));
        h = (h ^ (h >> 16)) * 0x7feb352du;
        h = (h ^ (h >> 15)) * 0x846ca68bu;
        h ^= h >> 16;
        return static_cast<float>(h >> 8) / static_cast<float>(1 << 23) - 1;
    }

    static float octave(int x, int y, int lattice) {
        const int cell = side / lattice;
        const float u = static_cast<float>(x % cell) / static_cast<float>(cell);
        const float v = static_cast<float>(y % cell) / static_cast<float>(cell);
        const int i = x / cell;
        const int j = y / cell;
        return (1 - v) * ((1 - u) * noise(i, j, lattice) + u * noise(i + 1, j, lattice)) +
               v * ((1 - u) * noise(i, j + 1, lattice) + u * noise(i + 1, j + 1, lattice));
    }

    std::vector<float> values_;
};

const Pattern& pattern() {
    static const Pattern made;
    return made;
}

// ---- pictures

struct Picture {
    std::vector<glm::vec3> light;  // row by row; 0 where nothing is
    std::size_t covered = 0;       // cells
    double sum = 0;                // of the light's mean channels
};

// A square grid at right angles to a direction, over a ball around the mesh.
struct Eye {
    glm::dvec3 centre{0}, right{0}, up{0}, towards{0};
    glm::vec3 toLight{0};
    double cellsPerUnit = 0;
    int resolution = 0;

    // In cells; z grows towards the eye.
    [[nodiscard]] glm::vec3 place(const glm::vec3& position) const {
        const glm::dvec3 p = cellsPerUnit * (glm::dvec3(position) - centre);
        return {glm::dot(p, right) + 0.5 * resolution, glm::dot(p, up) + 0.5 * resolution, glm::dot(p, towards)};
    }
};

Eye eyeAlong(const Pyramid& pyramid, const glm::dvec3& direction, int resolution) {
    Eye eye;
    eye.centre = pyramid.bounds.centre();
    eye.towards = direction;
    eye.right = glm::normalize(glm::cross(glm::dvec3(0.36, 0.48, 0.8), direction));
    eye.up = glm::cross(direction, eye.right);
    eye.toLight = glm::vec3(glm::normalize(eye.towards + 0.6 * eye.right + 0.8 * eye.up));
    eye.cellsPerUnit = resolution / glm::length(pyramid.bounds.size());
    eye.resolution = resolution;
    return eye;
}

// What is nearest to the eye at the middle of a cell.
struct Hit {
    float z = -std::numeric_limits<float>::infinity();
    std::uint32_t first = 0;  // of the triangle's three indices, among the level's; the lowest bit isn't part of it
    float b = 0, c = 0;       // weights of the second and third corner
    bool back = false;        // the triangle looks away
};

void drawTriangle(const std::array<glm::vec3, 3>& p, std::uint32_t first, const Eye& eye, std::vector<Hit>& hits) {
    const auto [lowX, highX] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [lowY, highY] = std::minmax({p[0].y, p[1].y, p[2].y});
    const float top = static_cast<float>(eye.resolution) - 1;
    const float left = std::max(std::ceil(lowX - 0.5f), 0.0f);
    const float right = std::min(std::floor(highX - 0.5f), top);
    const float below = std::max(std::ceil(lowY - 0.5f), 0.0f);
    const float above = std::min(std::floor(highY - 0.5f), top);
    if (!(left <= right && below <= above)) return;
    const glm::vec2 ab = glm::vec2(p[1]) - glm::vec2(p[0]);
    const glm::vec2 ac = glm::vec2(p[2]) - glm::vec2(p[0]);
    const float twice = ab.x * ac.y - ab.y * ac.x;
    if (twice == 0) return;
    const float inverse = 1 / twice;
    const bool back = twice < 0;
    // Weights are linear in the place.
    const glm::vec2 stepB = inverse * glm::vec2(ac.y, -ac.x);
    const glm::vec2 stepC = inverse * glm::vec2(-ab.y, ab.x);
    const float stepZ1 = p[1].z - p[0].z;
    const float stepZ2 = p[2].z - p[0].z;
    const float z0 = p[0].z - (back ? backBias : 0);
    for (int y = static_cast<int>(below); y <= static_cast<int>(above); ++y) {
        Hit* const row = &hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.resolution)];
        const float dy = static_cast<float>(y) + 0.5f - p[0].y;
        for (int x = static_cast<int>(left); x <= static_cast<int>(right); ++x) {
            const float dx = static_cast<float>(x) + 0.5f - p[0].x;
            const float b = stepB.x * dx + stepB.y * dy;
            const float c = stepC.x * dx + stepC.y * dy;
            if (!(b >= 0 && c >= 0 && b + c <= 1)) continue;
            const float z = z0 + b * stepZ1 + c * stepZ2;
            if (z > row[x].z) row[x] = {z, first, b, c, back};
        }
    }
}

// The light that a matt surface under the eye's light throws back.
glm::vec3 lightOf(const PyramidLevel& level, std::span<const std::uint32_t> indices, const Hit& hit, const Eye& eye,
                  bool coarse) {
    const std::uint32_t* const v = &indices[hit.first];
    const float a = 1 - hit.b - hit.c;
    const auto mix = [&](const auto& values) { return a * values[v[0]] + hit.b * values[v[1]] + hit.c * values[v[2]]; };
    const glm::vec3 normal = mix(level.normals);
    const float length = glm::length(normal);
    float agreement = 1;
    if (coarse)
        agreement = std::clamp(a * glm::length(level.normals[v[0]]) + hit.b * glm::length(level.normals[v[1]]) +
                                   hit.c * glm::length(level.normals[v[2]]),
                               leastAgreement, 1.0f);
    float cosine = length > 0 ? glm::dot(normal, eye.toLight) / length : 0;
    if (hit.back) cosine = -cosine;
    const float mean = agreement * cosine;  // see meanCosine() of shaders/include/shading.glsl
    const float spread =
        std::numbers::inv_pi_v<float> * (1 - agreement * agreement) * std::max(1 - cosine * cosine, 0.0f);
    const float matt = 0.5f * (mean + std::sqrt(mean * mean + spread));
    glm::vec3 colour(1);
    if (!level.colors.empty())
        colour = glm::vec3(mix(level.colors));
    else if (!level.uv0.empty())
        colour *= pattern()(mix(level.uv0));
    return (ambient + (1 - ambient) * matt) * colour;
}

Picture pictureOf(const Pyramid& pyramid, std::size_t number, const Eye& eye) {
    const PyramidLevel& level = pyramid.levels[number];
    const std::span<const std::uint32_t> indices(pyramid.indices.data() + level.primitives.front().first,
                                                 3 * std::size_t{level.triangleCount});
    std::vector<glm::vec3> places;
    places.reserve(level.positions.size());
    for (const glm::vec3& position : level.positions) places.push_back(eye.place(position));
    const std::size_t cells = static_cast<std::size_t>(eye.resolution) * static_cast<std::size_t>(eye.resolution);
    std::vector<Hit> hits(cells);
    for (std::uint32_t i = 0; i < indices.size(); i += 3)
        drawTriangle({places[indices[i]], places[indices[i + 1]], places[indices[i + 2]]}, i, eye, hits);
    places = {};

    Picture picture;
    picture.light.assign(cells, glm::vec3(0));
    for (std::size_t i = 0; i < cells; ++i) {
        if (!std::isfinite(hits[i].z)) continue;
        const glm::vec3 light = lightOf(level, indices, hits[i], eye, number > 0);
        if (!std::isfinite(light.x + light.y + light.z)) continue;
        picture.light[i] = light;
        picture.sum += (double{light.x} + double{light.y} + double{light.z}) / 3;
        ++picture.covered;
    }
    return picture;
}

// ---- what is left over patches

// Sums of squares over all cells and channels: of the values, and of their means over patches.
using SquareSums = std::array<double, blurSizes>;

// The cells of a patch are seen at points, whose own chance would remain in the square of their mean. So the patch's
// mean is taken twice, over the white and over the black cells of a chess board, and the two are multiplied: what they
// don't have in common cancels.
void addSquares(const std::vector<glm::vec3>& values, int resolution, SquareSums& sums) {
    for (const glm::vec3& value : values) sums[0] += static_cast<double>(glm::dot(value, value));
    auto side = static_cast<std::size_t>(resolution) / 2;
    std::vector<glm::vec3> white(side * side), black(side * side);
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const glm::vec3* const lower = &values[4 * side * y + 2 * x];
            const glm::vec3* const upper = lower + 2 * side;
            white[side * y + x] = 0.5f * (lower[0] + upper[1]);
            black[side * y + x] = 0.5f * (lower[1] + upper[0]);
        }
    const auto halve = [&](std::vector<glm::vec3>& image) {
        const std::size_t half = side / 2;
        for (std::size_t y = 0; y < half; ++y)
            for (std::size_t x = 0; x < half; ++x) {
                const glm::vec3* const lower = &image[2 * side * y + 2 * x];
                image[half * y + x] = 0.25f * (lower[0] + lower[1] + lower[side] + lower[side + 1]);
            }
    };
    for (std::size_t i = 1; side >= 1; ++i, side /= 2) {
        double sum = 0;
        for (std::size_t cell = 0; cell < side * side; ++cell)
            sum += static_cast<double>(glm::dot(white[cell], black[cell]));
        sums[i] += sum * std::pow(4.0, static_cast<double>(i));
        halve(white);
        halve(black);
    }
}

// From the sums' own chance to what can be: a mean square never grows with the patch, nor falls faster than that of two
// spots that cancel.
void smooth(SquareSums& sums, std::size_t measured) {
    for (std::size_t i = 1; i < blurSizes; ++i)
        sums[i] = i <= measured ? std::clamp(sums[i], sums[i - 1] / 16, sums[i - 1]) : sums[i - 1] / 4;
}

struct Pictures {
    SquareSums light{};               // of level 0
    std::vector<SquareSums> changes;  // of each level
    std::size_t covered = 0;          // cells of level 0
    double sum = 0;                   // of its light
};

Pictures lookedAt(const Pyramid& pyramid, const Eye& eye) {
    Pictures result;
    result.changes.resize(pyramid.levels.size());
    const Picture truth = pictureOf(pyramid, 0, eye);
    result.covered = truth.covered;
    result.sum = truth.sum;
    addSquares(truth.light, eye.resolution, result.light);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        Picture picture = pictureOf(pyramid, l, eye);
        for (std::size_t i = 0; i < picture.light.size(); ++i) picture.light[i] -= truth.light[i];
        addSquares(picture.light, eye.resolution, result.changes[l]);
    }
    return result;
}

int resolutionFor(std::uint32_t triangles) {
    const double root = std::sqrt(static_cast<double>(triangles));
    const auto wanted = static_cast<unsigned>(std::clamp(root, double{leastResolution}, double{mostResolution}));
    return static_cast<int>(std::bit_ceil(wanted));
}

// Between the sizes of the table and beyond its last; at(i) is linear in the side between two sizes.
template <typename At>
double interpolated(double smallest, double side, const At& at) {
    double low = 0;
    double high = smallest;
    std::size_t i = 0;
    for (; i + 2 < blurSizes && side > high; ++i) {
        low = high;
        high *= 2;
    }
    const double f = std::clamp((side - low) / (high - low), 0.0, 1.0);
    return (1 - f) * at(i) + f * at(i + 1);
}

double squared(float value) {
    return double{value} * double{value};
}

}  // namespace

void measureBlurredErrors(Pyramid& pyramid, std::size_t helpers) {
    const double size = glm::length(pyramid.bounds.size());
    if (pyramid.levels.size() < 2 || !(size > 0) || !std::isfinite(size)) return;

    // Look at all levels from each direction.
    const int resolution = resolutionFor(pyramid.levels.front().triangleCount);
    const auto directions = directionsToEyes();
    std::array<Pictures, viewCount> views;
    {
        Tasks tasks(helpers);
        for (std::size_t i = 0; i < viewCount; ++i)
            tasks.add([&, i] { views[i] = lookedAt(pyramid, eyeAlong(pyramid, directions[i], resolution)); });
        tasks.wait();
    }

    // A black mesh has no light to measure in, and no error.
    double covered = 0;
    double light = 0;
    for (const Pictures& view : views) {
        covered += static_cast<double>(view.covered);
        light += view.sum;
    }
    if (!(light > 0)) return;
    const double unit = light / covered;
    const double scale = 1 / (3 * covered * unit * unit);

    const auto measured = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(resolution)));
    const auto total = [&](const auto& sumsOf) {
        SquareSums sums{};
        for (const Pictures& view : views)
            for (std::size_t i = 0; i < blurSizes; ++i) sums[i] += scale * sumsOf(view)[i];
        smooth(sums, measured);
        return sums;
    };
    pyramid.smallestPatch = 2 * size / resolution;
    const SquareSums all = total([](const Pictures& view) -> const SquareSums& { return view.light; });
    for (std::size_t i = 0; i < blurSizes; ++i) pyramid.contrast[i] = static_cast<float>(std::sqrt(all[0] - all[i]));
    BlurTable before{};
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const SquareSums sums = total([&](const Pictures& view) -> const SquareSums& { return view.changes[l]; });
        BlurTable& own = pyramid.levels[l].blurredError;
        for (std::size_t i = 0; i < blurSizes; ++i)
            own[i] =
                static_cast<float>(std::max({std::sqrt(sums[i]), leastBlurredGrowth * double{before[i]}, leastError}));
        before = own;
    }
}

double squaredError(const Pyramid& pyramid, std::size_t level, double side) {
    const BlurTable& table = pyramid.levels[level].blurredError;
    if (!(pyramid.smallestPatch > 0) || !(table.back() > 0)) return 0;
    const double largest = pyramid.smallestPatch * std::exp2(double{blurSizes - 2});
    const double beyond = side > largest ? largest / side : 1;
    return beyond * beyond /
           interpolated(pyramid.smallestPatch, side, [&](std::size_t i) { return 1 / squared(table[i]); });
}

double squaredContrast(const Pyramid& pyramid, double side) {
    if (!(pyramid.smallestPatch > 0)) return 0;
    return interpolated(pyramid.smallestPatch, side, [&](std::size_t i) { return squared(pyramid.contrast[i]); });
}

double levelOfBlurredError(const Pyramid& pyramid, std::span<const double> sides, double share) {
    double target = 0;
    for (const double side : sides) target += squaredContrast(pyramid, side);
    target = share * std::sqrt(target);
    if (!(target > 0)) return 0;
    double fine = 0;
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        double coarse = 0;
        for (const double side : sides) coarse += squaredError(pyramid, l, side);
        coarse = std::sqrt(coarse);
        if (coarse > target) return static_cast<double>(l - 1) + (target - fine) / (coarse - fine);
        fine = coarse;
    }
    return static_cast<double>(pyramid.levels.size() - 1);
}

}  // namespace defocus
