// The shading is that of shaders/include/shading.glsl, which says where it is from.

#include "lod/pyramid/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "lod/simplify/light.h"
#include "scene/defaults.h"

namespace defocus {

namespace {

constexpr float skyRadiance = 0.5f;  // about the mean of the default sky
constexpr float backBias = 1e-3f;    // cells by which a face that looks away lies behind one at its place

// What is nearest to the eye at the middle of a cell.
struct Hit {
    float z = -std::numeric_limits<float>::infinity();
    std::uint32_t first = 0;      // of the triangle's three indices, among the pyramid's
    std::uint32_t primitive = 0;  // of the mesh
    float b = 0, c = 0;           // weights of the second and third corner
    bool back = false;            // the triangle looks away
};

void drawTriangle(const std::array<glm::vec3, 3>& p, std::uint32_t first, std::uint32_t primitive, const Eye& eye,
                  std::vector<Hit>& hits) {
    const auto [lowX, highX] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [lowY, highY] = std::minmax({p[0].y, p[1].y, p[2].y});
    const float top = static_cast<float>(eye.resolution) - 1;
    const float left = std::max(std::ceil(lowX - 0.5f), 0.0f);
    const float right = std::min(std::floor(highX - 0.5f), top);
    const float below = std::max(std::ceil(lowY - 0.5f), 0.0f);
    const float above = std::min(std::floor(highY - 0.5f), top);
    if (!(left <= right && below <= above)) return;
    const glm::vec2 ab = glm::vec2(p[1]) - glm::vec2(p[0]);
    const glm::vec2 ac = glm::vec2(p[2]) - glm::vec2(p[0]);
    const float twice = ab.x * ac.y - ab.y * ac.x;
    if (twice == 0) return;
    const float inverse = 1 / twice;
    const bool back = twice < 0;
    // Weights are linear in the place.
    const glm::vec2 stepB = inverse * glm::vec2(ac.y, -ac.x);
    const glm::vec2 stepC = inverse * glm::vec2(-ab.y, ab.x);
    const float stepZ1 = p[1].z - p[0].z;
    const float stepZ2 = p[2].z - p[0].z;
    const float z0 = p[0].z - (back ? backBias : 0);
    for (int y = static_cast<int>(below); y <= static_cast<int>(above); ++y) {
        Hit* const row = &hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.resolution)];
        const float dy = static_cast<float>(y) + 0.5f - p[0].y;
        for (int x = static_cast<int>(left); x <= static_cast<int>(right); ++x) {
            const float dx = static_cast<float>(x) + 0.5f - p[0].x;
            const float b = stepB.x * dx + stepB.y * dy;
            const float c = stepC.x * dx + stepC.y * dy;
            if (!(b >= 0 && c >= 0 && b + c <= 1)) continue;
            const float z = z0 + b * stepZ1 + c * stepZ2;
            if (z > row[x].z) row[x] = {z, first, primitive, b, c, back};
        }
    }
}

// ---- light

struct SurfacePoint {
    glm::vec3 diffuse{0}, specular{0};
    float roughness = 1;
    glm::vec3 normal{0};
    float agreement = 1;  // length of the mean of the normals that `normal` stands for
    float spread = 0;     // normalSpread()
    glm::vec3 seen{0};    // seenNormal()
};

struct DistantLight {
    glm::vec3 toLight{0};
    glm::vec3 illuminance{0};  // over π
};

// They stand as seen from the eye.
std::vector<DistantLight> lightsFor(const Eye& eye) {
    std::vector<DistantLight> lights;
    for (const StudioLight& light : studioLights()) {
        const glm::dvec3 seen = light.toLight();
        lights.push_back({glm::vec3(seen.x * eye.right + seen.y * eye.up + seen.z * eye.towards),
                          light.color * light.illuminance / std::numbers::pi_v<float>});
    }
    return lights;
}

