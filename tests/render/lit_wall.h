#pragma once
// Makes a wall that fills the frame of a pinhole camera with one sample per pixel, and computes each pixel's expected
// radiance. The equations of glTF 2.0 are evaluated in double precision, with half vectors and angles as specified.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "gl_context_test.h"
#include "plan/frame_plan.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

inline constexpr double wallDepth = 2;  // distance in m in front of the camera

// Returns the wall and its camera. The camera is not at the origin and looks along no world axis, so that a test fails
// if world and camera coordinates are confused.
inline std::unique_ptr<SmallWorld> litWall(const Material& material) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(material);
    Mesh mesh = quad(0);
    mesh.vertices.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};  // texture coordinates; v grows downwards
    mesh.vertices.tangents.assign(4, {1, 0, 0, 1});
    small->scene.meshes.push_back(std::move(mesh));
    small->view.worldFromCamera =
        glm::rotate(glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(3, -1, 2)), 0.7, glm::dvec3(0, 1, 0)), 0.4,
                    glm::dvec3(1, 0, 0));
    place(*small, 0,
          // The wall spans [−1, 1]² m; the frame shows x from −0.72 to 0.72 m.
          glm::translate(small->view.worldFromCamera, glm::dvec3(0, 0, -wallDepth)));
    small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    small->view.width = 32;
    small->view.height = 24;
    small->view.lens.dofEnabled = false;
    finish(*small);
    return small;
}

inline FramePlan wallPlan(const SmallWorld& small, bool multipleScattering = false) {
    const RenderSettings settings{.sampleCount = 1, .lod = LodMode::off, .multipleScattering = multipleScattering};
    return planFrame(small.world, small.view, settings);
}

inline Image wallImage(const SmallWorld& small) {
    return imageInFloats(small.world, wallPlan(small));
}

// Returns the image of a wall in a white furnace, an environment of radiance 1. The wall fills the frame. The angle
// between its normal and the view axis has approximately the given cosine.
inline Image furnaceImage(const Material& material, double cosine, bool multipleScattering = false) {
    const auto small = litWall(material);
    glm::dmat4& placed = small->world.pose.objects[0].worldFromObject;
    placed = glm::scale(glm::rotate(placed, std::acos(cosine), {0, 1, 0}), glm::dvec3(1000));
    small->world.environment.zenith = glm::vec3(1);
    return imageInFloats(small->world, wallPlan(*small, multipleScattering));
}

// Returns the largest difference of an image's colour channels from `expected`.
inline double farthestFrom(const Image& image, const glm::dvec3& expected) {
    double max = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) max = std::max(max, std::abs(image.at(x, y)[c] - expected[c]));
    return max;
}

// The point of the wall that the single sample of pixel (x, y) sees, in world coordinates.
struct WallPoint {
    int x = 0, y = 0;
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};  // unit normal, towards the camera
    glm::dvec3 toEye{0.0};
    glm::dvec2 uv{0.0};  // first set of texture coordinates
};

inline std::vector<WallPoint> wallPoints(const SmallWorld& small) {
    const View& view = small.view;
    const FramePlan plan = wallPlan(small);
    const glm::dvec2 offset(plan.samples[0].pixel);
    const double tanX = 36.0 / (2 * 50);  // tan(θx/2) of the default lens
    std::vector<WallPoint> points;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double right = (2 * (x + 0.5 + offset.x) / view.width - 1) * tanX * wallDepth;
            const double up =
                (1 - 2 * (y + 0.5 - offset.y) / view.height) * tanX * view.height / view.width * wallDepth;
            WallPoint point{.x = x, .y = y};
            point.position = glm::dvec3(view.worldFromCamera * glm::dvec4(right, up, -wallDepth, 1));
            point.normal = glm::dvec3(view.worldFromCamera[2]);
            point.toEye = glm::normalize(glm::dvec3(view.worldFromCamera[3]) - point.position);
            point.uv = {(right + 1) / 2, (1 - up) / 2};
            points.push_back(point);
        }
    return points;
}

// Parameters of a surface in the equations of glTF 2.0, appendix B.
struct GltfSurface {
    glm::dvec3 baseColor{1.0};
    double metallic = 0;
    double roughness = 1;
    glm::dvec3 dielectric{0.04};  // reflectance of the dielectric part at normal incidence
    double grazing = 1;           // reflectance of the dielectric part at grazing incidence
};

