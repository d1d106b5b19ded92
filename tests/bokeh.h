#pragma once
// Builds scenes with known images, such as a blurred emissive square on black, and measures rendered images.

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "image/moments.h"
#include "plan/frame_plan.h"
#include "render/rendered.h"

namespace defocus::engine {

// Returns a camera at the origin: 50 mm on a 36 mm sensor, focused at 2 m. The aperture is 0.5 m wide, so that small
// images show large blurs. In an image W px wide, the blur diameter at depth z is 0.694·W·|1/2 − 1/z| px, which is
// 0.231·W at 1.2 m and at 6 m.
inline View bokehView(int width, int height) {
    View view;
    view.width = width;
    view.height = height;
    view.nearPlane = 0.01;
    view.lens.focalLength = 50;
    view.lens.horizontalAperture = 36;
    view.lens.fStop = 0.1;
    view.lens.focusDistance = 2;
    return view;
}

inline double tanHalf(const View& view) {
    return view.lens.horizontalAperture / (2 * view.lens.focalLength);
}

// Returns the blur diameter c = A·|1/s − 1/z|·W / (2 tan(θx/2)) in px. A is the aperture diameter, s the focus distance
// and z the depth, all in m; W is the image width in px and θx the horizontal field of view.
inline double blurDiameter(const View& view, double depth) {
    const double aperture = view.lens.blurScale * view.lens.focalLength / (1000 * view.lens.fStop);
    return aperture * std::abs(1 / view.lens.focusDistance - 1 / depth) * view.width / (2 * tanHalf(view));
}

// Returns the camera-space point at `depth` that projects to (column, row) in px from the image's top left corner.
inline glm::dvec3 pointAt(const View& view, double column, double row, double depth) {
    const double pixel = 2 * tanHalf(view) * depth / view.width;  // m
    return {(column - view.width / 2.0) * pixel, (view.height / 2.0 - row) * pixel, -depth};
}

struct Rectangle {  // coordinates in px from the image's top left corner
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
    double depth = 1;  // m
};

// Returns a single-sided rectangle that faces a camera at the origin and covers `area` in its image.
inline Mesh rectangleMesh(const View& view, const Rectangle& area, int material) {
    Mesh mesh;
    for (const glm::dvec2& corner : {glm::dvec2(area.left, area.bottom), glm::dvec2(area.right, area.bottom),
                                     glm::dvec2(area.right, area.top), glm::dvec2(area.left, area.top)}) {
        mesh.vertices.positions.emplace_back(pointAt(view, corner.x, corner.y, area.depth));
        mesh.vertices.normals.emplace_back(0, 0, 1);
    }
    mesh.primitives.push_back({material, {0, 1, 2, 0, 2, 3}});
    return mesh;
}

inline Scene rectangleScene(const View& view, const std::vector<Rectangle>& areas, const glm::vec3& color) {
    Scene scene;
    const Material material{.baseColorFactor = glm::vec4(color, 1), .unlit = true};
    scene.materials.push_back(material);
    for (const Rectangle& area : areas) {
        Node node;
        node.mesh = static_cast<int>(scene.meshes.size());
        scene.roots.push_back(static_cast<int>(scene.nodes.size()));
        scene.nodes.push_back(node);
        scene.meshes.push_back(rectangleMesh(view, area, 0));
    }
    return scene;
}

// Returns the world of a scene whose nodes are all roots without children. The world has no levels of detail.
inline World flatWorld(const Scene& scene, const Environment& environment) {
    World world;
    world.scene = std::make_shared<const Scene>(scene);
    world.environment = environment;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const glm::dmat4 matrix = scene.nodes[i].matrix.value_or(glm::dmat4(1.0));
        world.pose.worldFromNode.push_back(matrix);
        world.pose.objects.push_back({scene.nodes[i].mesh, static_cast<int>(i), "object", matrix, 1, {}, {}});
        world.pose.bounds.extend(
            transformed(scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].bounds(), matrix));
    }
    return world;
}

inline Environment blackBackground() {
    Environment environment;
    environment.type = EnvironmentType::uniform;
    return environment;
}

// Returns the expected image of a centred square of `square` px at a depth behind the focus plane. It is the
// convolution of `light`, the light density as a function of the lens position, with the square and the pixels. The sum
// of all pixel values is `energy`.
template <typename Light>
Image expectedBokeh(const View& view, double depth, double square, double energy, const Light& light) {
    constexpr int size = 400;  // number of grid points across the lens, along each axis
    const double radius = blurDiameter(view, depth) / 2;
    Image image(view.width, view.height, 1);
    double all = 0;
    for (int v = 0; v < size; ++v)
        for (int u = 0; u < size; ++u) {
            const glm::dvec2 lens(2 * (u + 0.5) / size - 1, 2 * (v + 0.5) / size - 1);
            const double value = light(lens);
            if (!(value > 0)) continue;
            all += value;
            const double left = view.width / 2.0 + radius * lens.x - square / 2;
            const double top = view.height / 2.0 - radius * lens.y - square / 2;
            const auto covered = [square](int pixel, double from) {
                return std::max(0.0, std::min(pixel + 1.0, from + square) - std::max<double>(pixel, from));
            };
            for (int y = std::max(0, static_cast<int>(top)); y < std::min<double>(view.height, top + square); ++y)
                for (int x = std::max(0, static_cast<int>(left)); x < std::min<double>(view.width, left + square); ++x)
                    *image.at(x, y) += static_cast<float>(value * covered(x, left) * covered(y, top));
        }
    for (float& pixel : image.pixels) pixel *= static_cast<float>(energy / (all * square * square));
    return image;
}

// Returns the fraction of b's radiance, summed over pixels, that must move between blocks of 2 × 2 px to give `a`. Only
// the first channel counts.
inline double misplacedLight(const Image& a, const Image& b) {
    double sum = 0;
    double all = 0;
    for (int y = 0; y + 1 < a.height; y += 2)
        for (int x = 0; x + 1 < a.width; x += 2) {
            double difference = 0;
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                difference += static_cast<double>(*a.at(x + dx, y + dy)) - static_cast<double>(*b.at(x + dx, y + dy));
                all += static_cast<double>(*b.at(x + dx, y + dy));
            }
            sum += std::abs(difference) / 2;
        }
    return sum / all;
}

}  // namespace defocus::engine
