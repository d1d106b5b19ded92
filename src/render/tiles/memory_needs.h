#pragma once
// How much memory a frame takes, how much there is, and whether the frame is drawn in one piece or in tiles.

#include <cstdint>
#include <optional>
#include <string>

#include "plan/frame_plan.h"
#include "render/methods.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

// What a request says of the memory and format of layers.
struct DrawLimits {
    std::optional<std::uint64_t> memory;  // bytes that the process may take; none: three quarters of what is free
    std::uint32_t wave = 0;               // K, lens samples drawn at once; 0: as memory allows
    LayerFormat layerFormat = LayerFormat::automatic;
};

// Returns the bytes that the process may take in all, as things stand now.
std::uint64_t memoryLimit(const DrawLimits& limits);

// Returns the bytes of layers that are worth drawing at once in one piece: RendererOptions's default, or a quarter of
// what `limit` leaves if that is less.
std::uint64_t waveBytesWithin(std::uint64_t limit);

// Returns how many layers are drawn at once where the request gives the limit: limits.wave, or as many as fit into a
// quarter of the memory and beside sums and images. `needs` are those before the upload.
std::uint32_t waveWithin(const TilingNeeds& needs);

// Returns what the whole frame needs, before its scene is on the device. A software driver keeps meshes and textures in
// main memory, so they count. Needs a current GL context.
TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const DrawLimits& limits, std::uint64_t limit);

// Returns what the frame needs once its scene is on the device and its shaders are built: draws one row to find out.
TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const DrawLimits& limits, Renderer& renderer,
                          std::uint64_t limit);

// Returns whether a frame of this size certainly fits into `limit` bytes in one piece, without looking at its plan.
// `mapsPossible`: the frame may have shadow maps.
bool surelyFits(int width, int height, bool mapsPossible, const DrawLimits& limits, std::uint64_t limit);

// Returns whether the frame, of which nothing is drawn yet, must be drawn in tiles. Throws Error, as refuseTiles does,
// if it must be and `method` cannot. Needs a current GL context if the method does.
bool mustDrawInTiles(const World& world, const FramePlan& plan, const DrawLimits& limits, const Method& method,
                     std::uint64_t limit);

// Throws Error: "640 x 480 px don't fit into 100 MiB in one piece, and REASON".
[[noreturn]] void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason);

}  // namespace defocus::engine
