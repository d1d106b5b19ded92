#pragma once
// Memory needs of a frame, available memory, and the decision to draw in one piece or in tiles.

#include <cstdint>
#include <optional>
#include <string>

#include "plan/frame_plan.h"
#include "render/methods.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

// Memory and format of layers that a request sets.
struct DrawLimits {
    std::optional<std::uint64_t> memory;  // limit of the process in bytes; empty: three quarters of the free memory
    std::uint32_t wave = 0;               // K, lens samples drawn at once; 0: as many as fit into memory
    LayerFormat layerFormat = LayerFormat::automatic;
};

// Returns the total bytes that the process may use, from the current free memory.
std::uint64_t memoryLimit(const DrawLimits& limits);

// Returns the bytes of layers to draw at once in one piece: the default of RendererOptions, or a quarter of the rest of
// `limit` if that is less.
std::uint64_t waveBytesWithin(std::uint64_t limit);

// Returns the number of layers drawn at once under a memory limit: limits.wave, or as many as fit into a quarter of the
// memory beside sums and images. `needs`: those before the upload.
std::uint32_t waveWithin(const TilingNeeds& needs);

// Returns the needs of the full frame before its scene is uploaded. Includes meshes and textures on software drivers,
// which keep them in main memory. Needs a current GL context.
TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const DrawLimits& limits, std::uint64_t limit);

// Returns the needs of the frame with its scene uploaded and its shaders built. Draws one row to measure them.
TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const DrawLimits& limits, Renderer& renderer,
                          std::uint64_t limit);

// Returns whether a frame of this size certainly fits into `limit` bytes in one piece, without its plan.
// `mapsPossible`: the frame may have shadow maps.
bool surelyFits(int width, int height, bool mapsPossible, const DrawLimits& limits, std::uint64_t limit);

// Returns whether the frame, before any drawing, must be drawn in tiles. Throws Error (see refuseTiles) if so and
// `method` can't draw tiles. Needs a current GL context if the method does.
bool mustDrawInTiles(const World& world, const FramePlan& plan, const DrawLimits& limits, const Method& method,
                     std::uint64_t limit);

// Throws Error: "an image of 640 x 480 px does not fit into 100 MiB of memory in one piece, and REASON".
[[noreturn]] void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason);

}  // namespace defocus::engine
