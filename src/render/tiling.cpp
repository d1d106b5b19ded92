#include "render/tiling.h"

#include <algorithm>

#include "core/error.h"
#include "core/memory_limits.h"

namespace defocus {

namespace {

constexpr std::uint64_t mostLayers = 64;
constexpr std::uint64_t shareOfLayers = 4;  // a quarter of the memory at most, so that bands stay high
constexpr int leastRows = 16;

std::uint64_t product(int a, int b) {
    return std::uint64_t{static_cast<std::uint32_t>(a)} * static_cast<std::uint32_t>(b);
}

std::vector<PixelRectangle> cellsFor(const TilingNeeds& needs) {
    if (!needs.mayUseCells) return {{0, 0, needs.width, needs.height}};
    return cellsOf(needs.width, needs.height);
}

// Rows of a band, where the layers take `layers` bytes.
std::uint64_t rowsThatFit(const TilingNeeds& needs, std::uint64_t cellWidth, std::uint64_t layers) {
    if (needs.shared) layers *= 2;  // software drivers still hold those of the tile before while new ones are made
    if (layers >= needs.deviceMemory) return 0;
    const std::uint64_t device = cellWidth * sumPixelBytes;
    const std::uint64_t host = cellWidth * tilePixelBytes + static_cast<std::uint64_t>(needs.width) * bandPixelBytes;
    const std::uint64_t left = needs.deviceMemory - layers;
    return needs.shared ? left / (device + host) : std::min(left / device, needs.hostMemory / host);
}

// The tiles of rows that lie in one row of cells.
Band bandOf(const std::vector<PixelRectangle>& cells, const RowRange& rows) {
    Band band{rows, {}};
    for (const PixelRectangle& cell : cells)
        if (cell.top <= rows.first && rows.end <= cell.top + cell.height)
            band.tiles.push_back({{cell.left, rows.first, cell.width, rows.end - rows.first}, cell});
    return band;
}

}  // namespace

bool fitsInOnePiece(const TilingNeeds& needs) {
    if (cellsFor(needs).size() > 1) return false;
    const std::uint64_t pixels = product(needs.width, needs.height);
    const std::uint64_t device = pixels * (needs.layerPixel + sumPixelBytes) + needs.layerMaps;
    const std::uint64_t host = pixels * wholePixelBytes;
    return needs.shared ? device + host <= needs.deviceMemory
                        : device <= needs.deviceMemory && host <= needs.hostMemory;
}

Tiling chosenTiling(const TilingNeeds& needs) {
    const std::vector<PixelRectangle> cells = cellsFor(needs);
    const PixelRectangle& largest = cells.front();
    const std::uint64_t layer = product(largest.width, largest.height) * needs.layerPixel + needs.layerMaps;
    const std::uint64_t most = std::min(needs.waveBytes, needs.deviceMemory / shareOfLayers);
    Tiling tiling;
    const std::uint64_t wave = needs.askedWave > 0 ? needs.askedWave : most / layer;
    tiling.wave = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wave, 1, mostLayers));
    const std::uint64_t fitting = rowsThatFit(needs, static_cast<std::uint64_t>(largest.width), tiling.wave * layer);
    const int wanted = std::min(leastRows, needs.rows.end - needs.rows.first);
    if (fitting < static_cast<std::uint64_t>(wanted)) {
        const std::uint64_t perRow = static_cast<std::uint64_t>(largest.width) * (sumPixelBytes + tilePixelBytes) +
                                     static_cast<std::uint64_t>(needs.width) * bandPixelBytes;
        fail("{} x {} px take at least {} beside the scene and the program, and {} is left", needs.width, needs.height,
             bytesText(layer + perRow * static_cast<std::uint64_t>(wanted)), bytesText(needs.deviceMemory));
    }
    const int rows = static_cast<int>(std::min<std::uint64_t>(fitting, static_cast<std::uint64_t>(needs.height)));

    // The rows of each row of cells, in equal bands but for the last: layers and sums are made anew where sizes differ.
    for (const PixelRectangle& cell : cells) {
        if (cell.left > 0) continue;
        const int first = std::max(cell.top, needs.rows.first);
        const int end = std::min(cell.top + cell.height, needs.rows.end);
        if (first >= end) continue;
        const int count = (end - first + rows - 1) / rows;
        const int each = (end - first + count - 1) / count;
        for (int top = first; top < end; top += each)
            tiling.bands.push_back(bandOf(cells, {top, std::min(top + each, end)}));
    }
    return tiling;
}

}  // namespace defocus
