#include "plan/lens_cells/lens_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "plan/plan_checks.h"
#include "plan/plan_text.h"
#include "plan/sample_range.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns strongly blurred spheres in front of and behind the focal plane.
std::unique_ptr<SmallWorld> muchBlurred() {
    auto small = fiveSpheres();
    small->view.lens.fStop = 0.1;
    return small;
}

LensCells lensCellsOf(const SmallWorld& small, std::uint32_t samples) {
    return lensCells(planFrame(small.world, small.view, settingsFor(samples)));
}

struct Moments {
    glm::dvec2 mean{0};
    glm::dmat2 covariance{0};
};

template <typename Points>
Moments momentsOf(const Points& points) {
    Moments moments;
    const auto count = static_cast<double>(points.size());
    for (const glm::vec2& point : points) moments.mean += glm::dvec2(point) / count;
    for (const glm::vec2& point : points) {
        const glm::dvec2 off = glm::dvec2(point) - moments.mean;
        moments.covariance += glm::outerProduct(off, off) / count;
    }
    return moments;
}

// Lens cells, regions of the lens with one sample each, preserve the position and size of blurred objects at every
// sample count. The mean of the cells' centres is the mean position on the lens. The covariances of the centres and of
// the blur add up to the lens's covariance. For a circle of confusion of c px, a blur with the standard deviation b·c
// px in the image corresponds to one of 2b lens radii on the lens.
TEST(LensCells, middlesAndBlurHaveTheSpreadOfTheLens) {
    const auto small = muchBlurred();
    const auto check = [&](const char* what, double tolerance) {
        std::vector<glm::vec2> lens;
        for (const LensSample& sample : lensSamples(small->view.lens, Sequence::halton, 0, 1u << 17, 0))
            lens.push_back(sample.lens);
        const Moments full = momentsOf(lens);
        for (const Sequence sequence : allSequences)
            for (const std::uint32_t count : {16u, 50u, 64u, 500u}) {
                RenderSettings settings = settingsFor(count);
                settings.sequence = sequence;
                const LensCells cells = lensCells(planFrame(small->world, small->view, settings));
                ASSERT_EQ(cells.middles.size(), count);
                const Moments own = momentsOf(cells.middles);
                for (glm::length_t i = 0; i < 2; ++i) {
                    EXPECT_NEAR(own.mean[i], full.mean[i], tolerance) << what << ' ' << count;
                    for (glm::length_t j = 0; j < 2; ++j)
                        EXPECT_NEAR(own.covariance[i][j] + (i == j ? 4 * cells.blur * cells.blur : 0),
                                    full.covariance[i][j], tolerance)
                            << what << ' ' << count;
                }
                for (const glm::vec2& middle : cells.middles) ASSERT_LE(glm::length(middle), 1 + 1e-6f);
            }
    };
    check("disk", 1e-4);
    small->view.lens.bladeCount = 5;
    check("blades", 5e-4);
    small->view.lens.anamorphicRatio = 2;
    check("oval", 5e-4);
    small->view.lens.bladeCount = 0;
    small->view.lens.anamorphicRatio = 1;
    small->view.lens.obstruction = 0.5;
    check("ring", 2e-3);
}

// Centres of lens cells, regions of the lens with one sample each, lie farther apart than points of the sample
// sequence. Each of the 64 centres is the mean of a region with 1/64 of the lens's area.
TEST(LensCells, middlesKeepApart) {
    const auto small = muchBlurred();
    const auto nearest = [](const auto& points, const auto& place) {
        double min = 2;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                min = std::min<double>(min, glm::length(place(points[i]) - place(points[j])));
        return min;
    };
    const std::vector<LensSample> samples = lensSamples(small->view.lens, Sequence::sobol, 0, 64, 0);
    const double apart = nearest(lensCellsOf(*small, 64).middles, [](const glm::vec2& p) { return p; });
    EXPECT_GT(apart, 1.5 * nearest(samples, [](const LensSample& s) { return s.lens; }));
    // 64 equal disks that together have the lens's area have a radius of 1/8 lens radius.
    EXPECT_GT(apart, 1.0 / 8);
}

