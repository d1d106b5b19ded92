// Tests `bench convergence` on a small world: its measurements, its checks, and which runs it skips or resumes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "eval/convergence/convergence.h"
#include "eval/convergence/crops.h"
#include "eval/convergence/rows.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "scratch_folder.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// A renderer that returns an image of one colour and claims to have drawn any number of samples.
class Pretender final : public Renderer {
public:
    explicit Pretender(float colour, std::uint32_t claimed, int width = 64) : image_(width, 48, 4), claimed_(claimed) {
        std::ranges::fill(image_.pixels, colour);
    }
    void start(const FramePlan&) override {}
    bool advance() override { return false; }
    [[nodiscard]] std::uint32_t samples() const override { return claimed_; }
    [[nodiscard]] std::uint32_t sampleTotal() const override { return claimed_; }
    [[nodiscard]] Image image() override { return image_; }
    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats;
        stats.samples = claimed_;
        stats.renderMilliseconds = 1;
        return stats;
    }

private:
    Image image_;
    std::uint32_t claimed_;
};

class Convergence : public GlContextTest {
protected:
    // Renders the reference image once for all tests, since this takes longer than rendering most of the compared
    // images.
    static void SetUpTestSuite() {
        GlContextTest::SetUpTestSuite();
        const std::unique_ptr<SmallWorld> small = smallSpheres();
        const ScratchFolder folder;
        reference_ = referenceImage(small->world, small->view, {256, {}}, folder.path());
    }

    static std::unique_ptr<SmallWorld> smallSpheres() {
        auto small = fiveSpheres(40, 30);
        small->view.width = 64;
        small->view.height = 48;
        return small;
    }

    void SetUp() override {
        SKIP_ON_SECOND_DRIVER();
        options_.sampleCounts = {4, 16, 64};
        options_.runs = 1;
        options_.methods = {parseMethodUse("accumulation")};
    }

    void add(const char* name, float colour, std::uint32_t claimed, int width = 64) {
        registerMethod({.name = name,
                        .description = "",
                        .needsGl = false,
                        .settings = {},
                        .make = [=](const World&, const RendererOptions&) {
                            return std::make_unique<Pretender>(colour, claimed, width);
                        }});
    }

    std::vector<ConvergenceRun> measure(const std::vector<ConvergenceRun>& done = {}) {
        std::vector<ConvergenceRun> runs;
        measureConvergence(small_->world, small_->view, reference_, options_, 12, done,
                           {[&](const ConvergenceRun& run, const Image* image, const Image* flipMap) {
                                runs.push_back(run);
                                images_ += image != nullptr && flipMap != nullptr;
                            },
                            [&](const ConvergenceCase& wanted, const std::string& reason) {
                                leftOut_[wanted.use.method->name] = reason;
                            }});
        return runs;
    }

    static inline ReferenceImage reference_;

    std::unique_ptr<SmallWorld> small_ = smallSpheres();
    ConvergenceOptions options_;
    int images_ = 0;
    std::map<std::string, std::string> leftOut_;
};

TEST_F(Convergence, moreLensSamplesComeCloser) {
    options_.lods = {LodMode::off};
    // without keepAll, the sample count would determine which clusters are culled, and thus the triangle counts
    options_.plan.keepAll = true;
    const std::vector<ConvergenceRun> runs = measure();
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_LT(runs[1].error.mse, runs[0].error.mse);
    EXPECT_LT(runs[2].error.mse, runs[1].error.mse);
    EXPECT_LT(runs[2].error.flip, runs[0].error.flip);
    const double remaining = reference_.remaining.rmse;
    EXPECT_GT(runs[2].error.mse, remaining * remaining);
    for (const ConvergenceRun& run : runs) {
        EXPECT_EQ(run.fault, "");
        EXPECT_EQ(run.samples, run.asked);
        EXPECT_GT(run.milliseconds, 0);
        EXPECT_GT(run.setupMilliseconds, 0);
        EXPECT_EQ(run.pyramidMilliseconds, 0);  // no pyramids are built, since full detail needs no simplified meshes
        EXPECT_FALSE(run.bias);
    }
    EXPECT_EQ(runs[1].triangles, 4 * runs[0].triangles);
}

