#pragma once
// Computes the memory needs of a frame and the available memory, and decides whether the frame must be drawn in tiles.

#include <cstdint>
#include <optional>
#include <string>

#include "plan/frame_plan.h"
#include "render/methods.h"
#include "render/tiles/tiling.h"

namespace defocus::engine {

// Limits that a request sets on memory, on samples drawn together and on threads.
struct DrawLimits {
    std::optional<std::uint64_t> memory;  // max memory of the process in bytes; nullopt: see memoryLimit()
    std::uint32_t wave = 0;               // lens samples drawn together; 0: as many as fit into memory
    LayerFormat layerFormat = LayerFormat::automatic;
    std::optional<std::uint32_t> threads = {};  // threads that draw; see wantedThreads()
};

// Returns the max memory of the process in bytes: limits.memory, or its current memory use plus 3/4 of the free memory.
std::uint64_t memoryLimit(const DrawLimits& limits);

// Returns the number of threads that draw if memory suffices; 1 with drivers that cannot draw in several threads. Needs
// a current OpenGL context if the method uses threads.
std::uint32_t wantedThreads(const DrawLimits& limits, const Method& method);

// Returns RendererOptions::waveBytes, the max memory of all layers drawn at once, for a frame without tiles: `threads`
// times the default, but at most a quarter of the memory still available within `limit`.
std::uint64_t waveBytesWithin(std::uint64_t limit, std::uint32_t threads);

// Returns the number of threads, from 1 to `wanted`, that can draw the frame. The context and layers of all threads but
// the first must fit into half of the memory that one drawing thread leaves free.
std::uint32_t threadsWithin(const TilingNeeds& needs, std::uint32_t wanted);
// Returns the number of threads, from 1 to `wanted`, that can draw a frame of this size within `limit` bytes.
// surelyFits() must be true for the frame.
std::uint32_t threadsWithin(int width, int height, std::uint64_t limit, std::uint32_t wanted);

// Subtracts the memory of the contexts of `threads` threads from the available memory.
void reserveThreads(TilingNeeds& needs, std::uint32_t threads);

// Returns RendererOptions::pendingBytes for a frame: the default, or a twelfth of `limit` if this is less.
std::uint64_t pendingBytesWithin(std::uint64_t limit);

// Returns the number of samples that are drawn together, each into its own layer: TilingNeeds::askedWave, or as many as
// fit. The layers together take at most TilingNeeds::waveBytes and a quarter of the device memory, and no more than
// accumulation buffers and images leave free. `needs` is the result of needsBeforeUpload().
std::uint32_t waveWithin(const TilingNeeds& needs);

// Returns the memory needs of the full frame before its scene is uploaded. With software drivers, they include meshes
// and textures, which are in main memory. Needs a current OpenGL context.
TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const DrawLimits& limits, std::uint64_t limit);

// Draws one row of pixels, so that the scene is uploaded and the shaders are compiled. Returns the frame's memory
// needs, measured afterwards.
TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const DrawLimits& limits, Renderer& renderer,
                          std::uint64_t limit);

// Returns true if every untiled frame of this size, without data layers, fits into `limit` bytes; false if some may not
// fit. `mapsPossible` says whether the frame may have shadow maps.
bool surelyFits(int width, int height, bool mapsPossible, const DrawLimits& limits, std::uint64_t limit);

// Returns whether a frame that is not yet uploaded must be drawn in tiles. Throws Error (see refuseTiles) if tiles are
// needed but `method` cannot draw tiles. Needs a current OpenGL context if the method needs one.
bool mustDrawInTiles(const World& world, const FramePlan& plan, const DrawLimits& limits, const Method& method,
                     std::uint64_t limit);

// Throws Error: "an image of 640 x 480 px does not fit into 100 MiB of memory in one piece, and REASON".
[[noreturn]] void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason);

}  // namespace defocus::engine
