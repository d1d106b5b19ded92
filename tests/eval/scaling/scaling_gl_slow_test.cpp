#include <gtest/gtest.h>

#include "eval/scaling/large_scenes.h"
#include "eval/scaling/scaling.h"
#include "gl/context.h"

namespace defocus::engine {
namespace {

// Each point of an axis (a scene property that is varied) is measured with and without levels of detail. The axis
// `instances` has the smallest meshes: one fish, drawn up to 10,000 times.
TEST(Scaling, measuresEachPointOfAnAxisInBothModes) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    ScalingOptions options;
    options.axes = {ScalingAxis::instances};
    options.runs = 1;
    std::vector<ScalingRow> rows;
    ScalingVisitor visitor;
    visitor.row = [&](const ScalingRow& row) { rows.push_back(row); };
    visitor.leftOut = [](const ScalingPoint&, const std::string& reason) { FAIL() << reason; };
    measureScaling(options, visitor);
    const std::vector<ScalingPoint> points = scalingPoints(ScalingAxis::instances, false);
    ASSERT_EQ(rows.size(), 2 * points.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].value, points[i / 2].value);
        EXPECT_EQ(rows[i].mode, i % 2 == 0 ? LodMode::off : LodMode::fractional);
        EXPECT_GT(rows[i].milliseconds.median, 0);
        EXPECT_GT(rows[i].layers.median, 0);
        EXPECT_GT(rows[i].vertices.median, 0);
        EXPECT_GT(rows[i].gpuBytes, 640u * 480 * 4);
        if (i % 2 == 1) {
            EXPECT_LE(rows[i].triangles, rows[i - 1].triangles);
        }
        if (i >= 2) {
            EXPECT_GT(rows[i].triangles, rows[i - 2].triangles);
        }
    }
    // At full detail, each sample draws every triangle of each instance.
    EXPECT_EQ(rows[2].triangles, 10 * rows[0].triangles);
}

// Small versions of the two large scenes have the requested number of meshes and about the requested number of
// triangles.
TEST(LargeScenes, areMeasuredAsTheyAre) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const LargeSceneRow instances = measureLargeScene({"instances", 30, 300, true}, {});
    EXPECT_EQ(instances.meshes, 1u);
    const LargeSceneRow different = measureLargeScene({"different", 30, 300, false}, {});
    EXPECT_EQ(different.meshes, 30u);
    for (const LargeSceneRow& row : {instances, different}) {
        EXPECT_GT(row.triangles, 30u * 200);
        EXPECT_LT(row.triangles, 30u * 400);
        EXPECT_GT(row.planMilliseconds.median, 0);
        EXPECT_GT(row.firstImageMilliseconds, 0);
        EXPECT_GT(row.trianglesDrawn, 0u);
        EXPECT_GT(row.residentBytes, row.gpuBytes / 2);
    }
}

}  // namespace
}  // namespace defocus::engine
