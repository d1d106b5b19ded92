// Shades hits of rays. Sources: Lambert 1760; IEC 61966-2-1 (sRGB decoding); KHR_lights_punctual (1 lux on a white
// Lambert surface gives 1/π cd/m²); Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square (points on
// lights).

#include "embree/traced_shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace defocus::engine {

namespace {

// Vertices of the hit triangle, and the barycentric weights of the hit point.
struct Corners {
    std::array<std::uint32_t, 3> vertices{};
    glm::vec3 weights{0.0f};

    template <typename Value>
    [[nodiscard]] Value mix(const std::vector<Value>& values) const {
        return weights.x * values[vertices[0]] + weights.y * values[vertices[1]] + weights.z * values[vertices[2]];
    }
};

Corners cornersOf(const TracedGeometry& geometry, const SurfaceHit& hit) {
    const std::uint32_t* first = geometry.primitive->indices.data() + 3 * static_cast<std::size_t>(hit.triangle);
    return {{first[0], first[1], first[2]}, glm::vec3(1 - hit.u - hit.v, hit.u, hit.v)};
}

float decoded(std::uint8_t value) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> linear{};
        for (std::size_t i = 0; i < linear.size(); ++i) {
            const double encoded = static_cast<double>(i) / 255;
            linear[i] =
                static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
        }
        return linear;
    }();
    return table[value];
}

int wrapped(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clampToEdge) return std::clamp(texel, 0, size - 1);
    const int period = wrap == Wrap::repeat ? size : 2 * size;
    const int inside = ((texel % period) + period) % period;
    return inside < size ? inside : period - 1 - inside;
}

glm::vec3 texel(const TextureImage& image, const Texture& texture, int x, int y) {
    const auto column = static_cast<std::size_t>(wrapped(x, image.width, texture.wrapS));
    const auto row = static_cast<std::size_t>(wrapped(y, image.height, texture.wrapT));
    const std::uint8_t* rgba = image.rgba.data() + 4 * (row * static_cast<std::size_t>(image.width) + column);
    return {decoded(rgba[0]), decoded(rgba[1]), decoded(rgba[2])};
}

// Returns the texture's base colour from level 0 (full resolution); texels are decoded before filtering.
glm::vec3 textureColor(const Scene& scene, const TextureUse& use, const glm::vec2& uv) {
    const Texture& texture = scene.textures[static_cast<std::size_t>(use.texture)];
    if (texture.image < 0) return glm::vec3(1);
    const TextureImage& image = scene.images[static_cast<std::size_t>(texture.image)];
    if (image.width <= 0 || image.height <= 0) return glm::vec3(1);
    const glm::vec2 place = glm::vec2(use.uvTransform * glm::vec3(uv, 1)) * glm::vec2(image.width, image.height);
    // Clamp, so that extreme texture coordinates don't overflow the integer texel index.
    const glm::vec2 bounded = glm::clamp(place, glm::vec2(-1e6f), glm::vec2(1e6f));
    if (texture.magnification == Filter::nearest) {
        const glm::ivec2 cell(glm::floor(bounded));
        return texel(image, texture, cell.x, cell.y);
    }
    const glm::vec2 corner = glm::floor(bounded - 0.5f);
    const glm::vec2 fraction = bounded - 0.5f - corner;
    const glm::ivec2 cell(corner);
    const glm::vec3 top =
        glm::mix(texel(image, texture, cell.x, cell.y), texel(image, texture, cell.x + 1, cell.y), fraction.x);
    const glm::vec3 bottom =
        glm::mix(texel(image, texture, cell.x, cell.y + 1), texel(image, texture, cell.x + 1, cell.y + 1), fraction.x);
    return glm::mix(top, bottom, fraction.y);
}

glm::vec3 baseColor(const Scene& scene, const TracedGeometry& geometry, const Corners& corners) {
    const Material& material = *geometry.material;
    const Vertices& vertices = geometry.mesh->vertices;
    glm::vec3 color(material.baseColorFactor);
    if (!vertices.colors.empty()) {
        glm::vec3 tint(0);
        for (glm::length_t i = 0; i < 3; ++i) {
            tint += corners.weights[i] * glm::vec3(vertices.colors[corners.vertices[static_cast<std::size_t>(i)]]);
        }
        color *= tint;
    }
    const std::vector<glm::vec2>& uvs = material.baseColor.uvSet == 1 ? vertices.uv1 : vertices.uv0;
    if (material.baseColor.used() && !uvs.empty()) color *= textureColor(scene, material.baseColor, corners.mix(uvs));
    return color;
}

// Returns the unit shading normal in world space, on the side of the surface that the ray comes from.
glm::vec3 shadingNormal(const TracedGeometry& geometry, const Corners& corners, const SurfaceHit& hit) {
    const float behind = glm::dot(hit.facet, hit.direction) * geometry.facing;
    const glm::vec3 front = geometry.normals->empty() ? geometry.facing * (geometry.worldFromCamera * hit.facet)
                                                      : geometry.worldNormalFromObject * corners.mix(*geometry.normals);
    const float length = glm::length(front);
    return length > 0 ? front * ((behind > 0 ? -1.0f : 1.0f) / length) : glm::vec3(0);
}

