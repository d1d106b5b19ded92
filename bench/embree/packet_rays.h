#pragma once
// Computes the same rays as lens_rays.h, but for packets of pixels in tiles of 16 × 16 px.

#include <array>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

inline constexpr int tileSide = 16;  // width and height of a tile, px
inline constexpr int packetsPerTileRow = tileSide / packetSide;
inline constexpr int packetsPerTile = packetsPerTileRow * packetsPerTileRow;

// Origin and slopes of the rays of a tile whose pixels share a lens sample. The values are computed in double and
// rounded once, so that no accuracy is lost.
struct TileRays {
    std::array<float, tileSide> slopeX{};  // horizontal slope of the rays in each pixel column: x per unit of depth
    std::array<float, tileSide> slopeY{};  // vertical slope of the rays in each pixel row
    float originX = 0;
    float originY = 0;
};

// Returns the rays of the tile whose first pixel is (left, top). `pixel`: point in each pixel ([0, 1)² px, right and
// down). `lens`: point on the lens (unit disk).
TileRays tileRays(const LensCamera& camera, const View& view, int left, int top, const glm::dvec2& pixel,
                  const glm::dvec2& lens);

// Sets the rays of packet `place` of the tile, for the lens sample that all its pixels share. Packets are counted row
// by row.
void makeRays(const TileRays& tile, int place, RTCRayHit16& packet);

// Sets the rays of a packet with a different sample in each pixel. `tile` must have been computed with `pixel` and
// `lens` {0, 0}, because `points` are added to it.
void makeRays(const TileRays& tile, int place, const LensCamera& camera, const View& view, const PacketPoints& points,
              RTCRayHit16& packet);

}  // namespace defocus::engine
