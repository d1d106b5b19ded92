// Source: Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square.

#include "lens/aperture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "core/error.h"
#include "core/luminance.h"

namespace defocus::engine {

namespace {

constexpr double pi = std::numbers::pi;

// Min and max number of grid cells along the longer side of an aperture image. The min keeps the rim of the disk round;
// the max limits the cost.
constexpr int fewestCells = 256;
constexpr int maxCells = 1024;

// ---- aperture blades -----------------------------------------------------------------------------------------------

struct Blade {
    double halfAngle = 0;  // π/n for n blades
    double curvature = 0;
};

double edgeRadius(const Blade& blade, double angle) {
    return (1 - blade.curvature) * std::cos(blade.halfAngle) / std::cos(angle) + blade.curvature;
}

// Returns ∫ edgeRadius(φ)² dφ from the blade's middle, φ = 0, to `angle`: twice the area of this sector.
double sectorArea(const Blade& blade, double angle) {
    const double chord = (1 - blade.curvature) * std::cos(blade.halfAngle);
    const double tangent = std::tan(angle);
    return chord * chord * tangent + 2 * chord * blade.curvature * std::asinh(tangent) +
           blade.curvature * blade.curvature * angle;
}

// Returns the angle φ such that the sector from the blade's middle (angle 0) to φ covers the fraction |share| of half
// the blade's area. φ has the sign of `share` ∈ [−1, 1]. Newton's method starts from the exact solution for a straight
// blade. It converges in three or four steps, because the integrand edgeRadius² varies by at most a factor of 4, the
// factor for three straight blades.
double angleOfShare(const Blade& blade, double share) {
    double angle = std::atan(share * std::tan(blade.halfAngle));
    if (blade.curvature == 0) return angle;
    const double wanted = share * sectorArea(blade, blade.halfAngle);
    for (int i = 0; i < 5; ++i) {
        const double radius = edgeRadius(blade, angle);
        angle -= (sectorArea(blade, angle) - wanted) / (radius * radius);
        angle = std::clamp(angle, -blade.halfAngle, blade.halfAngle);
    }
    return angle;
}

// Maps the disk to the aperture polygon, preserving relative areas. The angle of a point selects the blade and a
// fraction of the blade's area. The point's distance from the centre is multiplied by the distance of the blade's edge
// in the same direction. The first corner lies at angle 0.
glm::dvec2 betweenBlades(const Aperture& aperture, const glm::dvec2& disk) {
    const Blade blade{pi / aperture.bladeCount, aperture.bladeCurvature};
    const double turn = std::atan2(disk.y, disk.x) / (2 * blade.halfAngle);
    const double index = std::floor(turn);
    const double angle = angleOfShare(blade, 2 * (turn - index) - 1);
    const double radius = glm::length(disk) * edgeRadius(blade, angle);
    const double direction = (2 * index + 1) * blade.halfAngle + angle;
    return radius * glm::dvec2(std::cos(direction), std::sin(direction));
}

// ---- radial light distribution --------------------------------------------------------------------------------------

// Returns t such that the innermost fraction t of the aperture's area transmits the fraction `share` of the light:
// ∫₀ᵗ 1 + k(2τ − 1) dτ = (1 − k)t + kt² = share. k ∈ [−1, 1] is the spherical aberration.
double aberratedShare(double k, double share) {
    const double linear = 1 - k;
    const double divisor = linear + std::sqrt(std::max(linear * linear + 4 * k * share, 0.0));
    return divisor > 0 ? std::min(2 * share / divisor, 1.0) : 0;
}

// Moves a disk point along its radius, so that uniformly distributed points follow the light density of a lens with a
// central obstruction and spherical aberration.
glm::dvec2 spreadOverRadius(const Aperture& aperture, const glm::dvec2& disk) {
    const double share = glm::dot(disk, disk);
    const double lit = aberratedShare(aperture.sphericalAberration, share);
    const double radius = std::sqrt(aperture.obstruction + (1 - aperture.obstruction) * lit);
    return share > 0 ? disk * (radius / std::sqrt(share)) : glm::dvec2(radius, 0);
}

// ---- aperture images ------------------------------------------------------------------------------------------------

// Returns the Rec. 709 luminance of a pixel, or its value in images with fewer than three channels.
double valueAt(const Image& image, int x, int y) {
    const float* pixel = image.at(x, y);
    for (int c = 0; c < image.channels; ++c)
        if (!(pixel[c] >= 0) || !std::isfinite(pixel[c]))
            fail("aperture image: pixel {},{} has the value {}; values must be finite and at least 0", x, y, pixel[c]);
    if (image.channels < 3) return static_cast<double>(pixel[0]);
    return luminance(pixel);
}

// Maps a position in an aperture image, in cells, to lens coordinates, y up. The image's longer side spans [−1, 1].
glm::dvec2 lensPoint(const ApertureImage& image, double column, double row) {
    const double half = 0.5 * std::max(image.columns, image.rows);
    return {(column - 0.5 * image.columns) / half, (0.5 * image.rows - row) / half};
}

// Returns the transmission of each cell of an aperture image; 0 if the cell's centre lies outside the unit disk.
std::vector<double> cellValues(const Image& image, ApertureImage& cells) {
    const int longer = std::max(image.width, image.height);
    const int parts = (fewestCells + longer - 1) / longer;  // cells per pixel, along each axis
    const int group = (longer + maxCells - 1) / maxCells;   // pixels per cell, along each axis
    cells.columns = (image.width * parts + group - 1) / group;
    cells.rows = (image.height * parts + group - 1) / group;
    std::vector<double> values(static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows));
    for (int y = 0; y < image.height * parts; ++y)
        for (int x = 0; x < image.width * parts; ++x) {
            const double value = valueAt(image, x / parts, y / parts);
            const glm::dvec2 middle = lensPoint(cells, x / group + 0.5, y / group + 0.5);
            if (glm::dot(middle, middle) <= 1)
                values[static_cast<std::size_t>(y / group) * static_cast<std::size_t>(cells.columns) +
                       static_cast<std::size_t>(x / group)] += value;
        }
    return values;
}

ApertureImage readApertureImage(const Image& image) {
    if (image.empty()) fail("aperture image: the image has no pixels");
    ApertureImage cells;
    const std::vector<double> values = cellValues(image, cells);
    const auto columns = static_cast<std::size_t>(cells.columns);
    cells.cellEnds.resize(values.size());
    double all = 0;
    for (std::size_t first = 0; first < values.size(); first += columns) {
        double row = 0;
        for (std::size_t i = first; i < first + columns; ++i) row += values[i];
        double end = 0;
        for (std::size_t i = first; i < first + columns; ++i)
            cells.cellEnds[i] = row > 0 ? static_cast<float>((end += values[i]) / row) : 1.0f;
        cells.rowEnds.push_back(all += row);
    }
    if (!(all > 0)) fail("aperture image: all pixels within the lens circle are black, so no light passes");
    for (double& end : cells.rowEnds) end /= all;
    return cells;
}

// Returns the index of the interval that contains `share`, plus the fraction of that interval below `share`. [first,
// last) are the ends of adjacent intervals that start at 0.
template <typename Iterator>
double placeAmong(Iterator first, Iterator last, double share) {
    const Iterator found = std::min(std::upper_bound(first, last, share), last - 1);
    const double before = found == first ? 0.0 : static_cast<double>(*(found - 1));
    const double width = static_cast<double>(*found) - before;
    const double place = width > 0 ? std::clamp((share - before) / width, 0.0, 1.0) : 0.5;
    return static_cast<double>(found - first) + place;
}

// Maps (r, s) ∈ [0, 1)² to a lens point by inverting the cumulative transmission: s selects the row, and r the position
// in the row.
glm::dvec2 throughImage(const ApertureImage& image, const glm::dvec2& square) {
    const double share = std::min(1 - square.y, 1 - 0x1p-32);  // below 1, so that a black last row is never selected
    const double row = placeAmong(image.rowEnds.begin(), image.rowEnds.end(), share);
    const auto index = std::min(static_cast<std::ptrdiff_t>(row), static_cast<std::ptrdiff_t>(image.rows) - 1);
    const auto first = image.cellEnds.begin() + index * image.columns;
    const glm::dvec2 point = lensPoint(image, placeAmong(first, first + image.columns, square.x), row);
    // Clamp to the disk, because cells on the rim extend beyond it by less than a cell.
    return point / std::max(glm::length(point), 1.0);
}

// Returns the fraction of all light that passes through the aperture image's cell at a lens point; 0 outside the image.
double transmissionAt(const ApertureImage& image, const glm::dvec2& point) {
    const double half = 0.5 * std::max(image.columns, image.rows);
    const double column = std::floor(point.x * half + 0.5 * image.columns);
    const double row = std::floor(0.5 * image.rows - point.y * half);
    if (column < 0 || row < 0 || column >= image.columns || row >= image.rows) return 0;
    const auto x = static_cast<std::size_t>(column);
    const auto y = static_cast<std::size_t>(row);
    const float* const ends = image.cellEnds.data() + y * static_cast<std::size_t>(image.columns);
    const double shareOfRow = static_cast<double>(ends[x]) - (x > 0 ? static_cast<double>(ends[x - 1]) : 0);
    return shareOfRow * (image.rowEnds[y] - (y > 0 ? image.rowEnds[y - 1] : 0));
}

glm::dvec2 turned(const glm::dvec2& point, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * point.x - s * point.y, s * point.x + c * point.y};
}

