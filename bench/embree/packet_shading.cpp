#include "embree/packet_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/error.h"
#include "embree/traced_shading.h"

namespace defocus::engine {

namespace {

// Interpolates between three corner values with barycentric weights. Weighted differences are added to the first
// corner's value, so that three equal values give exactly that value.
DEFOCUS_ALWAYS_INLINE float mixed(float a, float b, float c, float u, float v) {
    return a + u * (b - a) + v * (c - a);
}

DEFOCUS_VECTOR_CLONES void addLanes(Lanes<double>& sum, const FloatLanes& values) {
    for (int i = 0; i < packetSize; ++i) sum[i] += static_cast<double>(values[i]);
}

}  // namespace

PacketShading::PacketShading(const World& world, const TracedScene& scene, const glm::dmat3& worldFromCamera)
    : world_(world), scene_(scene) {
    const Environment& environment = world.environment;
    if (environment.type != EnvironmentType::none && environment.visible) {
        const bool gradient = environment.type == EnvironmentType::gradient;
        sky_.zenith = environment.zenith;
        sky_.horizon = gradient ? environment.horizon : environment.zenith;
        sky_.nadir = gradient ? environment.nadir : environment.zenith;
        sky_.up = glm::vec3(glm::transpose(worldFromCamera) * glm::dvec3(0, 1, 0));
        sky_.alpha = 1;
    }
    surfaces_.miss = scene.geometryCount();
    surfaces_.cornerColors.assign(3, glm::vec3(1));
    for (std::uint32_t id = 0; id < scene.geometryCount(); ++id) addGeometry(scene.geometry(id));
    surfaces_.firstColor.push_back(0);
    surfaces_.colorsPerTriangle.push_back(0);
    for (std::vector<float>* channel : {&surfaces_.red, &surfaces_.green, &surfaces_.blue}) channel->push_back(0);
}

void PacketShading::addGeometry(const TracedGeometry& geometry) {
    const std::vector<glm::vec4>& colors = geometry.mesh->vertices.colors;
    const Material& material = *geometry.material;
    surfaces_.firstColor.push_back(colors.empty() ? 0 : static_cast<std::int32_t>(surfaces_.cornerColors.size()));
    surfaces_.colorsPerTriangle.push_back(colors.empty() ? 0 : 3);
    if (!colors.empty()) {
        const std::vector<std::uint32_t>& indices = geometry.primitive->indices;
        if (surfaces_.cornerColors.size() + indices.size() > std::numeric_limits<std::int32_t>::max())
            fail("method embree: more than {} M triangles can't be shaded", (1u << 31) / 3'000'000);
        for (const std::uint32_t index : indices) surfaces_.cornerColors.emplace_back(colors[index]);
    }
    surfaces_.red.push_back(material.baseColorFactor.r);
    surfaces_.green.push_back(material.baseColorFactor.g);
    surfaces_.blue.push_back(material.baseColorFactor.b);
    rayByRay_.push_back(!material.unlit || material.baseColor.used());
    anyRayByRay_ = anyRayByRay_ || rayByRay_.back();
}

DEFOCUS_VECTOR_CLONES void PacketShading::baseColors(const Surfaces& surfaces, const RTCRayHit16& packet,
                                                     PacketColors& __restrict colors) {
    const std::int32_t* firstColor = surfaces.firstColor.data();
    const std::int32_t* colorsPerTriangle = surfaces.colorsPerTriangle.data();
    const glm::vec3* corners = surfaces.cornerColors.data();
    const float* red = surfaces.red.data();
    const float* green = surfaces.green.data();
    const float* blue = surfaces.blue.data();
    const std::uint32_t miss = surfaces.miss;
    for (int i = 0; i < packetSize; ++i) {
        const auto id = static_cast<std::int32_t>(std::min(packet.hit.geomID[i], miss));
        const auto triangle = static_cast<std::uint32_t>(colorsPerTriangle[id]) * packet.hit.primID[i];
        const std::int32_t first = firstColor[id] + static_cast<std::int32_t>(triangle);
        const glm::vec3& a = corners[first];
        const glm::vec3& b = corners[first + 1];
        const glm::vec3& c = corners[first + 2];
        const float u = packet.hit.u[i];
        const float v = packet.hit.v[i];
        colors.red[i] = red[id] * mixed(a.r, b.r, c.r, u, v);
        colors.green[i] = green[id] * mixed(a.g, b.g, c.g, u, v);
        colors.blue[i] = blue[id] * mixed(a.b, b.b, c.b, u, v);
        colors.alpha[i] = 1;
    }
}

DEFOCUS_VECTOR_CLONES void PacketShading::skyColors(const Sky& sky, std::uint32_t miss, const RTCRayHit16& packet,
                                                    PacketColors& __restrict colors) {
    const glm::vec3 toZenith = sky.zenith - sky.horizon;
    const glm::vec3 toNadir = sky.nadir - sky.horizon;
    for (int i = 0; i < packetSize; ++i) {
        const float x = packet.ray.dir_x[i];
        const float y = packet.ray.dir_y[i];
        const float z = packet.ray.dir_z[i];
        const float height = (x * sky.up.x + y * sky.up.y + z * sky.up.z) / std::sqrt(x * x + y * y + z * z);
        const float above = height > 0 ? height : 0;
        const float below = height > 0 ? 0 : -height;
        const float missed = packet.hit.geomID[i] >= miss ? 1.0f : 0.0f;  // 1 if the ray missed; its colour is black
        colors.red[i] += missed * (sky.horizon.x + above * toZenith.x + below * toNadir.x);
        colors.green[i] += missed * (sky.horizon.y + above * toZenith.y + below * toNadir.y);
        colors.blue[i] += missed * (sky.horizon.z + above * toZenith.z + below * toNadir.z);
        colors.alpha[i] = 1 - missed * (1 - sky.alpha);
    }
}

PacketColors PacketShading::radiance(const RTCRayHit16& packet,
                                     const std::array<glm::vec2, packetSize>* lightPoints) const {
    PacketColors colors;
    baseColors(surfaces_, packet, colors);
    const unsigned* ids = packet.hit.geomID;
    if (std::any_of(ids, ids + packetSize, [&](unsigned id) { return id >= surfaces_.miss; }))
        skyColors(sky_, surfaces_.miss, packet, colors);
    if (!anyRayByRay_) return colors;
    for (int i = 0; i < packetSize; ++i) {
        if (ids[i] >= surfaces_.miss || !rayByRay_[ids[i]]) continue;
        const glm::vec3 color = surfaceRadiance(
            world_, scene_.geometry(ids[i]),
            {.triangle = packet.hit.primID[i],
             .u = packet.hit.u[i],
             .v = packet.hit.v[i],
             .facet = {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]},
             .direction = {packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]},
             .distance = packet.ray.tfar[i],
             .origin = {packet.ray.org_x[i], packet.ray.org_y[i], packet.ray.org_z[i]}},
            lightPoints != nullptr ? ShadowRays{&scene_, (*lightPoints)[static_cast<std::size_t>(i)]} : ShadowRays{});
        colors.red[i] = color.r;
        colors.green[i] = color.g;
        colors.blue[i] = color.b;
    }
    return colors;
}

std::uint64_t PacketShading::bytes() const {
    return surfaces_.cornerColors.capacity() * sizeof(std::uint32_t);
}

void addTo(PacketSum& sum, const PacketColors& colors) {
    addLanes(sum.channels[0], colors.red);
    addLanes(sum.channels[1], colors.green);
    addLanes(sum.channels[2], colors.blue);
    addLanes(sum.channels[3], colors.alpha);
}

}  // namespace defocus::engine