// Returns the BRDF times the clamped cosine, f(l, v)·(n·l)₊, by the equations of glTF 2.0, appendix B: Lambert,
// Schlick's Fresnel, GGX and height-correlated Smith masking.
inline glm::dvec3 reflectedShare(const GltfSurface& surface, const glm::dvec3& n, const glm::dvec3& v,
                                 const glm::dvec3& l) {
    const double nl = glm::dot(n, l), nv = glm::dot(n, v);
    if (nl <= 0) return glm::dvec3(0);
    const glm::dvec3 h = glm::normalize(l + v);
    const double nh = glm::dot(n, h), vh = glm::dot(v, h);
    const double alpha = surface.roughness * surface.roughness;
    const glm::dvec3 f0 = glm::mix(surface.dielectric, surface.baseColor, surface.metallic);
    const double f90 = glm::mix(surface.grazing, 1.0, surface.metallic);
    const glm::dvec3 fresnel = f0 + (f90 - f0) * std::pow(1 - vh, 5);
    const double spread = nh * nh * (alpha * alpha - 1) + 1;
    const double distribution = alpha * alpha / (std::numbers::pi * spread * spread);
    const auto correlated = [&](double x, double y) {
        return x * std::sqrt(alpha * alpha + (1 - alpha * alpha) * y * y);
    };
    const double visibility = 0.5 / (correlated(nl, nv) + correlated(nv, nl));
    const glm::dvec3 diffuse = surface.baseColor * (1 - surface.metallic) / std::numbers::pi;
    // KHR_materials_specular: the strongest channel of a coloured reflection reduces the diffuse part.
    const bool colored = surface.dielectric != glm::dvec3(surface.dielectric.r);
    const glm::dvec3 reflected = colored ? glm::dvec3(std::max({fresnel.r, fresnel.g, fresnel.b})) : fresnel;
    return nl * ((1.0 - reflected) * diffuse + fresnel * (distribution * visibility));
}

// Light that reaches a point, by KHR_lights_punctual: the illuminance of a surface that faces the light, and the unit
// direction towards the light.
struct Illumination {
    glm::dvec3 illuminance{0.0};
    glm::dvec3 toLight{0.0};
};

inline Illumination illuminationAt(const PlacedLight& placed, const glm::dvec3& position) {
    const Light& light = placed.light;
    const glm::dvec3 power = glm::dvec3(light.color) * double(light.intensity);
    if (light.type == LightType::directional) return {power, -glm::normalize(placed.direction)};
    const double distance = glm::distance(placed.position, position);
    Illumination result{power / (distance * distance), (placed.position - position) / distance};
    if (light.range > 0) result.illuminance *= std::clamp(1 - std::pow(distance / double(light.range), 4), 0.0, 1.0);
    if (light.type == LightType::spot) {
        const double inner = std::cos(double(light.innerConeAngle)), outer = std::cos(double(light.outerConeAngle));
        const double cosine = glm::dot(glm::normalize(placed.direction), -result.toLight);
        const double share = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
        result.illuminance *= share * share;
    }
    return result;
}

inline glm::dvec3 litRadiance(const GltfSurface& surface, const WallPoint& point, const glm::dvec3& normal,
                              const std::vector<PlacedLight>& lights) {
    glm::dvec3 sum(0);
    for (const PlacedLight& light : lights) {
        const Illumination at = illuminationAt(light, point.position);
        sum += at.illuminance * reflectedShare(surface, normal, point.toEye, at.toLight);
    }
    return sum;
}

// Converts a direction from the wall's coordinates (right, up, towards the camera) to world coordinates.
inline glm::dvec3 fromWall(const SmallWorld& small, const glm::dvec3& direction) {
    return glm::dmat3(small.view.worldFromCamera) * direction;
}

inline void expectRadiance(const Image& image, const WallPoint& point, const glm::dvec3& expected,
                           const glm::dvec3& tolerance) {
    for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(image.at(point.x, point.y)[c], expected[c], tolerance[c])
            << "at " << point.x << ", " << point.y << ", channel " << c;
}

// Expects a pixel to have the radiance `expected`, within rounding errors. Single precision over some dozens of
// operations errs by 2e-5. The GGX distribution magnifies rounding of the half vector's cosine in proportion to 1/α².
// `slope` is the amount by which the radiance changes within the uncertainty of the position.
inline void expectLitRadiance(const Image& image, const WallPoint& point, const glm::dvec3& expected, double roughness,
                              const glm::dvec3& slope = glm::dvec3(0)) {
    const double relative = 2e-5 + 1e-6 / std::pow(roughness, 4);
    expectRadiance(image, point, expected, relative * glm::max(expected, glm::dvec3(0.05)) + slope);
}

using LitWall = GlContextTest;

}  // namespace defocus::engine
