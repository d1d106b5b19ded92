#pragma once
// When a frame is drawn in tiles, and how: what stills, films and the library have in common.

#include <string>
#include <vector>

#include "frame/memory_budget.h"

namespace defocus {

// Whether the frame doesn't fit into `limit` bytes in one piece and is drawn in tiles. Throws Error, as refuseTiles
// does, where it can't be. Nothing of it has been drawn yet. Needs a current GL context where the method does.
bool mustDrawInTiles(const World& world, const FramePlan& plan, const Request& request, const Method& method,
                     std::uint64_t limit);

// Throws Error: "640 x 480 px don't fit into 100 MiB in one piece, and REASON".
[[noreturn]] void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason);

// The plan of a frame that is drawn in tiles. A number of samples that is automatic becomes that which the blur asks
// for: the error of a picture, which may end it earlier in one piece, is known only once all of it is drawn.
FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings);

// Where such a plan may have more samples than the frame in one piece would get: a line that says so and why.
std::vector<std::string> tiledSamplesNote(const FramePlan& plan, bool automatic);

// What all rows of the plan need, once the scene is on the device and the shaders are built: draws a row to find out.
TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const Request& request, Renderer& renderer,
                          std::uint64_t limit);

}  // namespace defocus