// The RMSE d between two images obeys the triangle inequality. For an image with levels of detail, an image at full
// detail and the reference, |d(levels, full) − d(full, reference)| ≤ d(levels, reference) ≤ d(levels, full) + d(full,
// reference).
TEST_F(Convergence, biasAndSamplingErrorObeyTheTriangleInequality) {
    options_.sampleCounts = {16};
    options_.thresholdFactors = {4, 0};
    const std::vector<ConvergenceRun> runs = measure();
    ASSERT_EQ(runs.size(), 3u);
    const double sampling = std::sqrt(runs[0].error.mse);
    ASSERT_TRUE(runs[1].bias);
    const double bias = std::sqrt(runs[1].bias->mse);
    const double error = std::sqrt(runs[1].error.mse);
    EXPECT_GT(bias, 0);
    EXPECT_LE(error, sampling + bias + 1e-9);
    EXPECT_GE(error, std::abs(sampling - bias) - 1e-9);
    EXPECT_LT(runs[1].triangles, runs[0].triangles);
    EXPECT_EQ(runs[1].pyramidMilliseconds, 12);

    // Run 2 has level-of-detail thresholds of zero, so its image equals the image at full detail in every pixel.
    ASSERT_TRUE(runs[2].bias);
    EXPECT_EQ(runs[2].bias->mse, 0);
    EXPECT_EQ(runs[2].imageHash, runs[0].imageHash);
}

TEST_F(Convergence, runsTakeTurnsAndGiveTheSameImage) {
    options_.sampleCounts = {4};
    options_.runs = 2;
    options_.thresholdFactors = {1};
    const std::vector<ConvergenceRun> runs = measure();
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[0].setting, runs[2].setting);
    EXPECT_EQ(runs[1].setting, runs[3].setting);
    EXPECT_NE(runs[0].setting, runs[1].setting);
    EXPECT_EQ(runs[0].imageHash, runs[2].imageHash);
    EXPECT_EQ(runs[1].error.mse, runs[3].error.mse);
    ASSERT_TRUE(runs[3].bias);
    EXPECT_EQ(runs[1].bias->mse, runs[3].bias->mse);
    EXPECT_EQ(images_, 2);  // one image for each setting, from its first run
}

TEST_F(Convergence, takesUpWhatIsThere) {
    options_.sampleCounts = {4, 8};
    options_.runs = 2;
    options_.thresholdFactors = {1};
    const std::vector<ConvergenceRun> all = measure();
    ASSERT_EQ(all.size(), 8u);
    for (std::size_t kept = 0; kept <= all.size(); ++kept) {
        const std::vector<ConvergenceRun> done(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept));
        const std::vector<ConvergenceRun> rest = measure(done);
        ASSERT_EQ(done.size() + rest.size(), all.size());
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const ConvergenceRun& expected = all[kept + i];
            EXPECT_EQ(rest[i].setting, expected.setting);
            EXPECT_EQ(rest[i].asked, expected.asked);
            EXPECT_EQ(rest[i].run, expected.run);
            EXPECT_EQ(rest[i].error.mse, expected.error.mse);
            ASSERT_EQ(rest[i].bias.has_value(), expected.bias.has_value());
            if (expected.bias) {
                EXPECT_EQ(rest[i].bias->mse, expected.bias->mse);
            }
        }
    }
}

TEST_F(Convergence, imagesThatAreNotWhatTheyClaimAreFaults) {
    add("few", 0.5f, 3);
    add("nan", std::numeric_limits<float>::quiet_NaN(), 4);
    add("small", 0.5f, 4, 32);
    options_.sampleCounts = {4};
    options_.lods = {LodMode::off};
    options_.methods = {parseMethodUse("few"), parseMethodUse("nan"), parseMethodUse("small")};
    std::map<std::string, std::string> faults;
    for (const ConvergenceRun& run : measure()) faults[run.method] = run.fault;
    EXPECT_EQ(faults.at("accumulation"), "");
    EXPECT_NE(faults.at("few").find("3 lens samples instead of 4"), std::string::npos);
    EXPECT_NE(faults.at("nan").find("NaN or infinite"), std::string::npos);
    EXPECT_NE(faults.at("small").find("32 x 48"), std::string::npos);
}