// The mean of the normals as they are seen.
glm::vec3 seenNormal(const SurfacePoint& point, const glm::vec3& toEye) {
    const float nv = glm::dot(point.normal, toEye);
    const float seen = std::max(meanCosine(point.agreement * nv, nv, point.spread), 1e-3f);
    const float turn = (1 - point.agreement) / seen;
    const float bound = 1.23f * turn / ((1 + point.agreement) * seen) * std::max(1 - nv * nv, 0.0f);
    return point.agreement * point.normal + turn / std::sqrt(1 + bound) * (toEye - nv * point.normal);
}

glm::vec3 lightFrom(const DistantLight& light, const SurfacePoint& point, const glm::vec3& toEye) {
    const float cosine = glm::dot(point.normal, light.toLight);
    const float matt = meanCosine(glm::dot(point.seen, light.toLight), cosine, point.spread);
    const float nv = glm::dot(point.normal, toEye);
    const float spread = 2 * (1 - point.agreement) / point.agreement;
    const float width = point.roughness * point.roughness;
    const float alpha2 = std::clamp(width * width + spread, 1e-6f, 1.0f);
    const float share = std::min(spread * (1 - width) / alpha2, 1.0f);
    const float sum2 = std::max(2 + 2 * glm::dot(light.toLight, toEye), 1e-6f);
    const float vh = 0.5f * std::sqrt(sum2);
    const float cosines = std::max(cosine + nv, 0.0f);
    const float cosines2 = cosines * cosines;
    const float base = std::max(cosines2 * (alpha2 - 1) + sum2, alpha2 * sum2);
    const float ggx = alpha2 / (base * base);
    const float away = std::max(cosines2, 1e-4f * sum2);
    const float beckmann = std::exp(-std::max(sum2 - away, 0.0f) / (away * alpha2)) / (alpha2 * away * away);
    const float distribution = sum2 * sum2 * glm::mix(ggx, beckmann, share);
    const float shownL = std::max(glm::mix(cosine, vh, share), 0.0f);
    const float shownV = std::max(glm::mix(nv, meanCosine(point.agreement * nv, nv, point.spread), share), 0.0f);
    const float masking = std::max(glm::mix(2 * shownL * shownV, shownL + shownV, width), 1e-4f);
    const float specular = shownV > 0 ? 0.5f * shownL * distribution / masking : 0;
    const float grazing = std::pow(std::max(1 - vh, 0.0f), 5.0f);
    const glm::vec3 reflectance = point.specular * (1 - grazing) + grazing;
    return light.illuminance *
           (point.diffuse * (1.0f - point.specular) * (matt * (1 - grazing)) + reflectance * specular);
}

// The share of a white sky's light that the specular part throws back.
glm::vec3 specularAlbedo(const SurfacePoint& point, float nv) {
    const glm::vec4 r =
        point.roughness * glm::vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + glm::vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    const float a = std::min(r.x * r.x, std::exp2(-9.28f * nv)) * r.x + r.y;
    return glm::clamp(point.specular * (r.z - 1.04f * a) + (r.w + 1.04f * a), 0.0f, 1.0f);
}

glm::vec3 skyLight(const SurfacePoint& point, const glm::vec3& toEye) {
    const glm::vec3 specular = specularAlbedo(point, std::max(glm::dot(point.normal, toEye), 0.0f));
    return skyRadiance * (point.diffuse * (1.0f - specular) + specular);
}

// The light that is seen of what was hit. What has no finish is matt: it reflects nothing.
class Shading {
public:
    Shading(const PyramidLevel& level, bool coarse, const Eye& eye)
        : level_(level), coarse_(coarse), toEye_(eye.towards), lights_(lightsFor(eye)) {}

