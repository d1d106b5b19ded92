#pragma once
// Compares the errors that a pyramid predicts for its levels (blurred_error.h) with rendered errors. The mesh with the
// most triangles is drawn alone at each level, under increasing blur and from the prediction's view directions, and
// compared with level 0. Two independent sets of 1,024 lens samples separate the level's error from sampling noise:
// only the error common to both sets counts.
//
// Prediction and rendering use the same mesh, level, lens and default lights; the prediction averages errors over
// patches as large as the rendered blur. Both errors are RMS differences of linear radiance, clamped at white, over
// three channels and the area that level 0 covers. They are relative to level 0's mean radiance. The renderer's shading
// includes normal maps and the default sky; the prediction's shading is simpler.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"
#include "render/methods.h"

namespace defocus::engine {

struct PredictionOptions {
    std::vector<double> cocs = {1, 4, 16, 64};  // CoC diameters at the mesh's centre to measure, px
    int width = 320;                            // image width, px
    int height = 240;                           // image height, px
    RendererOptions renderer;
};

struct PredictionRow {
    std::string mesh;
    double coc = 0;           // CoC diameter at the mesh's centre, px
    std::uint32_t level = 0;  // level of detail; 0: the errors are the noise of 64 samples at full detail
    std::uint32_t triangles = 0;
    double predicted = 0;
    double rendered = 0;
    // True if LodMetric::measured selects the level at this blur for at least one number of samples from 16 to 512. If
    // the selected real-valued level lies between two levels, both count as selected.
    bool used = false;

    [[nodiscard]] bool withinTwo() const { return predicted <= 2 * rendered && rendered <= 2 * predicted; }
};

// For each blur in `options.cocs`, calls `visit` with the error of 64 lens samples at full detail, then with the error
// of each level, in order of the level number. Needs a current GL context; `frame.scene` must be set. Animated meshes
// are measured in their rest pose. Throws Error if no mesh of the scene has levels.
void measurePrediction(const PreparedFrame& frame, const PredictionOptions& options,
                       const std::function<void(const PredictionRow&)>& visit, const Progress& progress = {});

}  // namespace defocus::engine
