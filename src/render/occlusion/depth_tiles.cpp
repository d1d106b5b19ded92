#include "render/occlusion/depth_tiles.h"

#include <algorithm>
#include <cstddef>

namespace defocus::engine {

namespace {

constexpr int smallestTile = 4;  // side in px of the finest level's tiles
constexpr int maxTiles = 3;      // a query reads at most 3 x 3 tiles, from a level whose tiles are large enough

int shared(int size, int parts) {
    return (size + parts - 1) / parts;
}

}  // namespace

void DepthTiles::build(std::span<const float> depths, int width, int height) {
    levels_.resize(1);
    Level& first = levels_.front();
    first.columns = shared(width, smallestTile);
    first.rows = shared(height, smallestTile);
    first.min.assign(static_cast<std::size_t>(first.columns) * static_cast<std::size_t>(first.rows), 1.0f);
    std::vector<float> columns(static_cast<std::size_t>(first.columns) * smallestTile);
    for (int row = 0; row < first.rows; ++row) {
        std::fill(columns.begin(), columns.end(), 1.0f);
        for (int y = row * smallestTile; y < std::min((row + 1) * smallestTile, height); ++y) {
            const float* const line = &depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
            for (int x = 0; x < width; ++x)
                columns[static_cast<std::size_t>(x)] = std::min(columns[static_cast<std::size_t>(x)], line[x]);
        }
        float* const tiles = &first.min[static_cast<std::size_t>(row) * static_cast<std::size_t>(first.columns)];
        for (int tile = 0; tile < first.columns; ++tile) {
            const float* const four = &columns[static_cast<std::size_t>(tile) * smallestTile];
            tiles[tile] = std::min(std::min(four[0], four[1]), std::min(four[2], four[3]));
        }
    }
    while (levels_.back().columns > 1 || levels_.back().rows > 1) {
        Level coarse{shared(levels_.back().columns, 2), shared(levels_.back().rows, 2), {}};
        coarse.min.assign(static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows), 1.0f);
        const Level& fine = levels_.back();
        for (int y = 0; y < fine.rows; ++y)
            for (int x = 0; x < fine.columns; ++x) {
                float& min = coarse.min[static_cast<std::size_t>(y / 2 * coarse.columns + x / 2)];
                min = std::min(min, fine.min[static_cast<std::size_t>(y * fine.columns + x)]);
            }
        levels_.push_back(std::move(coarse));
    }
}

float DepthTiles::farthest(int left, int right, int bottom, int top) const {
    int side = smallestTile;
    std::size_t number = 0;
    while (number + 1 < levels_.size() &&
           std::max((right - 1) / side - left / side, (top - 1) / side - bottom / side) >= maxTiles) {
        side *= 2;
        ++number;
    }
    const Level& level = levels_[number];
    float min = 1;
    for (int y = bottom / side; y <= (top - 1) / side; ++y)
        for (int x = left / side; x <= (right - 1) / side; ++x)
            min = std::min(min, level.min[static_cast<std::size_t>(y * level.columns + x)]);
    return min;
}

}  // namespace defocus::engine
