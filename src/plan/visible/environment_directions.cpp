// Samples directions to an environment by importance, on an equirectangular grid (Pharr, Jakob and Humphreys 2016,
// section 14.2.4).
#include "plan/visible/environment_directions.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "core/luminance.h"

namespace defocus::engine {

namespace {

constexpr int gridColumns = 64;
constexpr int gridRows = 32;

glm::dvec3 gridDirection(double u, double v) {
    const double polar = std::numbers::pi * v;
    const double azimuth = 2 * std::numbers::pi * (u - 0.5);
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// Returns the mean radiance of the environment map's pixels in a grid cell, or the radiance of one pixel if cells are
// smaller than pixels.
glm::dvec3 meanRadiance(const Image& map, int column, int row) {
    const auto pixel = [&](int x, int y) {
        const float* value = map.at(std::min(x, map.width - 1), std::min(y, map.height - 1));
        glm::dvec3 color(value[0], value[map.channels >= 3 ? 1 : 0], value[map.channels >= 3 ? 2 : 0]);
        for (int c = 0; c < 3; ++c) color[c] = std::min(std::max(0.0, std::isnan(color[c]) ? 0.0 : color[c]), 65504.0);
        return color;
    };
    const int left = column * map.width / gridColumns,
              right = std::max(left + 1, (column + 1) * map.width / gridColumns);
    const int top = row * map.height / gridRows, bottom = std::max(top + 1, (row + 1) * map.height / gridRows);
    glm::dvec3 sum(0);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) sum += pixel(x, y);
    return sum / (static_cast<double>(right - left) * (bottom - top));
}

glm::dvec3 cellRadiance(const Environment& environment, int column, int row) {
    if (environment.type == EnvironmentType::map) return meanRadiance(*environment.map, column, row);
    if (environment.type == EnvironmentType::uniform) return glm::dvec3(environment.zenith);
    const double height = std::cos(std::numbers::pi * (row + 0.5) / gridRows);
    const glm::dvec3 pole(height > 0 ? environment.zenith : environment.nadir);
    return glm::mix(glm::dvec3(environment.horizon), pole, std::abs(height));
}

double importance(int row, bool onGround) {
    return onGround ? 0.25 + 0.75 * std::max(0.0, std::cos(std::numbers::pi * (row + 0.5) / gridRows)) : 1;
}

// Inverts a cumulative distribution. Returns the index of the interval of the cumulative `sums` that contains the value
// `place` · sums.back(), and the position inside this interval, from 0 to 1. `place` is in [0, 1).
std::pair<std::size_t, double> inverted(std::span<const double> sums, double place) {
    const double target = place * sums.back();
    const auto found = std::ranges::upper_bound(sums, target);
    const auto index = std::min(static_cast<std::size_t>(found - sums.begin()), sums.size() - 1);
    const double before = index > 0 ? sums[index - 1] : 0;
    const double width = sums[index] - before;
    return {index, width > 0 ? std::clamp((target - before) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

EnvironmentDirections::EnvironmentDirections(const Environment& environment, bool onGround) : onGround_(onGround) {
    if (environment.type == EnvironmentType::none) return;
    double all = 0;
    for (int row = 0; row < gridRows; ++row) {
        const double solidAngle =
            2 * std::numbers::pi / gridColumns *
            (std::cos(std::numbers::pi * row / gridRows) - std::cos(std::numbers::pi * (row + 1) / gridRows));
        double inRow = 0;
        for (int column = 0; column < gridColumns; ++column) {
            radiances_.push_back(cellRadiance(environment, column, row));
            const double light = luminance(radiances_.back()) * solidAngle;
            meanIlluminance_ += light / 4;
            inRow += light * importance(row, onGround);
            cellSums_.push_back(inRow);
        }
        all += inRow;
        rowSums_.push_back(all);
    }
}

EnvironmentDirections::Choice EnvironmentDirections::at(const glm::dvec2& point) const {
    const auto [row, down] = inverted(rowSums_, point.y);
    const auto cells = std::span(cellSums_).subspan(row * gridColumns, gridColumns);
    const auto [column, across] = inverted(cells, point.x);
    // Points at uniform heights on the unit sphere cover the cell's solid angle uniformly.
    const double top = std::cos(std::numbers::pi * static_cast<double>(row) / gridRows);
    const double bottom = std::cos(std::numbers::pi * (static_cast<double>(row) + 1) / gridRows);
    const double polar = std::acos(std::clamp(glm::mix(top, bottom, down), -1.0, 1.0));
    const glm::dvec3& radiance = radiances_[row * gridColumns + column];
    const double light = luminance(radiance);
    return {gridDirection((static_cast<double>(column) + across) / gridColumns, polar / std::numbers::pi),
            light > 0 ? radiance * (rowSums_.back() / (light * importance(static_cast<int>(row), onGround_)))
                      : glm::dvec3(0)};
}

}  // namespace defocus::engine