// Maps the square [0, 1)² to the unit disk; concentric squares map to concentric circles.
glm::vec2 onDisk(const glm::vec2& place) {
    const float a = 2 * place.x - 1;
    const float b = 2 * place.y - 1;
    const float ring = std::max(std::abs(a), std::abs(b));
    if (!(ring > 0)) return glm::vec2(0);
    constexpr float eighth = std::numbers::pi_v<float> / 4;
    float angle = 0;  // polar angle on the disk; each side of a concentric square becomes a quarter turn
    if (std::abs(a) > std::abs(b))
        angle = a > 0 ? eighth * b / a : eighth * (4 + b / a);
    else
        angle = b > 0 ? eighth * (2 - a / b) : eighth * (6 - a / b);
    return {ring * std::cos(angle), ring * std::sin(angle)};
}

// Light that arrives at a point if nothing blocks it: the illuminance in lux on a surface perpendicular to the light.
struct Incoming {
    glm::vec3 illuminance{0.0f};
    glm::vec3 toMiddle{0.0f};  // unit vector to the light's centre
    float distance = 0;        // distance in m to the light's centre; 0: infinitely far
};

Incoming incomingAt(const PlacedLight& placed, const glm::dvec3& place) {
    const Light& light = placed.light;
    const glm::vec3 power = light.color * light.intensity;
    if (light.type == LightType::directional) return {power, -glm::vec3(placed.direction), 0};
    const glm::dvec3 offset = placed.position - place;
    Incoming incoming;
    incoming.distance = static_cast<float>(glm::length(offset));
    if (!(incoming.distance > 0)) return incoming;
    incoming.toMiddle = glm::vec3(offset / double{incoming.distance});
    float share = 1 / (incoming.distance * incoming.distance);
    if (light.range > 0) share *= std::clamp(1 - std::pow(incoming.distance / light.range, 4.0f), 0.0f, 1.0f);
    if (light.type == LightType::spot) {
        const float inner = std::cos(light.innerConeAngle);
        const float outer = std::cos(light.outerConeAngle);
        const float cosine = -glm::dot(glm::vec3(placed.direction), incoming.toMiddle);
        const float cone = std::clamp((cosine - outer) / std::max(inner - outer, 1e-4f), 0.0f, 1.0f);
        share *= cone * cone;
    }
    incoming.illuminance = power * share;
    return incoming;
}

// Returns whether a surface lies between the hit point and the sample point of the light. The light is a disk that
// faces the hit point.
bool hidden(const PlacedLight& placed, const Incoming& incoming, const TracedGeometry& geometry, const SurfaceHit& hit,
            const ShadowRays& shadows) {
    // Axes of the light's disk. The rasteriser's plan uses the same axes for its sample points on lights.
    const glm::vec3 front = incoming.toMiddle;
    const glm::vec3 up = std::abs(front.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, front));
    const glm::vec2 at = onDisk(shadows.lightPoint);
    const bool far = placed.light.type == LightType::directional;
    const float radius = far ? std::tan(0.5f * placed.light.angularDiameter) : placed.light.radius;
    const glm::vec3 aside = radius * (at.x * right + at.y * glm::cross(front, right));
    const glm::vec3 toPoint = (far ? front : incoming.distance * front) + aside;

    // The shadow ray starts just above the facet, on its visible side. It ends one lamp diameter before the light, so
    // that the glass of a lamp that surrounds the light casts no shadow.
    const glm::vec3 place = hit.origin + hit.distance * hit.direction;
    const glm::vec3 facet = glm::normalize(hit.facet);
    const float lift = 1e-5f * std::max(1.0f, glm::length(place));
    const glm::vec3 above = place + (glm::dot(facet, hit.direction) > 0 ? -lift : lift) * facet;
    const glm::vec3 direction = glm::transpose(geometry.worldFromCamera) * toPoint;
    const float reach = far ? std::numeric_limits<float>::infinity() : 1 - 2 * radius / glm::length(toPoint);
    return reach > 0 && shadows.scene->occluded(above, direction, reach);
}

}  // namespace

glm::vec3 surfaceRadiance(const World& world, const TracedGeometry& geometry, const SurfaceHit& hit,
                          const ShadowRays& shadows) {
    const Corners corners = cornersOf(geometry, hit);
    const glm::vec3 base = baseColor(*world.scene, geometry, corners);
    if (geometry.material->unlit) return base;

    const glm::vec3 normal = shadingNormal(geometry, corners, hit);
    const glm::vec3 albedo = base * (1 - geometry.material->metallicFactor) / std::numbers::pi_v<float>;
    glm::vec3 radiance = geometry.material->emissiveFactor;
    const glm::dvec3 place =
        geometry.camera + glm::dmat3(geometry.worldFromCamera) * glm::dvec3(hit.origin + hit.distance * hit.direction);
    for (const PlacedLight& light : world.lights) {
        const Incoming incoming = incomingAt(light, place);
        const float cosine = glm::dot(normal, incoming.toMiddle);
        if (!(cosine > 0)) continue;
        if (shadows.scene != nullptr && hidden(light, incoming, geometry, hit, shadows)) continue;
        radiance += albedo * incoming.illuminance * cosine;
    }
    return radiance;
}

}  // namespace defocus::engine
