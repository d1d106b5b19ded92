#pragma once
// Builds small scenes for tests of plans and renderers: bumpy spheres and quads with pyramids of levels of detail.

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "lod/pyramid/build_all.h"
#include "lod/pyramid/pyramid.h"
#include "plan/view.h"

namespace defocus::engine {

struct SmallWorld {
    SmallWorld() : SmallWorld(std::make_shared<Scene>()) {}
    SmallWorld(const SmallWorld&) = delete;
    SmallWorld& operator=(const SmallWorld&) = delete;

    Scene& scene;  // the scene that `world` refers to, filled by the test
    World world;
    View view;

private:
    explicit SmallWorld(const std::shared_ptr<Scene>& owned) : scene(*owned) { world.scene = owned; }
};

// Returns a rippled sphere of radius 1 with about 2 · slices · stacks triangles.
inline Mesh bumpySphere(int slices, int stacks, int material) {
    Mesh mesh;
    mesh.name = "sphere";
    const auto point = [](double polar, double azimuth) {
        const double radius = 1 + 0.03 * std::sin(14 * azimuth) * std::sin(11 * polar) * std::sin(polar);
        return glm::vec3(radius * std::sin(polar) * std::cos(azimuth), radius * std::cos(polar),
                         radius * std::sin(polar) * std::sin(azimuth));
    };
    for (int y = 0; y <= stacks; ++y)
        for (int x = 0; x < slices; ++x) {
            mesh.vertices.positions.push_back(point(std::numbers::pi * y / stacks, 2 * std::numbers::pi * x / slices));
            mesh.vertices.colors.emplace_back(
                glm::floor(255.0f * glm::vec3(x, y, 0) / glm::vec3(slices, stacks, 1)) / 255.0f, 1);
            mesh.vertices.colors.back().b = (x / 4 + y / 4) % 2 == 0 ? 0.0f : 1.0f;
        }
    Primitive primitive{material, {}};
    const auto index = [&](int x, int y) { return static_cast<std::uint32_t>(y * slices + x % slices); };
    for (int y = 0; y < stacks; ++y)
        for (int x = 0; x < slices; ++x) {
            if (y > 0)
                primitive.indices.insert(primitive.indices.end(), {index(x, y), index(x + 1, y), index(x, y + 1)});
            if (y < stacks - 1)
                primitive.indices.insert(primitive.indices.end(),
                                         {index(x + 1, y), index(x + 1, y + 1), index(x, y + 1)});
        }
    mesh.vertices.normals = smoothNormals(mesh.vertices.positions, primitive.indices);
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

// Returns the square [−1, 1]² in the plane z = 0, facing +z.
inline Mesh quad(int material) {
    Mesh mesh;
    mesh.name = "quad";
    mesh.vertices.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.vertices.normals.assign(4, {0, 0, 1});
    mesh.primitives.push_back({material, {0, 1, 2, 0, 2, 3}});
    return mesh;
}

// Returns the triangles of a grid of `cells` × `cells` squares; its vertices are ordered by row, then by column.
inline std::vector<std::uint32_t> gridIndices(std::uint32_t cells) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t first = y * (cells + 1) + x;
            const std::uint32_t next = first + cells + 1;
            indices.insert(indices.end(), {first, first + 1, next, first + 1, next + 1, next});
        }
    return indices;
}

inline Material unlitMaterial(const glm::vec4& color) {
    return {.baseColorFactor = color, .unlit = true};
}

inline void place(SmallWorld& small, int mesh, const glm::dmat4& worldFromObject) {
    Object object;
    object.mesh = mesh;
    object.name = "Object " + std::to_string(small.world.pose.objects.size());
    object.worldFromObject = worldFromObject;
    small.world.pose.objects.push_back(object);
}

inline void finish(SmallWorld& small) {
    small.world.pyramids = buildPyramids(small.scene.meshes);
}

// Calls `change` with each pyramid of the world.
inline void changePyramids(World& world, const std::function<void(Pyramid&)>& change) {
    for (std::size_t i = 0; i < world.pyramids.size(); ++i) {
        Pyramid pyramid = world.pyramids[i];
        change(pyramid);
        world.pyramids.replace(i, std::move(pyramid));
    }
}

inline PlacedLight sunFrom(const glm::dvec3& direction, float intensity) {
    PlacedLight sun;
    sun.light.intensity = intensity;
    sun.direction = glm::normalize(direction);
    return sun;
}

// Adds a sun that shines from above, from the right and from behind the camera.
inline void addSun(SmallWorld& small) {
    small.world.lights.push_back(sunFrom({-0.3, -1, -0.6}, 2));
}

inline Environment gradientSky() {
    return {EnvironmentType::gradient, {0.6f, 0.8f, 1.0f}, {0.4f, 0.5f, 0.6f}, {0.1f, 0.1f, 0.2f}, nullptr, 1};
}

// Returns an environment map of 16 × 8 px whose values lie between 0 and 2 and differ from pixel to pixel.
inline Environment speckledMap() {
    auto map = std::make_shared<Image>(16, 8, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = static_cast<float>(i * 37 % 101) / 50;
    return {EnvironmentType::map, {}, {}, {}, map, 1};
}

// Returns five rippled spheres at depths from 1.2 to 9 m, lit by a sun and a gradient sky. One has a mirrored transform
// and one is far outside the frame. Each has about 2 · slices · stacks triangles. The lens is f/1, focused at 3 m, and
// the image has 160 × 120 px.
inline std::unique_ptr<SmallWorld> fiveSpheres(int slices = 80, int stacks = 60) {
    auto small = std::make_unique<SmallWorld>();
    const Material glossy{.metallicFactor = 0, .roughnessFactor = 0.4f};
    small->scene.materials.push_back(glossy);
    small->scene.meshes.push_back(bumpySphere(slices, stacks, 0));
    const auto at = [](double x, double y, double z, double s) {
        return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, y, z)), glm::dvec3(s));
    };
    place(*small, 0, at(-0.25, -0.1, -1.2, 0.15));
    place(*small, 0, at(0.3, 0.2, -3, 0.5));
    place(*small, 0, glm::scale(at(-0.6, 0.5, -5, 0.8), glm::dvec3(-1, 1, 1)));
    place(*small, 0, at(1.2, -1, -9, 1));
    place(*small, 0, at(40, 0, -5, 0.5));
    addSun(*small);
    small->world.environment = gradientSky();
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 3;
    small->view.width = 160;
    small->view.height = 120;
    // Pyramids are built once for all tests of a process, since this takes longer than most tests.
    static std::map<std::pair<int, int>, SharedPyramids> built;
    SharedPyramids& pyramids = built[{slices, stacks}];
    if (pyramids.empty()) pyramids = buildPyramids(small->scene.meshes);
    small->world.pyramids = pyramids;
    return small;
}

// Returns the spheres of fiveSpheres() with a quarter of the triangles, in an image of 80 × 60 px. The aperture has
// twice the diameter, so the blur in pixels is the same.
inline std::unique_ptr<SmallWorld> fiveCoarseSpheres() {
    auto small = fiveSpheres(40, 30);
    small->view.lens.fStop = 0.5;
    small->view.width = 80;
    small->view.height = 60;
    return small;
}

}  // namespace defocus::engine
