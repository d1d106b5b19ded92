// Tests that edges in focus are as sharp in refocused images as in rendered images. Sharpness is the spatial frequency
// at which the modulation transfer function (MTF) of a slanted edge falls to one half, as in ISO 12233.

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "refocus/lens_images.h"

namespace defocus::engine {
namespace {

constexpr double slant = 7 * std::numbers::pi / 180;  // angle between the edge and the vertical
constexpr int imageSide = 96;
constexpr double away = 3;  // distance from the camera to the square, m

// Returns a white, unlit square whose left edge passes through the image's centre.
defocus::Scene slantedEdge() {
    std::array<std::array<float, 3>, 4> corners{};
    const std::array<std::array<double, 2>, 4> square = {{{0, -9}, {9, -9}, {9, 9}, {0, 9}}};
    for (std::size_t i = 0; i < 4; ++i)
        corners[i] = {static_cast<float>(std::cos(slant) * square[i][0] - std::sin(slant) * square[i][1]),
                      static_cast<float>(std::sin(slant) * square[i][0] + std::cos(slant) * square[i][1]), 0};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    MaterialData white;
    white.unlit = true;
    MeshData mesh;
    mesh.positions = corners;
    mesh.indices = triangles;
    mesh.material = 0;
    const InstanceData instances[] = {{.mesh = 0}};
    const CameraData camera{.transform = lookAt({0, 0, away}, {0, 0, 0})};
    return defocus::Scene::create({.meshes = std::span(&mesh, 1),
                                   .materials = std::span(&white, 1),
                                   .instances = instances,
                                   .cameras = std::span(&camera, 1)});
}

// Returns the frequency in cycles per pixel at which the edge's MTF falls to one half.
double mtf50(const Image& image) {
    constexpr int binsPerPixel = 4;
    constexpr int reach = 12;  // number of measured pixels on each side of the edge
    std::vector<double> sums(2 * reach * binsPerPixel);
    std::vector<int> counts(sums.size());
    for (int y = 16; y < image.height - 16; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double right = x + 0.5 - image.width / 2.0;
            const double up = image.height / 2.0 - y - 0.5;
            const double distance = right * std::cos(slant) + up * std::sin(slant);
            const auto bin = static_cast<int>(std::floor((distance + reach) * binsPerPixel));
            if (bin < 0 || bin >= static_cast<int>(sums.size())) continue;
            sums[static_cast<std::size_t>(bin)] += static_cast<double>(image.at(x, y)[0]);
            ++counts[static_cast<std::size_t>(bin)];
        }
    std::vector<double> line;  // line spread function: the derivative of the edge's profile
    for (std::size_t i = 1; i < sums.size(); ++i) line.push_back(sums[i] / counts[i] - sums[i - 1] / counts[i - 1]);
    for (double frequency = 0; frequency < 2; frequency += 0.001) {
        double cosine = 0;
        double sine = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const double angle = 2 * std::numbers::pi * frequency * static_cast<double>(i) / binsPerPixel;
            cosine += line[i] * std::cos(angle);
            sine += line[i] * std::sin(angle);
        }
        if (std::hypot(cosine, sine) < 0.5) return frequency;
    }
    return 2;
}

TEST_F(LightFieldTest, edgesInFocusAreAsSharpAsRenderedOnes) {
    Request request;
    request.size = {imageSide, imageSide};
    request.background = Color{0, 0, 0};
    request.lens.fStop = 0.25;
    request.lens.focalLength = 50;
    request.samples = 64;
    request.method = "accumulation";
    request.focus = FocusDistance{2};
    const defocus::Scene scene = slantedEdge();
    defocus::LightField field =
        defocus::LightField::render(scene, request, folder_ / "edge.lens.exr", FocusRange{1.5, 4});
    request.focus = FocusDistance{away};
    const double direct = mtf50(SceneRenderer(scene, request).render());
    const double refocused = mtf50(field.refocus({FocusDistance{away}, {}}));
    EXPECT_GT(direct, 0.3);
    EXPECT_GE(refocused, 0.9 * direct);
    EXPECT_LT(mtf50(field.refocus()), 0.5 * direct);  // without refocusing, the edge is out of focus
}

}  // namespace
}  // namespace defocus::engine
