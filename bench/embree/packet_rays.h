#pragma once
// The rays of lens_rays.h for the packets of a tile of 16 × 16 pixels.

#include <array>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

inline constexpr int tileSide = 16;  // px
inline constexpr int packetsPerTileRow = tileSide / packetSide;
inline constexpr int packetsPerTile = packetsPerTileRow * packetsPerTileRow;

// Origins and slopes of a tile's rays, computed in double and rounded once, so that shared lens samples lose no
// accuracy.
struct TileRays {
    std::array<float, tileSide> slopeX{};  // by column
    std::array<float, tileSide> slopeY{};  // by row
    float originX = 0;
    float originY = 0;
};

// Returns the rays of the tile whose first pixel is (left, top), for one sample: `pixel` in every pixel ([0, 1)² px,
// right and down) and `lens` on the lens (unit disk).
TileRays tileRays(const LensCamera& camera, const View& view, int left, int top, const glm::dvec2& pixel,
                  const glm::dvec2& lens);

// Makes packet `place` (row by row) of the tile, with the tile's sample in all pixels.
void makeRays(const TileRays& tile, int place, RTCRayHit16& packet);

// Makes a packet with a different sample in every pixel. `tile` must be made for {0, 0} in the pixel and on the lens.
void makeRays(const TileRays& tile, int place, const LensCamera& camera, const View& view, const PacketPoints& points,
              RTCRayHit16& packet);

}  // namespace defocus::engine