TEST_F(Convergence, aMethodThatFailsIsLeftOutAndOthersGoOn) {
    registerMethod(
        {.name = "failing",
         .description = "",
         .needsGl = false,
         .settings = {},
         .make = [](const World&, const RendererOptions&) -> std::unique_ptr<Renderer> { fail("not in this scene"); }});
    options_.sampleCounts = {4, 8};
    options_.lods = {LodMode::off};
    options_.methods = {parseMethodUse("failing"), parseMethodUse("accumulation")};
    EXPECT_EQ(measure().size(), 2u);
    ASSERT_EQ(leftOut_.size(), 1u);
    EXPECT_EQ(leftOut_.at("failing"), "not in this scene");
}

// A method that does not support a feature of the scene is skipped, since its image would lack that feature.
TEST_F(Convergence, methodsThatCanOnlyShowAnotherImageAreLeftOut) {
    const auto make = [](const World&, const RendererOptions&) { return std::make_unique<Pretender>(0.5f, 4); };
    registerMethod(
        {.name = "unshaded", .description = "", .needsGl = false, .shadesAsLit = false, .settings = {}, .make = make});
    registerMethod(
        {.name = "frozen", .description = "", .needsGl = false, .drawsMotion = false, .settings = {}, .make = make});
    options_.sampleCounts = {4};
    options_.lods = {LodMode::off};
    options_.methods = {parseMethodUse("unshaded"), parseMethodUse("frozen")};
    const auto namesLeftOut = [&] {
        leftOut_.clear();
        const std::size_t measured = measure().size();
        std::string names;
        for (const auto& [name, reason] : leftOut_) names += name + ' ';
        EXPECT_EQ(measured + leftOut_.size(), 3u);
        return names;
    };
    EXPECT_EQ(namesLeftOut(), "unshaded ");  // the method `unshaded` is left out, since the spheres are lit

    Pose moved = small_->world.pose;
    for (Object& object : moved.objects) object.worldFromObject[3].x += 0.2;
    small_->world.shutter.poses = {small_->world.pose, moved};
    EXPECT_EQ(namesLeftOut(), "frozen unshaded ");

    for (Material& material : small_->scene.materials) material.unlit = true;
    EXPECT_EQ(namesLeftOut(), "frozen ");
    small_->world.shutter.poses = {small_->world.pose, small_->world.pose};  // the shutter is open, but no object moves
    EXPECT_EQ(namesLeftOut(), "");
    small_->scene.materials[0].alphaMode = AlphaMode::mask;
    EXPECT_EQ(namesLeftOut(), "unshaded ");
}

// Spheres that move by 0.2 m during the exposure change a method's image if and only if the method claims to draw
// motion.
TEST_F(Convergence, methodsDrawMotionIfTheySaySo) {
    Pose moved = small_->world.pose;
    for (Object& object : moved.objects) object.worldFromObject[3].x += 0.2;
    const std::vector<Pose> moving = {small_->world.pose, moved};
    RenderSettings settings{.sampleCount = 8, .lod = LodMode::off, .keepAll = true};
    for (const char* name : {"accumulation", "scheuermann", "circular"}) {
        const MethodUse use = parseMethodUse(name);
        const RendererOptions own{.settings = use.settings};
        const auto imageOf = [&](const std::vector<Pose>& poses) {
            small_->world.shutter.poses = poses;
            const auto renderer = use.method->make(small_->world, own);
            drawAllSamples(*renderer, planFrame(small_->world, small_->view, settings));
            return renderer->image().pixels;
        };
        EXPECT_EQ(imageOf(moving) != imageOf({}), use.method->drawsMotion) << name;
    }
}

TEST_F(Convergence, cropsLieInTheImageAndApart) {
    const std::vector<Crop> crops = tellingCrops(small_->world, small_->view, reference_, 4, {});
    ASSERT_EQ(crops.size(), 2u);
    for (const Crop& crop : crops) {
        EXPECT_EQ(crop.width, 12);
        EXPECT_EQ(crop.height, 12);
        EXPECT_GE(std::min(crop.x, crop.y), 0);
        EXPECT_LE(crop.x + crop.width, 64);
        EXPECT_LE(crop.y + crop.height, 48);
    }
    const bool apart = std::abs(crops[0].x - crops[1].x) >= 12 || std::abs(crops[0].y - crops[1].y) >= 12;
    EXPECT_TRUE(apart);
}

}  // namespace
}  // namespace defocus::engine
