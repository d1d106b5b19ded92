#pragma once
// Shades the cells (pixels) of an image from picture.h. Private to picture.cpp. The shading model is the same as in
// shaders/include/shading.glsl, which cites the sources.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "lod/pyramid/picture.h"
#include "lod/simplify/light.h"
#include "scene/defaults.h"
#include "scene/specular_albedo.h"

namespace defocus::engine {

inline constexpr float skyRadiance = 0.5f;  // approximate mean radiance of the default sky

// Barycentric weights of a triangle's second and third corner, as linear functions of the position in the image.
struct Weights {
    glm::vec2 origin{0};  // position of the first corner in the image, where both weights are 0
    glm::vec2 stepB{0}, stepC{0};
    bool flat = false;  // the triangle has no area
    bool back = false;  // the triangle is back-facing

    Weights() = default;
    Weights(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) : origin(p) {
        const glm::vec2 ab = glm::vec2(q) - glm::vec2(p);
        const glm::vec2 ac = glm::vec2(r) - glm::vec2(p);
        const float twice = ab.x * ac.y - ab.y * ac.x;
        flat = twice == 0;
        back = twice < 0;
        const float inverse = 1 / twice;
        stepB = inverse * glm::vec2(ac.y, -ac.x);
        stepC = inverse * glm::vec2(-ab.y, ab.x);
    }

    // Returns the weights of the triangle's second and third corner at the centre of pixel (x, y). `x` may be a SIMD
    // vector of four indices.
    template <typename X>
    [[nodiscard]] std::array<X, 2> at(const X& x, float y) const {
        const X dx = x + 0.5f - origin.x;
        const float dy = y + 0.5f - origin.y;
        return {stepB.x * dx + stepB.y * dy, stepC.x * dx + stepC.y * dy};
    }
};

struct SurfacePoint {
    glm::vec3 diffuse{0}, specular{0};
    float roughness = 1;
    glm::vec3 normal{0};
    float agreement = 1;  // length of the mean of the unit normals that `normal` represents
};

struct DistantLight {
    glm::vec3 toLight{0};
    glm::vec3 illuminance{0};  // illuminance of the light divided by π
    // Terms that depend only on the directions to the light and to the eye. lv: cosine of the angle between the two
    // unit vectors. sum2: squared length of their sum. vh: half the length of their sum. grazing: Fresnel weight of
    // reflectance at grazing incidence.
    float lv = 0, sum2 = 0, vh = 0, grazing = 0;
};

// Returns the default lights; their directions are relative to the eye.
inline std::vector<DistantLight> lightsFor(const Eye& eye) {
    std::vector<DistantLight> lights;
    for (const StudioLight& light : studioLights()) {
        const glm::dvec3 seen = light.toLight();
        DistantLight own;
        own.toLight = glm::vec3(seen.x * eye.right + seen.y * eye.up + seen.z * eye.towards);
        own.illuminance = light.color * light.illuminance / std::numbers::pi_v<float>;
        own.lv = glm::dot(own.toLight, glm::vec3(eye.towards));
        own.sum2 = std::max(2 + 2 * own.lv, 1e-6f);
        own.vh = 0.5f * std::sqrt(own.sum2);
        own.grazing = std::pow(std::max(1 - own.vh, 0.0f), 5.0f);
        lights.push_back(own);
    }
    return lights;
}

// The visible part of a distribution of normals. The distribution is stored as its mean normal, whose length gives the
// spread.
struct SeenNormals {
    float spread = 0;              // spread of the distribution, from normalSpread()
    float shown = 0;               // mean cosine of the angle between the visible normals and the eye direction
    float along = 1, towards = 0;  // mean visible normal: along · normal + towards · toEye, as in seenNormal()
};

inline SeenNormals seenNormals(float nv, float agreement) {
    SeenNormals seen;
    seen.spread = normalSpread(agreement);
    seen.shown = meanCosine(agreement * nv, nv, seen.spread);
    const float min = std::max(seen.shown, 1e-3f);
    const float turn = (1 - agreement) / min;
    const float bound = 1.23f * turn / ((1 + agreement) * min) * std::max(1 - nv * nv, 0.0f);
    seen.towards = turn / std::sqrt(1 + bound);
    seen.along = agreement - seen.towards * nv;
    return seen;
}

// Returns 2·(n·l)·V, where V is the shadowing-masking term, like unmasked() in shading.glsl. `nl` and `nv` are the
// cosines between normal and light and between normal and eye.
inline float unmasked(float nl, float nv, float width2) {
    if (nl <= 0 || nv <= 0) return 0;
    const float masking =
        nl * std::sqrt(nv * nv * (1 - width2) + width2) + nv * std::sqrt(nl * nl * (1 - width2) + width2);
    return nl / std::max(masking, 1e-4f);
}

// Terms of specular reflection at a point that are independent of the light.
struct Gloss {
    float nv = 0;
    float width2 = 0, alpha2 = 0;
    float share = 0;  // weight of the specular lobe due to the normals' spread (Beckmann); the rest is GGX
    float shown = 0;  // mean cosine of the angle between the visible normals and the eye direction

