// Tests alpha-blended surfaces that post-process methods blur separately from the surfaces behind them. Surfaces of
// similar blur are blurred together, as a "bucket".

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "gl_context_test.h"
#include "models.h"
#include "render/post_process/boards.h"

namespace defocus::engine {
namespace {

class BlendedSurfaces : public GlContextTest, public testing::WithParamInterface<const char*> {
protected:
    // Returns the tested method's image with at most `count` buckets, which are groups of blended surfaces.
    static Image inBuckets(const SmallWorld& small, int count) {
        const std::string method = GetParam();
        const char* separator = method.find(':') == std::string::npos ? ":" : ",";
        return postProcessed(small, method + separator + "transparency-buckets=" + std::to_string(count));
    }
};

constexpr glm::vec3 sky(0.5f, 0.4f, 0.3f);
constexpr glm::vec4 paneColor(0.2f, 0.6f, 0.3f, 0.5f);

// Returns the horizontal position in m, at `depth`, of a column of an image 96 px wide.
double metresOf(double column, double depth) {
    return (column - 48) / 96 * 0.72 * depth;
}

// Returns a board at `depth` that covers the image columns from `left` to `right` over the full height.
Board boardOver(double left, double right, double depth, const glm::vec4& color) {
    const double begin = metresOf(left, depth);
    const double end = metresOf(right, depth);
    return {depth, {0.5 * (begin + end), 0}, {0.5 * (end - begin), 2 * depth}, color};
}

// Scales the lens's blur to a diameter of `diameter` px at `depth`. The focus distance is 2 m.
void blurAt(SmallWorld& small, double depth, double diameter) {
    small.view.lens.blurScale = diameter / (0.05 * std::abs(1.0 / 2 - 1 / depth) * 96 / 0.72);
}

// Returns the image `a` with the colour `b` composited over it. `opacity` gives the opacity in each column.
Image laidOver(const Image& a, const glm::vec3& b, const std::function<double(int)>& opacity) {
    Image result = a;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double alpha = opacity(x);
                result.at(x, y)[c] = static_cast<float>((1 - alpha) * a.at(x, y)[c] + alpha * b[c]);
            }
    return result;
}

// Returns the fraction of a unit disk that lies left of x = t.
double shareOfDisk(double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 0.5 + (std::asin(t) + t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

TEST_P(BlendedSurfaces, aSharpPaneLeavesTheWallItsBlur) {
    const Board wall = boardOver(-90, 24, 9, {0.9f, 0.2f, 0.1f, 1});
    const Board pane = boardOver(-90, 48, 2, paneColor);
    const auto with = boards({pane, wall}, sky);
    const auto without = boards({wall}, sky);
    blurAt(*with, 9, 12);
    blurAt(*without, 9, 12);
    const Image expected =
        laidOver(inBuckets(*without, 1), glm::vec3(paneColor), [](int x) { return x < 48 ? 0.5 : 0; });
    for (const int buckets : {1, 8})
        EXPECT_LT(largestDifferenceInColumns(inBuckets(*with, buckets), expected), 2e-3) << buckets;
    // Without separate blur (0 buckets), the wall stays sharp behind the pane.
    EXPECT_GT(largestDifferenceInColumns(inBuckets(*with, 0), expected, 12, 36), 0.05);
}

TEST_P(BlendedSurfaces, aBlurredPaneLeavesStripesSharp) {
    const Board pane = boardOver(48, 400, 1, paneColor);
    std::vector<Board> stripes;
    for (int i = -2; i < 14; ++i) stripes.push_back(boardOver(8 * i, 8 * i + 4, 2, {0.9f, 0.2f, 0.1f, 1}));
    std::vector<Board> all = stripes;
    all.push_back(pane);
    const auto with = boards(all, sky);
    const auto without = boards(stripes, sky);
    const double radius = 9;
    blurAt(*with, 1, 2 * radius);
    blurAt(*without, 1, 2 * radius);
    const Image sharp = inBuckets(*without, 1);
    const Image image = inBuckets(*with, 1);
    const Image expected =
        laidOver(sharp, glm::vec3(paneColor), [&](int x) { return 0.5 * shareOfDisk((x + 0.5 - 48) / radius); });
    EXPECT_LT(largestDifferenceInColumns(image, expected, 0, 34), 2e-3);
    EXPECT_LT(largestDifferenceInColumns(image, expected, 62), 2e-3);
    // Kernels of two Gaussians approximate a disk with an error of a few hundredths. Scheuermann's taps do not form a
    // disk.
    const bool circular = std::string(GetParam()).starts_with("circular");
    EXPECT_LT(largestDifferenceInColumns(image, expected, 34, 62), circular ? 0.02 : 0.1);
    EXPECT_GT(largestDifferenceInColumns(inBuckets(*with, 0), expected, 62), 0.1);
}

TEST_P(BlendedSurfaces, whatStandsBeforeAPaneHidesItAndLeavesNoHalo) {
    const Board board = boardOver(-90, 48, 2, {0.9f, 0.2f, 0.1f, 1});
    const Board pane = boardOver(-90, 400, 6, paneColor);
    const auto with = boards({board, pane}, sky);
    blurAt(*with, 6, 12);
    const Image image = inBuckets(*with, 1);
    const Image expected =
        laidOver(inBuckets(*boards({board}, sky), 0), glm::vec3(paneColor), [](int x) { return x < 48 ? 0 : 0.5; });
    // The tolerance is larger for "scheuermann", which leaks a little light because it reads a low-resolution image.
    const bool circular = std::string(GetParam()).starts_with("circular");
    EXPECT_LT(largestDifferenceInColumns(image, expected), circular ? 2e-3 : 0.03);
}

TEST_P(BlendedSurfaces, aConstantSceneStaysConstant) {
    const glm::vec4 color(0.1f, 0.7f, 1.0f / 3, 1);
    const glm::vec4 pane(glm::vec3(color), 0.3f);
    const auto small = boards({{1.2, {-0.2, 0}, {0.1, 0.3}, pane},
                               {2, {0.2, 0}, {0.2, 0.2}, color},
                               {4, {0, 0}, {1, 0.5}, pane},
                               {6, {1, 0}, {1, 0.5}, pane},
                               {9, {0, 1}, {9, 2}, color}},
                              glm::vec3(color));
    blurAt(*small, 1.2, 10);
    const Image image = inBuckets(*small, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_NEAR(image.pixels[i], color[static_cast<int>(i % 4)], 2e-3);
}

TEST_P(BlendedSurfaces, costNothingWhereThereAreNone) {
    const auto small = boards({boardOver(20, 48, 1, {0.9f, 0.2f, 0.1f, 1}), boardOver(-90, 60, 9, {0, 1, 0, 1})}, sky);
    blurAt(*small, 9, 12);
    EXPECT_EQ(inBuckets(*small, 8).pixels, inBuckets(*small, 0).pixels);
}

// Blur passes that cover only the pixels that a bucket (group of blended surfaces) can reach give the same image as
// passes over the entire image. In the second scene, an invisible board extends the bucket to the entire image.
TEST_P(BlendedSurfaces, areBlurredAsInAWholeImage) {
    const Board wall = boardOver(-90, 40, 9, {0.9f, 0.2f, 0.1f, 1});
    for (const double depth : {1.2, 2.0, 6.0}) {
        const Board small = {depth, {0, 0}, glm::dvec2(0.04 * depth), paneColor};
        const Board unseen = boardOver(-90, 200, depth, {1, 1, 1, 0});
        const auto part = boards({small, wall}, sky);
        const auto full = boards({small, unseen, wall}, sky);
        blurAt(*part, 9, 16);
        blurAt(*full, 9, 16);
        EXPECT_LT(largestDifferenceInColumns(inBuckets(*part, 1), inBuckets(*full, 1)), 1e-3) << depth;
    }
}

TEST_P(BlendedSurfaces, haveTheirOwnBlur) {
    const Board wall = boardOver(-90, 24, 9, {0.9f, 0.2f, 0.1f, 1});
    const auto with = boards({boardOver(-90, 48, 1, paneColor), wall}, sky);
    const auto without = boards({wall}, sky);
    with->world.pose.objects[0].cocScale = 0;  // no blur, although the board is out of focus
    blurAt(*with, 9, 12);
    blurAt(*without, 9, 12);
    const Image expected =
        laidOver(inBuckets(*without, 1), glm::vec3(paneColor), [](int x) { return x < 48 ? 0.5 : 0; });
    EXPECT_LT(largestDifferenceInColumns(inBuckets(*with, 1), expected), 2e-3);
}

// Returns the RMS difference without a border, where post-process methods lack light from outside the image.
double rootMeanSquareInside(const Image& a, const Image& b, int border) {
    double sum = 0;
    for (int y = border; y < a.height - border; ++y)
        for (int x = border; x < a.width - border; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y)[c]) - double(b.at(x, y)[c]), 2);
    return std::sqrt(sum / (3.0 * (a.width - 2 * border) * (a.height - 2 * border)));
}

TEST_P(BlendedSurfaces, comeCloserToTheAccumulation) {
    std::vector<Board> list = {{1.2, {-0.2, 0.1}, {0.15, 0.1}, {0.1f, 0.5f, 0.9f, 0.6f}},
                               {2, {0.2, 0}, {0.3, 0.2}, {0.2f, 0.6f, 0.3f, 0.5f}},
                               {5, {-0.4, -0.2}, {0.8, 0.5}, {0.7f, 0.1f, 0.5f, 0.4f}}};
    for (int i = -2; i < 14; ++i) list.push_back(boardOver(8 * i, 8 * i + 4, 9, {0.9f, 0.8f, 0.1f, 1}));
    const auto small = boards(list, sky);
    blurAt(*small, 9, 12);
    RenderSettings many = settingsWithTheLens();
    many.sampleCount = 512;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, many));
    const auto errorOf = [&](int buckets) { return rootMeanSquareInside(reference, inBuckets(*small, buckets), 10); };
    const double none = errorOf(0);
    const double one = errorOf(1);
    const double each = errorOf(8);
    EXPECT_LT(one, 0.6 * none);
    EXPECT_LT(each, 0.6 * none);
    const bool circular = std::string(GetParam()).starts_with("circular");
    EXPECT_LT(each, (circular ? 0.8 : 1.2) * one);
}

INSTANTIATE_TEST_SUITE_P(Methods, BlendedSurfaces,
                         testing::Values("circular", "circular:resolution=half",
                                         "scheuermann:coc=thin-lens,taps=64,max-coc=unlimited"),
                         [](const auto& instance) { return testNameOf(instance.param); });

}  // namespace
}  // namespace defocus::engine
