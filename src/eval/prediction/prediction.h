#pragma once
// Tests whether a level is as wrong as its pyramid says (blurred_error.h). The mesh of a scene that has the most
// triangles is drawn alone, level by level, under growing blur, from the directions that the prediction looks from, and
// compared with level 0. What N lens samples miss is not the level's error: each comparison is made with two sets of
// 1,024 samples, and only what both agree on counts.
//
// Held equal between predicted and rendered: mesh, level, lens, the patches of the blur, the default lights. Both
// errors are of linear light up to white, over the three channels and the area that level 0 covers, in units of its
// mean light. The renderer's shading, with normal maps and the default sky, stands against the simpler one of the
// prediction.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"
#include "render/methods.h"

namespace defocus::engine {

struct PredictionOptions {
    std::vector<double> cocs = {1, 4, 16, 64};  // px, at the mesh's centre
    int width = 320;                            // px
    int height = 240;                           // px
    RendererOptions renderer;
};

struct PredictionRow {
    std::string mesh;
    double coc = 0;           // px
    std::uint32_t level = 0;  // 0: not of a level, but of the lens samples at full detail
    std::uint32_t triangles = 0;
    double predicted = 0;
    double rendered = 0;
    // True if the level is drawn at this blur with LodMetric::measured and any number of samples from 16 to 512. If λ
    // lies between two levels, both are drawn.
    bool used = false;

    [[nodiscard]] bool withinTwo() const { return predicted <= 2 * rendered && rendered <= 2 * predicted; }
};

// Calls `visit` for each blur with the error of 64 lens samples at full detail, then with each level's, in their order.
// Needs a current GL context and frame.scene, whose meshes may be animated: each is taken as it is at rest. Throws
// Error for a scene without a mesh that has levels.
void measurePrediction(const PreparedFrame& frame, const PredictionOptions& options,
                       const std::function<void(const PredictionRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