    Gloss(const SurfacePoint& point, const SeenNormals& seen, const glm::vec3& toEye)
        : nv(glm::dot(point.normal, toEye)), shown(seen.shown) {
        const float width = point.roughness * point.roughness;
        const float spread = 2 * (1 - point.agreement) / point.agreement;
        width2 = width * width;
        alpha2 = std::clamp(width2 + spread, 1e-6f, 1.0f);
        share = std::min(spread * (1 - width) / alpha2, 1.0f);
    }

    // Returns the specular reflection of a light source, divided by the reflectance. `cosine` is the cosine of the
    // angle of incidence.
    [[nodiscard]] float reflected(const DistantLight& light, float cosine) const {
        const float cosines = std::max(cosine + nv, 0.0f);
        const float cosines2 = cosines * cosines;
        const float sum2 = light.sum2;
        const float base = std::max(cosines2 * (alpha2 - 1) + sum2, alpha2 * sum2);
        float result = alpha2 / (base * base) * unmasked(cosine, nv, width2);  // GGX distribution and masking
        if (share > 0) {
            const float away = std::max(cosines2, 1e-4f * sum2);
            const float beckmann = std::exp(-std::max(sum2 - away, 0.0f) / (away * alpha2)) / (alpha2 * away * away);
            result = glm::mix(result, beckmann * unmasked(light.vh, shown, width2), share);
        }
        return 0.5f * sum2 * sum2 * result;
    }
};

inline glm::vec3 lightFrom(const DistantLight& light, const SurfacePoint& point, const SeenNormals& seen,
                           const Gloss& gloss) {
    const float cosine = glm::dot(point.normal, light.toLight);
    const float matt = meanCosine(seen.along * cosine + seen.towards * light.lv, cosine, seen.spread);
    const glm::vec3 reflectance = point.specular * (1 - light.grazing) + light.grazing;
    return light.illuminance * (point.diffuse * (1.0f - point.specular) * (matt * (1 - light.grazing)) +
                                reflectance * gloss.reflected(light, cosine));
}

// Returns the fraction of the radiance of a uniform sky that the specular lobe reflects.
inline glm::vec3 specularAlbedo(const SurfacePoint& point, float nv) {
    const glm::vec2 albedo = specularAlbedo(nv, point.roughness);
    return point.specular * albedo.x + albedo.y;
}

inline glm::vec3 skyLight(const SurfacePoint& point, const glm::vec3& toEye) {
    const glm::vec3 specular = specularAlbedo(point, std::max(glm::dot(point.normal, toEye), 0.0f));
    return skyRadiance * (point.diffuse * (1.0f - specular) + specular);
}

inline glm::vec3 mapped(const FinishMap& map, const glm::vec2& uv0, const glm::vec2& uv1) {
    return map.image ? map.at(uv0, uv1) : glm::vec3(1);
}

// A triangle that is visible in at least one pixel.
struct SeenTriangle {
    const std::uint32_t* corners = nullptr;
    const Finish* finish = nullptr;
    Weights weights;
    // Lengths of the corners' normals, < 1 if they represent diverging normals. 0 at level 0.
    std::array<float, 3> lengths{};
};

// Collects the pixels of a row that show a matt surface, and shades them together.
class MattCells {
public:
    MattCells(std::vector<DistantLight> lights, const glm::vec3& toEye, int max)
        : lights_(std::move(lights)), toEye_(toEye), cells_(static_cast<std::size_t>(max)), agreement_(cells_.size()) {
        for (std::vector<float>& values : normal_) values.resize(cells_.size());
        for (std::vector<float>* values : {&spread_, &along_, &towards_}) values->resize(cells_.size());
        shares_.assign(lights_.size(), agreement_);
    }

