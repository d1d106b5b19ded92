#pragma once
// The rays of lens_rays.h for the packets of a tile of 16 × 16 pixels.

#include <array>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

inline constexpr int tileSide = 16;  // px
inline constexpr int packetsPerTileRow = tileSide / packetSide;
inline constexpr int packetsPerTile = packetsPerTileRow * packetsPerTileRow;

// Where the rays of a tile leave the lens and where they go. In double until they are rounded once, so that a lens
// sample that all pixels share costs no accuracy.
struct TileRays {
    std::array<float, tileSide> slopeX{};  // by column
    std::array<float, tileSide> slopeY{};  // by row
    float originX = 0;
    float originY = 0;
};

// Of the tile whose first pixel is (left, top), for a sample at `pixel` in every pixel ([0, 1)² px, right and down) and
// `lens` on the lens (unit disk).
TileRays tileRays(const LensCamera& camera, const View& view, int left, int top, const glm::dvec2& pixel,
                  const glm::dvec2& lens);

// Packet `place` (row by row) of the tile: all pixels at the sample that the tile was made for.
void makeRays(const TileRays& tile, int place, RTCRayHit16& packet);

// Every pixel at a sample of its own; `tile` is made for {0, 0} in the pixel and on the lens.
void makeRays(const TileRays& tile, int place, const LensCamera& camera, const View& view, const PacketPoints& points,
              RTCRayHit16& packet);

}  // namespace defocus::engine
