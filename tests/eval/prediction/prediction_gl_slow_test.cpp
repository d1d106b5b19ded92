// Compares the errors that level-of-detail pyramids predict for their levels with the errors of rendered images.

#include <gtest/gtest.h>

#include <cmath>

#include "eval/prediction/prediction.h"
#include "eval/prediction/text.h"
#include "gl/context.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// Returns the predicted and the rendered errors of the levels of a ball with bumps and stripes. The ball is made of
// plaster (diffuse), because the error model of pyramids covers all properties of this material.
std::vector<PredictionRow> rowsOfABall() {
    Mesh mesh = sphere(64, 32, 0.03);
    for (const glm::vec3& p : mesh.vertices.positions)
        mesh.vertices.colors.emplace_back(0.5f + 0.4f * std::sin(12 * p.y), 0.5f, 0.4f + 0.3f * p.x, 1.0f);
    mesh.primitives.front().material = 0;
    Scene scene;
    scene.meshes = {mesh};
    Material& plaster = scene.materials.emplace_back();
    plaster.metallicFactor = 0;
    plaster.roughnessFactor = 1;
    PreparedFrame frame;
    frame.scene = std::make_shared<Scene>(std::move(scene));
    PredictionOptions options;
    options.cocs = {6};
    options.width = 64;
    options.height = 48;
    std::vector<PredictionRow> rows;
    measurePrediction(frame, options, [&](const PredictionRow& row) { rows.push_back(row); });
    return rows;
}

TEST(Prediction, ofPlasterIsRightWithinAFactorOfTwo) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::vector<PredictionRow> rows = rowsOfABall();
    int used = 0;
    for (const PredictionRow& row : rows) {
        if (!row.used) continue;
        ++used;
        EXPECT_LE(row.rendered, 2 * row.predicted) << predictionLine(row);
        // Full detail (level 0) is excluded, since its error is only sampling noise. The prediction of this noise
        // assumes edges in the pixels, but smooth surfaces have less noise.
        if (row.level > 0) {
            EXPECT_LE(row.predicted, 2 * row.rendered) << predictionLine(row);
        }
    }
    EXPECT_GE(used, 3) << "too few rows were compared";
    // The predicted error increases from level to level.
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].level > 1) {
            EXPECT_GT(rows[i].predicted, rows[i - 1].predicted);
            EXPECT_LT(rows[i].triangles, rows[i - 1].triangles);
        }
}

}  // namespace
}  // namespace defocus::engine
