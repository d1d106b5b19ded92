#pragma once
// What the rays of a packet see: base colours and skies of all lanes at once, from data laid out for it; what only few
// scenes have (textures, light) one ray at a time by traced_shading.h.

#include <cstdint>
#include <vector>

#include "embree/ray_packet.h"
#include "embree/traced_scene.h"

namespace defocus::engine {

class PacketShading {
public:
    // `scene` and `world` must outlive it.
    PacketShading(const World& world, const TracedScene& scene, const glm::dmat3& worldFromCamera);

    // Radiance of all lanes, whether they were in use or not. Rays that met nothing see the surroundings.
    // `lightPoints`: as ShadowRays has it, one a lane; null: nothing casts a shadow.
    [[nodiscard]] PacketColors radiance(const RTCRayHit16& packet,
                                        const std::array<glm::vec2, packetSize>* lightPoints = nullptr) const;
    [[nodiscard]] std::uint64_t bytes() const;

private:
    void addGeometry(const TracedGeometry& geometry);

    const World& world_;
    const TracedScene& scene_;

    // Arrays by Embree geometry id, with one more geometry for a miss: black, of one triangle.
    struct Surfaces {
        std::uint32_t miss = 0;                       // its id
        std::vector<std::int32_t> firstColor;         // in cornerColors
        std::vector<std::int32_t> colorsPerTriangle;  // 3, or 0: all triangles have the same
        std::vector<float> red, green, blue;          // baseColorFactor
        std::vector<glm::vec3> cornerColors;          // three a triangle
    };
    // Radiance along a ray whose direction has the elevation `height` = sin: horizon + |height|·(zenith − horizon), or
    // nadir below the horizon.
    struct Sky {
        glm::vec3 horizon{0.0f}, zenith{0.0f}, nadir{0.0f};
        glm::vec3 up{0.0f};  // in camera space
        float alpha = 0;
    };
    static void baseColors(const Surfaces& surfaces, const RTCRayHit16& packet, PacketColors& colors);
    static void skyColors(const Sky& sky, std::uint32_t miss, const RTCRayHit16& packet, PacketColors& colors);

    Surfaces surfaces_;
    Sky sky_;
    std::vector<bool> rayByRay_;  // by geometry id
    bool anyRayByRay_ = false;
};

// Sums over samples, in double.
struct alignas(64) PacketSum {
    std::array<Lanes<double>, 4> channels;
};

void addTo(PacketSum& sum, const PacketColors& colors);

}  // namespace defocus::engine
