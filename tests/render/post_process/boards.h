#pragma once
// Helpers that make scenes of flat boards and render them with post-process methods.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

inline RenderSettings settingsWithTheLens() {
    // with keepAll, the frame is planned with a lens even if nothing is blurred
    return {.lod = LodMode::off, .keepAll = true};
}

inline Image postProcessed(const SmallWorld& small, std::string_view method) {
    const MethodUse use = parseMethodUse(method);
    const RendererOptions options{.settings = use.settings};
    const auto renderer = use.method->make(small.world, options);
    return imageOf(*renderer, planFrame(small.world, small.view, settingsWithTheLens()));
}

inline double largestDifferenceInColumns(const Image& a, const Image& b, int left = 0,
                                         int right = std::numeric_limits<int>::max()) {
    double largest = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = left; x < std::min(right, a.width); ++x)
            for (int c = 0; c < 4; ++c) {
                const double difference = std::abs(double(a.at(x, y)[c]) - double(b.at(x, y)[c]));
                largest =
                    std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(largest, difference);
            }
    return largest;
}

// An unlit board that faces the camera at a depth in m, in front of a uniform sky.
struct Board {
    double depth = 2;
    glm::dvec2 centre{0};    // m
    glm::dvec2 halfSize{1};  // m
    glm::vec4 color{1};
};

inline std::unique_ptr<SmallWorld> boards(const std::vector<Board>& list, const glm::vec3& sky) {
    auto small = std::make_unique<SmallWorld>();
    for (const Board& board : list) {
        const int index = static_cast<int>(small->scene.materials.size());
        small->scene.materials.push_back(unlitMaterial(board.color));
        if (board.color.a < 1) small->scene.materials.back().alphaMode = AlphaMode::blend;
        small->scene.meshes.push_back(quad(index));
        place(*small, index,
              glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(board.centre, -board.depth)),
                         glm::dvec3(board.halfSize, 1)));
    }
    small->world.environment = {EnvironmentType::uniform, sky, {}, {}, nullptr, 1};
    small->view.width = 96;
    small->view.height = 64;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    finish(*small);
    return small;
}

}  // namespace defocus::engine
