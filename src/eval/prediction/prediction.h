#pragma once
// Compares the errors that a pyramid predicts for its levels (blurred_error.h) with rendered ones. The scene's mesh
// with the most triangles is drawn alone, level by level, under growing blur, from the prediction's view directions,
// and compared with level 0. Two independent sets of 1,024 lens samples separate the level's error from sampling noise:
// only the error common to both sets counts.
//
// Held equal between predicted and rendered: mesh, level, lens, the patches of the blur, the default lights. Both
// errors are of linear light up to white, over the three channels and the area that level 0 covers, in units of its
// mean light. The renderer's shading has normal maps and the default sky; the prediction's shading is simpler.

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
    std::uint32_t level = 0;  // 0: the row holds the sampling error at full detail
    std::uint32_t triangles = 0;
    double predicted = 0;
    double rendered = 0;
    // True if the level is drawn at this blur with LodMetric::measured and any number of samples from 16 to 512. If λ
    // lies between two levels, both are drawn.
    bool used = false;

    [[nodiscard]] bool withinTwo() const { return predicted <= 2 * rendered && rendered <= 2 * predicted; }
};

// Calls `visit` for each blur with the error of 64 lens samples at full detail, then with each level's error in level
// order. Needs a current GL context and frame.scene; animated meshes are measured at rest. Throws Error for a scene
// without a mesh that has levels.
void measurePrediction(const PreparedFrame& frame, const PredictionOptions& options,
                       const std::function<void(const PredictionRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