    // Adds a pixel to be shaded; `number` is its index in the image. The normal may have any length.
    void add(std::size_t number, const glm::vec3& diffuse, const glm::vec3& emission, const glm::vec3& normal,
             float agreement) {
        // Assign each value separately: copying a complete Cell would stall until all its values are available.
        Cell& cell = cells_[count_];
        cell.number = number;
        for (glm::length_t c = 0; c < 3; ++c) {
            cell.diffuse[c] = diffuse[c];
            cell.emission[c] = emission[c];
            normal_[static_cast<std::size_t>(c)][count_] = normal[c];
        }
        agreement_[count_] = agreement;
        ++count_;
    }

    // Calls put(number, radiance) with the index and the radiance of each collected pixel, and then removes all pixels.
    template <typename Put>
    void shade(const Put& put) {
        normalise();
        look();
        for (std::size_t l = 0; l < lights_.size(); ++l) shadeBy(lights_[l], shares_[l].data());
        for (std::size_t i = 0; i < count_; ++i) {
            glm::vec3 light(skyRadiance);
            for (std::size_t l = 0; l < lights_.size(); ++l) light += shares_[l][i] * lights_[l].illuminance;
            put(cells_[i].number, cells_[i].emission + cells_[i].diffuse * light);
        }
        count_ = 0;
    }

private:
    // The loops of normalise(), look() and shadeBy() are kept simple, so that compilers vectorise them.
    void normalise() {
        float* const x = normal_[0].data();
        float* const y = normal_[1].data();
        float* const z = normal_[2].data();
        for (std::size_t i = 0; i < count_; ++i) {
            const float length = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
            const float inverse = length > 0 ? 1 / length : 0;
            x[i] *= inverse;
            y[i] *= inverse;
            z[i] *= inverse;
        }
    }
    void look() {
        const float* const x = normal_[0].data();
        const float* const y = normal_[1].data();
        const float* const z = normal_[2].data();
        for (std::size_t i = 0; i < count_; ++i) {
            const SeenNormals seen = seenNormals(x[i] * toEye_.x + y[i] * toEye_.y + z[i] * toEye_.z, agreement_[i]);
            spread_[i] = seen.spread;
            along_[i] = seen.along;
            towards_[i] = seen.towards;
        }
    }
    void shadeBy(const DistantLight& light, float* const shares) const {
        const glm::vec3 toLight = light.toLight;
        const float* const x = normal_[0].data();
        const float* const y = normal_[1].data();
        const float* const z = normal_[2].data();
        const float* const spread = spread_.data();
        const float* const along = along_.data();
        const float* const towards = towards_.data();
        const float lv = light.lv;
        for (std::size_t i = 0; i < count_; ++i) {
            const float cosine = x[i] * toLight.x + y[i] * toLight.y + z[i] * toLight.z;
            shares[i] = meanCosine(along[i] * cosine + towards[i] * lv, cosine, spread[i]);
        }
    }

    struct Cell {
        std::size_t number = 0;
        glm::vec3 diffuse{0}, emission{0};
    };
    std::vector<DistantLight> lights_;
    glm::vec3 toEye_;
    std::size_t count_ = 0;
    std::vector<Cell> cells_;
    std::array<std::vector<float>, 3> normal_;  // normals of the collected pixels, one array per coordinate
    std::vector<float> agreement_;
    std::vector<float> spread_, along_, towards_;  // members of SeenNormals as arrays, one entry per pixel
    std::vector<std::vector<float>> shares_;       // per light, mean cosine of the angle of incidence at each pixel
};

// Computes the radiance of surface points towards the eye, with the finish (simplified material) of each triangle.
// Points without specular reflection are collected and shaded row by row.
class Shading {
public:
    // Prepares the shading of a level's image. shade() and endRow() write the radiance to the pixels `cells`.
    Shading(const PyramidLevel& level, bool coarse, const Eye& eye, std::span<glm::vec3> cells)
        : level_(level),
          coarse_(coarse),
          toEye_(eye.towards),
          lights_(lightsFor(eye)),
          cells_(cells),
          matt_(lights_, toEye_, eye.resolution) {}