// In a frame that is drawn in blocks, the cells of all blocks together divide the lens about as finely as the cells of
// a frame that is drawn as one block. Blocks with the same cell centres would show ghost copies of lights, however many
// samples are drawn.
TEST(LensCells, blocksHaveDifferentMiddles) {
    const auto small = muchBlurred();
    std::vector<glm::vec2> middles;
    for (std::uint32_t first = 0; first < 1024; first += 64) {
        RenderSettings block = settingsFor(64);
        block.firstSample = first;
        const LensCells cells = lensCells(planFrame(small->world, small->view, block));
        middles.insert(middles.end(), cells.middles.begin(), cells.middles.end());
    }
    ASSERT_EQ(middles.size(), 1024u);
    // 1,024 random points would lie in only about 700 of the 1,257 squares with sides of 1/20 lens radius.
    std::set<std::pair<int, int>> squares;
    for (const glm::vec2& middle : middles) squares.emplace(std::lround(20 * middle.x), std::lround(20 * middle.y));
    EXPECT_GT(squares.size(), 700u);
}

// Returns the RMS difference between two blurred images of a straight edge, over positions across the edge: one blurred
// by a disk, the other by Gaussians of `sigma` at `points`. Lengths are in lens radii; the edge's normal has the
// direction `angle`.
double edgeError(const std::vector<glm::vec2>& points, double sigma, double angle) {
    double squares = 0;
    int places = 0;
    for (double place = -0.98; place < 0.99; place += 0.02, ++places) {
        double share = 0;
        for (const glm::vec2& point : points) {
            const double off = point.x * std::cos(angle) + point.y * std::sin(angle) - place;
            share += sigma > 0 ? 0.5 * std::erfc(off / (sigma * std::sqrt(2))) : off < 0 ? 1 : 0;
        }
        const double disk = 0.5 + (place * std::sqrt(1 - place * place) + std::asin(place)) / std::numbers::pi;
        squares += std::pow(share / static_cast<double>(points.size()) - disk, 2);
    }
    return std::sqrt(squares / places);
}

// With lens cells (regions of the lens), edges of every direction look almost as if blurred by a disk. Rows and columns
// of lens points would blur vertical and horizontal edges in steps.
TEST(LensCells, edgesAreBlurredAsByADisk) {
    const auto small = muchBlurred();
    for (const std::uint32_t count : {16u, 24u, 32u, 64u, 128u}) {
        std::vector<glm::vec2> samples;
        for (const LensSample& sample : lensSamples(small->view.lens, Sequence::sobol, 0, count, 0))
            samples.push_back(sample.lens);
        const LensCells cells = lensCellsOf(*small, count);
        double squares = 0;
        double samplesSquares = 0;
        for (int i = 0; i < 12; ++i) {
            const double angle = i * std::numbers::pi / 12;
            const double error = edgeError(cells.middles, 2 * cells.blur, angle);
            const double samplesError = edgeError(samples, 0, angle);
            EXPECT_LT(error, 0.4 * samplesError) << count << ' ' << angle;
            squares += error * error;
            samplesSquares += samplesError * samplesError;
        }
        EXPECT_LT(std::sqrt(squares / samplesSquares), 0.2) << count;
    }
}

// A subset of a planned frame's samples has the same lens cells (regions of the lens) as the entire frame. Samples that
// are planned separately have different cells. These are blurred as in a frame that ends with the last of the planned
// samples.
TEST(LensCells, belongToWhatIsPlannedTogether) {
    const auto small = muchBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(192));
    const LensCells part = lensCells(samplesOf(plan, 64, 64));
    EXPECT_EQ(part.middles, lensCells(plan).middles);
    RenderSettings last = settingsFor(64);
    last.firstSample = 128;
    const LensCells block = lensCells(planFrame(small->world, small->view, last));
    EXPECT_EQ(block.blur, part.blur);
    EXPECT_EQ(block.firstSample, 128u);
    ASSERT_EQ(block.middles.size(), 64u);
    const Moments moments = momentsOf(block.middles);
    EXPECT_LT(glm::length(moments.mean), 1e-4);
    EXPECT_NEAR(moments.covariance[0][0], 0.25 - 4 * block.blur * block.blur, 1e-4);
}

