#pragma once
// What a frame may take of memory, and whether it is drawn in one piece.

#include <cstdint>

#include "frame/request.h"
#include "plan/frame_plan.h"
#include "render/methods.h"
#include "render/tiling.h"

namespace defocus {

// Bytes that the process may take in all: those that the request gives, or what it has and three quarters of what is
// free.
std::uint64_t memoryLimit(const Request& request);

// Bytes of layers that are worth drawing at once, where the frame is drawn in one piece: the renderer's own default, or
// a quarter of what the limit leaves.
std::uint64_t waveBytesWithin(std::uint64_t limit);
// Layers to draw at once where the request gives the limit: those that were asked for, or as many as fit into a quarter
// of what there is, and into what sums and pictures leave. `needs`: before the upload.
std::uint32_t waveWithin(const TilingNeeds& needs);

// Bytes that a software driver takes for the plan's meshes and the scene's textures, about as much for its programs
// included, once a frame is drawn for the first time.
std::uint64_t bytesToUpload(const World& world, const FramePlan& plan);

// What drawing `rows` of the plan needs and has, as the process is now. On a software driver a layer comes with what
// that keeps of its triangles. `drawn` bytes of it are layers and sums that will be replaced. On a GPU, `heldByDevice`
// bytes are taken there by the scene. Needs a current GL context.
TilingNeeds tilingNeeds(const World& world, const FramePlan& plan, const RowRange& rows, const Request& request,
                        std::uint64_t limit, std::uint64_t drawn = 0, std::uint64_t heldByDevice = 0);

// The same of the whole frame, before it is drawn for the first time.
TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const Request& request, std::uint64_t limit);

// A row of the plan's first cell, which costs all that a tile costs beside its own pixels.
Tile trialTile(const FramePlan& plan);
// Bytes of the layer, its shadow maps and the sums that the trial draws.
std::uint64_t trialBytes(const TilingNeeds& needs, const Tile& trial);

}  // namespace defocus