    [[nodiscard]] glm::vec3 at(const std::uint32_t* corners, const Hit& hit, const Finish& finish) const {
        const float a = 1 - hit.b - hit.c;
        const auto mix = [&](const auto& values) {
            return a * values[corners[0]] + hit.b * values[corners[1]] + hit.c * values[corners[2]];
        };
        const glm::vec2 uv0 = level_.uv0.empty() ? glm::vec2(0) : mix(level_.uv0);
        const glm::vec2 uv1 = level_.uv1.empty() ? glm::vec2(0) : mix(level_.uv1);
        glm::vec3 color = finish.baseColor * finish.baseColorMap.at(uv0, uv1);
        if (!level_.colors.empty()) color *= glm::vec3(mix(level_.colors));
        if (finish.unlit) return color;

        const glm::vec3 surface = finish.metallicRoughnessMap.at(uv0, uv1);
        const float metallic = finish.metallic * surface.z;
        const glm::vec3 normal = mix(level_.normals);
        const float length = glm::length(normal);
        SurfacePoint point;
        point.diffuse = color * (1 - metallic);
        point.specular = glm::mix(glm::vec3(finish.reflectance), color, metallic);
        point.roughness = finish.roughness * surface.y;
        if (length > 0) point.normal = (hit.back ? -1 : 1) / length * normal;
        if (coarse_) {
            point.agreement = std::clamp(a * glm::length(level_.normals[corners[0]]) +
                                             hit.b * glm::length(level_.normals[corners[1]]) +
                                             hit.c * glm::length(level_.normals[corners[2]]),
                                         leastShownAgreement, 1.0f);
            point.spread = normalSpread(point.agreement);
        }
        point.seen = seenNormal(point, toEye_);
        glm::vec3 light = finish.emission * finish.emissionMap.at(uv0, uv1);
        if (finish.reflectance > 0 || metallic > 0) {
            light += skyLight(point, toEye_);
            for (const DistantLight& each : lights_) light += lightFrom(each, point, toEye_);
        } else {
            light += point.diffuse * skyRadiance;
            for (const DistantLight& each : lights_)
                light +=
                    point.diffuse * each.illuminance *
                    meanCosine(glm::dot(point.seen, each.toLight), glm::dot(point.normal, each.toLight), point.spread);
        }
        return light;
    }

private:
    const PyramidLevel& level_;
    bool coarse_;
    glm::vec3 toEye_;
    std::vector<DistantLight> lights_;
};

}  // namespace

glm::vec3 Eye::place(const glm::vec3& position) const {
    const glm::dvec3 p = cellsPerUnit * (glm::dvec3(position) - centre);
    return {glm::dot(p, right) + 0.5 * resolution, glm::dot(p, up) + 0.5 * resolution, glm::dot(p, towards)};
}

Eye eyeAlong(const Pyramid& pyramid, const glm::dvec3& towards, int resolution) {
    Eye eye;
    eye.centre = pyramid.bounds.centre();
    eye.towards = towards;
    eye.right = glm::normalize(glm::cross(glm::dvec3(0.36, 0.48, 0.8), towards));
    eye.up = glm::cross(towards, eye.right);
    eye.cellsPerUnit = resolution / glm::length(pyramid.bounds.size());
    eye.resolution = resolution;
    return eye;
}

Picture pictureOf(const Pyramid& pyramid, std::size_t number, const Eye& eye, std::span<const Finish> finishes) {
    const PyramidLevel& level = pyramid.levels[number];
    std::vector<glm::vec3> places;
    places.reserve(level.positions.size());
    for (const glm::vec3& position : level.positions) places.push_back(eye.place(position));
    const std::size_t cells = static_cast<std::size_t>(eye.resolution) * static_cast<std::size_t>(eye.resolution);
    std::vector<Hit> hits(cells);
    for (std::uint32_t p = 0; p < level.primitives.size(); ++p)
        for (std::uint32_t i = 0; i < level.primitives[p].count; i += 3) {
            const std::uint32_t first = level.primitives[p].first + i;
            const std::uint32_t* const corners = &pyramid.indices[first];
            drawTriangle({places[corners[0]], places[corners[1]], places[corners[2]]}, first, p, eye, hits);
        }
    places = {};

    const Shading shading(level, number > 0, eye);
    Picture picture;
    picture.light.assign(cells, glm::vec3(0));
    for (std::size_t i = 0; i < cells; ++i) {
        if (!std::isfinite(hits[i].z)) continue;
        const glm::vec3 light = shading.at(&pyramid.indices[hits[i].first], hits[i], finishes[hits[i].primitive]);
        if (!std::isfinite(light.x + light.y + light.z)) continue;
        picture.light[i] = light;
        picture.sum += (double{light.x} + double{light.y} + double{light.z}) / 3;
        ++picture.covered;
    }
    return picture;
}

}  // namespace defocus
