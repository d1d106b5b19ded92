#pragma once
// Shades the rays of a packet. Base colours and sky are computed for all lanes at once. Textures and lights, which few
// scenes have, are computed ray by ray (traced_shading.h).

#include <cstdint>
#include <vector>

#include "embree/ray_packet.h"
#include "embree/traced_scene.h"

namespace defocus::engine {

class PacketShading {
public:
    // `scene` and `world` must outlive it.
    PacketShading(const World& world, const TracedScene& scene, const glm::dmat3& worldFromCamera);

    // Returns the radiance of all lanes, including unused ones. Rays without a hit see the environment. `lightPoints`:
    // ShadowRays::lightPoint of each lane; null: no shadows.
    [[nodiscard]] PacketColors radiance(const RTCRayHit16& packet,
                                        const std::array<glm::vec2, packetSize>* lightPoints = nullptr) const;
    [[nodiscard]] std::uint64_t bytes() const;

private:
    void addGeometry(const TracedGeometry& geometry);

    const World& world_;
    const TracedScene& scene_;

    // Arrays indexed by Embree geometry id. One additional geometry stands for a miss: a single black triangle.
    struct Surfaces {
        std::uint32_t miss = 0;                       // id of the miss geometry
        std::vector<std::int32_t> firstColor;         // index into cornerColors
        std::vector<std::int32_t> colorsPerTriangle;  // 3; 0: all triangles have the same colours
        std::vector<float> red, green, blue;          // baseColorFactor
        std::vector<glm::vec3> cornerColors;          // three per triangle
    };
    // Sky radiance for the sine `height` of a ray's elevation: horizon + |height|·(zenith − horizon), with nadir
    // instead of zenith below the horizon.
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
