#include "stability/board_scene.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "image/moments.h"
#include "lod/pyramid/build_all.h"

namespace defocus::engine {

namespace {

Mesh boardMesh(int material) {
    Mesh mesh;
    mesh.name = "board";
    mesh.vertices.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.vertices.normals.assign(4, {0, 0, 1});
    mesh.primitives.push_back({material, {0, 1, 2, 0, 2, 3}});
    return mesh;
}

Material boardMaterial(const glm::vec3& radiance) {
    Material material;
    material.baseColorFactor = glm::vec4(radiance, 1);
    material.unlit = true;
    return material;
}

}  // namespace

View boardView(int width, int height) {
    View view;
    view.lens.fStop = 1;
    view.lens.focusDistance = 2;
    view.width = width;
    view.height = height;
    return view;
}

BoardScene::BoardScene(const View& boardsView, const std::vector<Board>& boards, const glm::vec3& background)
    : view(boardsView) {
    for (const Board& board : boards) {
        const int index = static_cast<int>(scene->meshes.size());
        scene->materials.push_back(boardMaterial(board.radiance));
        scene->meshes.push_back(boardMesh(index));
        Object object;
        object.mesh = index;
        object.name = "board";
        object.worldFromObject = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(board.centre, -board.depth)),
                                            glm::dvec3(board.halfSize, 1));
        world.pose.objects.push_back(object);
    }
    world.scene = scene;
    world.pyramids = buildPyramids(scene->meshes);
    world.environment = {EnvironmentType::uniform, background, background, background, nullptr, 1};
    settings.lod = LodMode::off;
    settings.keepAll = true;
}

Image rendered(const BoardScene& boards, const std::string& method, const RendererOptions& options) {
    const MethodUse use = parseMethodUse(method);
    RendererOptions complete = options;
    complete.settings = use.settings;
    const auto renderer = use.method->make(boards.world, complete);
    return imageOf(*renderer, planFrame(boards.world, boards.view, boards.settings));
}

Board squareAt(const View& view, double depth, double pixels, const glm::vec3& radiance, const glm::dvec2& offset) {
    const double pixel = view.lens.horizontalAperture / view.lens.focalLength * depth / view.width;  // m/px
    return {depth, pixel * offset, glm::dvec2(0.5 * pixels * pixel), radiance};
}

std::vector<Board> threeBoards(const View& view, double nearest, double farthest) {
    return {squareAt(view, nearest, 20, {0.9f, 0.3f, 0.1f}, {-20, 5}), squareAt(view, 2, 30, {0.2f, 0.8f, 0.3f}),
            squareAt(view, farthest, 40, {0.1f, 0.3f, 0.9f}, {15, -10})};
}

double largestError(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double difference = std::abs(static_cast<double>(a.pixels[i]) - b.pixels[i]);
        if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, difference);
    }
    return largest;
}

double blurDiameter(const View& view, double depth) {
    const double aperture = view.lens.blurScale * view.lens.focalLength / (1000 * view.lens.fStop);
    return aperture * std::abs(1 / view.lens.focusDistance - 1 / depth) * view.width * view.lens.focalLength /
           view.lens.horizontalAperture;
}

BlurredLight blurredLight(const Image& image, const View& view, const LightPlace& light) {
    const double diameter = blurDiameter(view, light.depth);
    const glm::dvec2 centre(0.5 * view.width + light.offset.x, 0.5 * view.height - light.offset.y);
    const double reach = 0.5 * diameter + light.pixels + 2;
    const glm::ivec2 first(glm::max(glm::floor(centre - reach), glm::dvec2(0)));
    const glm::ivec2 end(glm::min(glm::ceil(centre + reach), glm::dvec2(view.width, view.height)));
    Image around(end.x - first.x, end.y - first.y, 1);
    for (int y = 0; y < around.height; ++y)
        for (int x = 0; x < around.width; ++x) *around.at(x, y) = image.at(first.x + x, first.y + y)[light.channel];
    const Moments moments = momentsOf(around);
    return {std::abs(2 * radiusBySecondMoment(moments, 0, light.pixels) - diameter),
            glm::distance(moments.mean + glm::dvec2(first), centre)};
}

void setBlur(View& view, double depth, double pixels) {
    view.lens.blurScale *= pixels / blurDiameter(view, depth);
}

}  // namespace defocus::engine
