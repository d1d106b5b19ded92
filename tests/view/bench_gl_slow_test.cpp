// Checks the numbers that `defocus bench view` prints against the images that it measures.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "view/bench/view_bench.h"

namespace defocus::engine {
namespace {

class BenchView : public testing::Test {
protected:
    void SetUp() override {
        state_.options.fishCount = 2;
        state_.options.trianglesPerFish = 2000;
        state_.options.size = {160, 120};
        state_.pictureSize = {160, 120};
        state_.area.size = {160, 120};
        options_.frames = 8;
        options_.restSeconds = 20;
        options_.referenceSamples = 256;
        options_.software = context_->software();
        openForBench(document_, state_);
    }

    std::vector<ViewBenchRow> measured(const std::string& method) {
        options_.methods = {parseMethodUse(method)};
        std::vector<ViewBenchRow> rows;
        measureView(document_, state_, options_, [&](const ViewBenchRow& row) { rows.push_back(row); });
        return rows;
    }

    std::unique_ptr<GlContext> context_ = createHeadlessContext();
    Document document_;
    ViewState state_;
    ViewBenchOptions options_;
};

TEST_F(BenchView, thePictureAtRestConvergesToTheReference) {
    const std::vector<ViewBenchRow> rows = measured("accumulation");
    ASSERT_EQ(rows.size(), 1u);
    const ViewBenchRow& row = rows.front();
    EXPECT_EQ(row.method, "accumulation");
    EXPECT_GT(row.framesPerSecond, 0);
    EXPECT_GE(row.slowFrame, 0.5 * 1000 / row.framesPerSecond);
    EXPECT_TRUE(std::isfinite(row.converged));
    EXPECT_GE(row.stillPicture, 0.12);  // a view counts as still after 0.12 s without a change
    EXPECT_LE(row.stillPicture, row.converged);
    EXPECT_GE(row.samples, 16u);
    // At convergence, the estimated error is 0.005, a PSNR of 46 dB. The limit of 40 dB leaves a margin.
    EXPECT_GT(row.stillPsnr, 40);
    // Each moving frame is compared with a reference of the same camera. A reference whose camera is 1° off gives less
    // than 20 dB.
    EXPECT_GT(row.movingPsnr, 24);
    EXPECT_LT(row.movingPsnr, row.stillPsnr);
}

TEST_F(BenchView, aSceneThatCannotBeOpenedIsAnError) {
    Document document;
    state_.options.scene = "missing.glb";
    EXPECT_THROW(openForBench(document, state_), Error);
}

}  // namespace
}  // namespace defocus::engine