    [[nodiscard]] std::array<float, 3> lengths(const std::uint32_t* corners) const {
        std::array<float, 3> result{};
        for (std::size_t k = 0; k < 3 && coarse_; ++k) result[k] = glm::length(level_.normals[corners[k]]);
        return result;
    }

    // Shades the pixel (x, y), whose index is `cell`. Pixels that show a matt surface are shaded later, by endRow().
    void shade(const SeenTriangle& triangle, std::size_t cell, int x, int y) {
        const Finish& finish = *triangle.finish;
        const auto [b, c] = triangle.weights.at(static_cast<float>(x), static_cast<float>(y));
        const std::array<float, 3> weights = {1 - b - c, b, c};
        const auto mix = [&](const auto& values) {
            const std::uint32_t* const corners = triangle.corners;
            return weights[0] * values[corners[0]] + weights[1] * values[corners[1]] + weights[2] * values[corners[2]];
        };
        const bool isMapped =
            finish.baseColorMap.image || finish.metallicRoughnessMap.image || finish.emissionMap.image;
        const glm::vec2 uv0 = isMapped && !level_.uv0.empty() ? mix(level_.uv0) : glm::vec2(0);
        const glm::vec2 uv1 = isMapped && !level_.uv1.empty() ? mix(level_.uv1) : glm::vec2(0);
        glm::vec3 color = finish.baseColor * mapped(finish.baseColorMap, uv0, uv1);
        if (!level_.colors.empty()) color *= glm::vec3(mix(level_.colors));
        if (finish.unlit) return put(cell, color);

        const glm::vec3 surface = mapped(finish.metallicRoughnessMap, uv0, uv1);
        const float metallic = finish.metallic * surface.z;
        const glm::vec3 normal = (triangle.weights.back ? -1.0f : 1.0f) * mix(level_.normals);
        const float agreement = coarse_
                                    ? std::clamp(weights[0] * triangle.lengths[0] + weights[1] * triangle.lengths[1] +
                                                     weights[2] * triangle.lengths[2],
                                                 minShownAgreement, 1.0f)
                                    : 1;
        const glm::vec3 diffuse = color * (1 - metallic);
        const glm::vec3 emission = finish.emission * mapped(finish.emissionMap, uv0, uv1);
        if (!(finish.reflectance > 0 || metallic > 0)) return matt_.add(cell, diffuse, emission, normal, agreement);

        const float length = glm::length(normal);
        const SurfacePoint point = {diffuse, glm::mix(glm::vec3(finish.reflectance), color, metallic),
                                    finish.roughness * surface.y, length > 0 ? normal / length : glm::vec3(0),
                                    agreement};
        const SeenNormals seen = seenNormals(glm::dot(point.normal, toEye_), agreement);
        glm::vec3 light = emission + skyLight(point, toEye_);
        const Gloss gloss(point, seen, toEye_);
        for (const DistantLight& each : lights_) light += lightFrom(each, point, seen, gloss);
        put(cell, light);
    }

    void endRow() {
        matt_.shade([&](std::size_t cell, const glm::vec3& light) { put(cell, light); });
    }

    double sum = 0;           // sum over all pixels of the radiance's mean over the three colour channels
    std::size_t covered = 0;  // number of shaded pixels

private:
    void put(std::size_t cell, const glm::vec3& light) {
        if (!std::isfinite(light.x + light.y + light.z)) return;
        cells_[cell] = light == glm::vec3(0) ? glm::vec3(std::numeric_limits<float>::min()) : light;
        sum += (double{light.x} + double{light.y} + double{light.z}) / 3;
        ++covered;
    }

    const PyramidLevel& level_;
    bool coarse_;
    glm::vec3 toEye_;
    std::vector<DistantLight> lights_;
    std::span<glm::vec3> cells_;
    MattCells matt_;
};

}  // namespace defocus::engine
