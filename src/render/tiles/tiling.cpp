#include "render/tiles/tiling.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/memory_limits.h"

namespace defocus::engine {

namespace {

constexpr std::uint64_t maxLayers = 64;
// Layers, the images of the samples that are drawn together, get at most 1/4 of the memory. The rest is for
// accumulation buffers, so that a band (rows of the image that are drawn together) can have many rows.
constexpr std::uint64_t shareOfLayers = 4;
constexpr int minRows = 16;

std::vector<PixelRectangle> cellsFor(const TilingNeeds& needs) {
    if (!needs.mayUseCells) return {{0, 0, needs.width, needs.height}};
    return cellsOf(needs.width, needs.height);
}

// Returns how many copies of the layers exist at once: software drivers keep the layers of the previous tile while new
// layers are allocated.
std::uint64_t layerCopies(const TilingNeeds& needs) {
    return needs.shared ? 2 : 1;
}

// Returns `needs` with the available memory reduced by TilingNeeds::keptBytes, the memory of images kept while drawing.
TilingNeeds besidePictures(TilingNeeds needs) {
    const auto take = [&](std::uint64_t& memory) { memory -= std::min(memory, needs.keptBytes); };
    take(needs.hostMemory);
    if (needs.shared) take(needs.deviceMemory);
    return needs;
}

// Returns the max number of rows of a band if the layers take `layers` bytes.
std::uint64_t rowsThatFit(const TilingNeeds& needs, std::uint64_t cellWidth, std::uint64_t layers) {
    layers *= layerCopies(needs);
    if (layers >= needs.deviceMemory) return 0;
    const std::uint64_t device = cellWidth * sumPixelBytes;
    const std::uint64_t host = cellWidth * tilePixelBytes + static_cast<std::uint64_t>(needs.width) * bandPixelBytes;
    const std::uint64_t left = needs.deviceMemory - layers;
    return needs.shared ? left / (device + host) : std::min(left / device, needs.hostMemory / host);
}

// Returns the number of bands for `length` rows with at most `max` rows each. Uses up to 50 % more bands if this makes
// all bands equally high, because a band of a different height needs new accumulation buffers while drivers still keep
// the old ones.
int bandCount(int length, int max) {
    const int fewest = (length + max - 1) / max;
    for (int count = fewest; count <= fewest + fewest / 2; ++count)
        if (length % count == 0) return count;
    return fewest;
}

[[noreturn]] void failForMemory(const TilingNeeds& needs, int cellWidth, std::uint64_t layers, int rows) {
    const std::uint64_t perRow = static_cast<std::uint64_t>(cellWidth) * (sumPixelBytes + tilePixelBytes) +
                                 static_cast<std::uint64_t>(needs.width) * bandPixelBytes;
    const std::uint64_t min = layers * layerCopies(needs) + perRow * static_cast<std::uint64_t>(rows) + needs.keptBytes;
    // The suggested limit includes 5 % for variations between runs.
    const std::string enough = needs.shared && needs.elsewhere > 0
                                   ? fmt::format("; give --memory {:.0f}MiB or more",
                                                 static_cast<double>(min + needs.elsewhere) * 1.05 / 0x1p20)
                                   : "";
    fail(
        "an image of {} x {} px needs at least {} of memory in addition to the scene and the program, but only {} is "
        "left{}",
        needs.width, needs.height, bytesText(min), bytesText(needs.deviceMemory), enough);
}

// Returns the band of the image rows `rows`, which has one tile in each cell that the rows cross. `cells` are parts of
// the image with separate window coordinates (plan/visible/tiles.h). The rows must be within one row of cells.
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
    const std::uint64_t pixels = pixelCount(needs.width, needs.height);
    const std::uint64_t device = pixels * (needs.layerPixel + sumPixelBytes + needs.dataPixel) + needs.layerMaps;
    const std::uint64_t host = pixels * (untiledPixelBytes + needs.dataPixel) + needs.keptBytes;
    return needs.shared ? device + host <= needs.deviceMemory
                        : device <= needs.deviceMemory && host <= needs.hostMemory;
}

Tiling chosenTiling(const TilingNeeds& asked) {
    const TilingNeeds needs = besidePictures(asked);
    const std::vector<PixelRectangle> cells = cellsFor(needs);
    const PixelRectangle& largest = cells.front();
    const std::uint64_t layer = pixelCount(largest.width, largest.height) * needs.layerPixel + needs.layerMaps;
    const std::uint64_t max = std::min(needs.waveBytes, needs.deviceMemory / shareOfLayers);
    Tiling tiling;
    const std::uint64_t wave = needs.askedWave > 0 ? needs.askedWave : max / layer;
    tiling.wave = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wave, 1, maxLayers));
    const std::uint64_t fitting = rowsThatFit(needs, static_cast<std::uint64_t>(largest.width), tiling.wave * layer);
    const int wanted = std::min(minRows, needs.rows.end - needs.rows.first);
    if (fitting < static_cast<std::uint64_t>(wanted)) failForMemory(asked, largest.width, tiling.wave * layer, wanted);
    const int rows = static_cast<int>(std::min<std::uint64_t>(fitting, static_cast<std::uint64_t>(needs.height)));

    // Divide each row of cells (parts of a large image, plan/visible/tiles.h) into bands of equal height, because each
    // change of height reallocates layers and accumulation buffers. Only the last band may have fewer rows.
    for (const PixelRectangle& cell : cells) {
        if (cell.left > 0) continue;
        const int first = std::max(cell.top, needs.rows.first);
        const int end = std::min(cell.top + cell.height, needs.rows.end);
        if (first >= end) continue;
        const int count = bandCount(end - first, rows);
        const int each = (end - first + count - 1) / count;
        for (int top = first; top < end; top += each)
            tiling.bands.push_back(bandOf(cells, {top, std::min(top + each, end)}));
    }
    return tiling;
}

}  // namespace defocus::engine