// The blur of lens cells (regions of the lens) shrinks as samples are added. It vanishes at the sample count that
// leaves no visible gaps. The centres of the cells do not jump at that count.
TEST(LensCells, blurFallsWithTheSamplesUntilThereIsNone) {
    const auto small = muchBlurred();
    const LensCells few = lensCellsOf(*small, 16);
    const LensCells more = lensCellsOf(*small, 64);
    EXPECT_NEAR(few.blur, 2 * more.blur, 1e-12);
    EXPECT_GE(few.inFront, more.inFront);
    EXPECT_GE(few.behind, more.behind);
    small->view.lens.fStop = 4;
    const LensCells none = lensCellsOf(*small, 4096);
    EXPECT_EQ(none.classes(), 0);
    EXPECT_EQ(none.middles.size(), 4096u);
    small->view.lens.fStop = 3.99;
    const LensCells before = lensCellsOf(*small, 4096);
    for (std::size_t i = 0; i < none.middles.size(); ++i)
        ASSERT_LT(glm::distance(none.middles[i], before.middles[i]), 1e-6f) << i;
}

// Black rows around an aperture image, here of four bright dots, change nothing: the open area of the lens stays the
// same, and so does the blur of the lens cells (regions of the lens).
TEST(LensCells, blackBordersOfAnApertureImageChangeNothing) {
    const auto blurWith = [](int height) {
        Image image(16, height, 3);
        for (const int x : {2, 13})
            for (const int y : {height / 2 - 2, height / 2 + 1})
                for (int channel = 0; channel < 3; ++channel) image.at(x, y)[channel] = 1;
        const auto small = muchBlurred();
        small->view.lens.apertureImage = std::make_shared<const Image>(std::move(image));
        return lensCellsOf(*small, 64).blur;
    };
    EXPECT_GT(blurWith(16), 0);
    EXPECT_NEAR(blurWith(4), blurWith(16), 1e-9);
}

// The resolution that a sample's image needs falls continuously to 1/16 of full resolution as the blur grows.
TEST(LensCells, pixelRateIsContinuous) {
    const auto small = muchBlurred();
    const LensCells cells = lensCellsOf(*small, 64);
    double before = 1;
    for (double coc = 0; coc < 400; coc += 0.1) {
        const double rate = pixelRate(cells, coc);
        EXPECT_EQ(rate, pixelRate(cells, -coc));
        EXPECT_LE(rate, before);
        EXPECT_GT(rate, before - 0.02);
        before = rate;
    }
    EXPECT_EQ(before, 1.0 / 16);
    EXPECT_EQ(pixelRate({}, 400), 1);
}

TEST(LensCells, framesThatDoNotAllowThemSayWhy) {
    const auto small = muchBlurred();
    ASSERT_EQ(lensCellsOf(*small, 64).reason, "");
    EXPECT_NE(planTable(planFrame(small->world, small->view, settingsFor(64))).find("a small part of the lens"),
              std::string::npos);
    const auto expectNone = [&](const char* reason, std::uint32_t samples = 64) {
        const LensCells cells = lensCellsOf(*small, samples);
        EXPECT_EQ(cells.blur, 0) << reason;
        EXPECT_NE(cells.reason.find(reason), std::string::npos) << cells.reason;
        EXPECT_NE(planTable(planFrame(small->world, small->view, settingsFor(samples))).find(reason),
                  std::string::npos);
    };
    expectNone("few samples", 3);
    small->view.lens.axialChromaticAberration = 0.3;
    expectNone("its own wavelength");
    small->view.lens.axialChromaticAberration = 0;
    small->world.pose.objects[0].cocScale = 0.5;
    expectNone("their own blur");
    small->world.pose.objects[0].cocScale = 1;
    small->world.environment = {EnvironmentType::none, {}, {}, {}, nullptr, 1};
    expectNone("transparent");
}

TEST(LensCells, samplesMoveOnlyIfImagesAreBlurred) {
    const auto small = muchBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    FramePlan moved = plan;
    const LensCells cells = lensCells(plan);
    moveToCells(moved, cells);
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(moved.samples[i].lens, cells.middles[i]);
        EXPECT_EQ(moved.samples[i].pixel, plan.samples[i].pixel + glm::vec2(cells.pixelShift));
    }
    FramePlan kept = plan;
    moveToCells(kept, {});
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(kept.samples[i].lens, plan.samples[i].lens);
}

}  // namespace
}  // namespace defocus::engine