// Returns a point's distance from the centre, relative to the distance of the aperture's edge in the same direction.
double radiusWithin(const Aperture& aperture, const glm::dvec2& point) {
    const double radius = glm::length(point);
    if (aperture.bladeCount < 3) return radius;
    const Blade blade{pi / aperture.bladeCount, aperture.bladeCurvature};
    const double turn = std::atan2(point.y, point.x) / (2 * blade.halfAngle);
    return radius / edgeRadius(blade, 2 * blade.halfAngle * (turn - std::floor(turn) - 0.5));
}

}  // namespace

glm::dvec2 concentricDisk(const glm::dvec2& square) {
    const glm::dvec2 offset = 2.0 * square - 1.0;
    if (offset.x == 0 && offset.y == 0) return offset;
    constexpr double quarter = pi / 4;
    if (std::abs(offset.x) > std::abs(offset.y)) {
        const double angle = quarter * (offset.y / offset.x);
        return offset.x * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    const double angle = 2 * quarter - quarter * (offset.x / offset.y);
    return offset.y * glm::dvec2(std::cos(angle), std::sin(angle));
}

glm::dvec2 squareOfConcentricDisk(const glm::dvec2& disk) {
    const double radius = glm::length(disk);
    constexpr double quarter = pi / 4;
    glm::dvec2 offset;
    if (std::abs(disk.x) > std::abs(disk.y)) {
        offset.x = std::copysign(radius, disk.x);
        offset.y = offset.x * std::atan(disk.y / disk.x) / quarter;
    } else if (radius > 0) {
        offset.y = std::copysign(radius, disk.y);
        offset.x = offset.y * std::atan(disk.x / disk.y) / quarter;
    } else {
        offset = glm::dvec2(0);
    }
    return 0.5 * (offset + 1.0);
}

bool isUniformDisk(const Aperture& aperture) {
    return aperture.bladeCount < 3 && aperture.anamorphicRatio == 1 && aperture.obstruction == 0 &&
           aperture.sphericalAberration == 0 && aperture.image.rows == 0;
}

Aperture makeAperture(const Lens& lens) {
    Aperture aperture{lens.bladeCount,
                      lens.bladeRotation,
                      lens.bladeCurvature,
                      lens.anamorphicRatio,
                      lens.obstruction * lens.obstruction,
                      lens.sphericalAberration,
                      {}};
    if (lens.apertureImage) aperture.image = readApertureImage(*lens.apertureImage);
    return aperture;
}

glm::dvec2 apertureSample(const Aperture& aperture, const glm::dvec2& square) {
    glm::dvec2 point(0);
    if (aperture.image.rows > 0) {
        point = throughImage(aperture.image, square);
    } else {
        point = concentricDisk(square);
        if (aperture.obstruction > 0 || aperture.sphericalAberration != 0) point = spreadOverRadius(aperture, point);
        if (aperture.bladeCount >= 3) point = betweenBlades(aperture, point);
    }
    if (aperture.bladeRotation != 0) point = turned(point, aperture.bladeRotation);
    const double ratio = aperture.anamorphicRatio;
    return {ratio > 1 ? point.x / ratio : point.x, ratio < 1 ? point.y * ratio : point.y};
}

double lightDensity(const Aperture& aperture, const glm::dvec2& point) {
    const double ratio = aperture.anamorphicRatio;
    const glm::dvec2 round(ratio > 1 ? point.x * ratio : point.x, ratio < 1 ? point.y / ratio : point.y);
    const glm::dvec2 upright = aperture.bladeRotation != 0 ? turned(round, -aperture.bladeRotation) : round;
    // Lens samples on the rim are rounded to floats, which may move them outside the aperture.
    constexpr double tolerance = 1e-6;
    if (aperture.image.rows > 0)
        return glm::length(upright) <= 1 + tolerance ? transmissionAt(aperture.image, upright) : 0;
    const double radius = radiusWithin(aperture, upright);
    const double area = (radius * radius - aperture.obstruction) / (1 - aperture.obstruction);
    if (radius > 1 + tolerance || area < -tolerance) return 0;
    return 1 + aperture.sphericalAberration * (2 * std::clamp(area, 0.0, 1.0) - 1);
}

}  // namespace defocus::engine
