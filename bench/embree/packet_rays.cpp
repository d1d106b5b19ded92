#include "embree/packet_rays.h"

namespace defocus::engine {

namespace {

// How a ray changes when the point in the pixel moves by 1 px, or the lens point by the lens radius.
struct RaySteps {
    float pixelX, pixelY;  // change in slope per px
    float radius;          // lens radius in m; a ray's origin is this radius times its lens point
    float focus;           // decrease in slope per lens radius; the ray then meets the same point on the plane of focus
};

DEFOCUS_VECTOR_CLONES void addSamples(const RaySteps& steps, const PacketPoints& points, RTCRayHit16& packet) {
    for (int i = 0; i < packetSize; ++i) {
        packet.ray.org_x[i] = steps.radius * points.lensX[i];
        packet.ray.org_y[i] = steps.radius * points.lensY[i];
        packet.ray.dir_x[i] += steps.pixelX * points.pixelX[i] - steps.focus * points.lensX[i];
        packet.ray.dir_y[i] += steps.pixelY * points.pixelY[i] - steps.focus * points.lensY[i];
    }
}

}  // namespace

TileRays tileRays(const LensCamera& camera, const View& view, int left, int top, const glm::dvec2& pixel,
                  const glm::dvec2& lens) {
    TileRays rays;
    for (int i = 0; i < tileSide; ++i) {
        const glm::dvec2 place = glm::dvec2(left + i, top + i) + pixel;  // position in px from the top left corner
        const LensRay ray = lensRay(camera, {2 * place.x / view.width - 1, 1 - 2 * place.y / view.height}, lens);
        rays.slopeX[static_cast<std::size_t>(i)] = ray.direction.x;
        rays.slopeY[static_cast<std::size_t>(i)] = ray.direction.y;
        rays.originX = ray.origin.x;
        rays.originY = ray.origin.y;
    }
    return rays;
}

void makeRays(const TileRays& tile, int place, RTCRayHit16& packet) {
    const float* slopeX = tile.slopeX.data() + place % packetsPerTileRow * packetSide;
    const float* slopeY = tile.slopeY.data() + place / packetsPerTileRow * packetSide;
    for (int i = 0; i < packetSize; ++i) {
        packet.ray.org_x[i] = tile.originX;
        packet.ray.org_y[i] = tile.originY;
        packet.ray.org_z[i] = 0;
        packet.ray.dir_x[i] = slopeX[i % packetSide];
        packet.ray.dir_y[i] = slopeY[i / packetSide];
        packet.ray.dir_z[i] = -1;
    }
}

void makeRays(const TileRays& tile, int place, const LensCamera& camera, const View& view, const PacketPoints& points,
              RTCRayHit16& packet) {
    makeRays(tile, place, packet);
    const RaySteps steps{.pixelX = static_cast<float>(2 * camera.tanHalfHorizontal / view.width),
                         .pixelY = static_cast<float>(-2 * camera.tanHalfVertical / view.height),
                         .radius = static_cast<float>(camera.lensRadius),
                         .focus = static_cast<float>(camera.lensRadius * camera.reciprocalFocus)};
    addSamples(steps, points, packet);
}

}  // namespace defocus::engine
