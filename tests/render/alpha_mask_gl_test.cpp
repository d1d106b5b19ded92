// Tests cut-outs (alphaMode MASK). At any image size, the covered fraction of a wall equals the fraction of texels
// whose alpha reaches the cutoff, and the cut-out has the colour of these texels.

#include <gtest/gtest.h>

#include <cmath>

#include "gl_conduct.h"
#include "render/textured_wall.h"

namespace defocus::engine {
namespace {

class AlphaMask : public LitWall {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

constexpr int cutTexels = 160;
constexpr double shownShare = 0.3;

// Returns a texel of a pattern of squares of 8 × 8 texels. Three of ten squares are opaque green, the others
// transparent red.
Texel cutTexel(int column, int row) {
    return (7 * (column / 8) + 3 * (row / 8)) % 10 < 3 ? Texel{0, 255, 0, 255} : Texel{255, 0, 0, 0};
}

// Returns an unlit, 2 m wide wall on a transparent background, at the distance where it is about `pixels` px wide.
std::unique_ptr<SmallWorld> cutWall(double pixels) {
    const Material material{.alphaMode = AlphaMode::mask, .unlit = true};
    auto small = litWall(material);
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, cutTexels, cutTexel);
    small->scene.textures[0].minification = small->scene.textures[0].magnification = Filter::linear;
    small->scene.textures[0].mipmaps = true;
    small->world.environment.type = EnvironmentType::none;
    small->view.width = small->view.height = 64;
    // the default lens shows 0.72 m in width at a distance of 1 m
    const double distance = 2 * 64 / (2 * 0.36 * pixels);
    small->world.pose.objects[0].worldFromObject =
        glm::translate(small->view.worldFromCamera, glm::dvec3(0.013, 0.007, -distance));
    return small;
}

Image cutImage(const SmallWorld& small, std::uint32_t samples) {
    const RenderSettings settings{.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
    return imageInFloats(small.world, planFrame(small.world, small.view, settings));
}

glm::dvec4 channelSums(const Image& image) {
    glm::dvec4 sum(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 4; ++c) sum[c] += double{image.at(x, y)[c]};
    return sum;
}

TEST_F(AlphaMask, keepsItsCoverageAndColorAtEverySize) {
    for (const double pixels : {50.0, 23.0, 10.0, 4.0})
        for (const std::uint32_t samples : {4u, 64u}) {
            const glm::dvec4 sum = channelSums(cutImage(*cutWall(pixels), samples));
            const double places = samples * pixels * pixels;
            // 3 standard deviations for independent random positions
            const double error = std::max(0.02, 3 * std::sqrt(shownShare / places));
            EXPECT_NEAR(sum.a / (pixels * pixels), shownShare, error) << pixels << " px, " << samples << " samples";
            // The tolerance is for the edges of opaque squares, where the texture filter mixes green with the red of
            // transparent texels.
            EXPECT_NEAR(sum.g / sum.a, 1, 0.07) << pixels << " px, " << samples << " samples";
        }
}

// The interpolated alpha of a magnified texture is compared with the cutoff, so a pixel with a single sample is either
// opaque or empty.
TEST_F(AlphaMask, magnifiedEdgesAreSharp) {
    const auto small = cutWall(1000);
    const Image image = cutImage(*small, 1);
    int shown = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float alpha = image.at(x, y)[3];
            EXPECT_TRUE(alpha == 0 || alpha == 1) << x << ' ' << y;
            shown += alpha == 1 ? 1 : 0;
        }
    EXPECT_GT(shown, 300);
    EXPECT_LT(shown, 3000);
    EXPECT_TRUE(image.pixels == cutImage(*small, 1).pixels);
}

}  // namespace
}  // namespace defocus::engine
