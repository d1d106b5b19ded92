#pragma once
// Shades the rays of a packet. Base colours and sky are computed for all lanes at once. Textures and lights, which few
// scenes have, are computed for each ray separately (traced_shading.h).

#include <cstdint>
#include <vector>

#include "embree/ray_packet.h"
#include "embree/traced_scene.h"

namespace defocus::engine {

class PacketShading {
public:
    // `scene` and `world` must outlive the object.
    PacketShading(const World& world, const TracedScene& scene, const glm::dmat3& worldFromCamera);

    // Returns the radiance of all lanes, including unused ones; for rays that hit nothing, the environment's radiance.
    // `lightPoints`: ShadowRays::lightPoint for each lane; null: no shadows.
    [[nodiscard]] PacketColors radiance(const RTCRayHit16& packet,
                                        const std::array<glm::vec2, packetSize>* lightPoints = nullptr) const;
    [[nodiscard]] std::uint64_t bytes() const;

private:
    void addGeometry(const TracedGeometry& geometry);

    const World& world_;
    const TracedScene& scene_;

    // Surface data, indexed by Embree's geometry id. An additional geometry, a single black triangle, stands for rays
    // that hit nothing (a miss).
    struct Surfaces {
        std::uint32_t miss = 0;                       // geometry id that stands for a miss
        std::vector<std::int32_t> firstColor;         // for each geometry: index of the first colour in cornerColors
        std::vector<std::int32_t> colorsPerTriangle;  // for each geometry: 3 colours; 0: all triangles share 3 colours
        std::vector<float> red, green, blue;          // for each geometry: components of baseColorFactor
        std::vector<glm::vec3> cornerColors;          // three vertex colours per triangle
    };
    // The sky's radiance for a ray at elevation e is horizon + |sin e|·(zenith − horizon). Below the horizon, nadir
    // replaces zenith.
    struct Sky {
        glm::vec3 horizon{0.0f}, zenith{0.0f}, nadir{0.0f};
        glm::vec3 up{0.0f};  // world up, in camera space
        float alpha = 0;
    };
    static void baseColors(const Surfaces& surfaces, const RTCRayHit16& packet, PacketColors& colors);
    static void skyColors(const Sky& sky, std::uint32_t miss, const RTCRayHit16& packet, PacketColors& colors);

    Surfaces surfaces_;
    Sky sky_;
    std::vector<bool> rayByRay_;  // by geometry id; true: each ray is shaded separately
    bool anyRayByRay_ = false;
};

// Colours summed over the samples for each pixel of a packet, in double.
struct alignas(64) PacketSum {
    std::array<Lanes<double>, 4> channels;
};

void addTo(PacketSum& sum, const PacketColors& colors);

}  // namespace defocus::engine
