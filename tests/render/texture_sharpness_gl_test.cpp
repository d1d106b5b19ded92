// Tests the sharpness of textures on slanted surfaces. Each lens sample filters the texture over only a part of the
// pixel. The mean of many samples is therefore as sharp as the pixel allows, although the mip level of a full pixel
// would be much coarser.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gl_conduct.h"
#include "render/textured_wall.h"

namespace defocus::engine {
namespace {

class TextureSharpness : public LitWall {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

constexpr double wallAway = 40;  // distance in m, so large that the wall has almost the same scale everywhere

// Returns a wall rotated about a vertical axis, with a texture of 1024² texels that is black above and white below.
// Rotated by 80°, the wall shows 5.8 times as many texels per pixel horizontally as vertically.
std::unique_ptr<SmallWorld> halfWhiteWall(double degrees) {
    const Material material{.unlit = true};
    auto small = litWall(material);
    small->scene.materials[0].baseColor.texture = addTexture(small->scene, 1024, [](int, int row) {
        return row < 512 ? Texel{0, 0, 0, 255} : Texel{255, 255, 255, 255};
    });
    small->scene.textures[0].minification = small->scene.textures[0].magnification = Filter::linear;
    small->scene.textures[0].mipmaps = true;
    small->world.pose.objects[0].worldFromObject =
        glm::rotate(glm::translate(small->view.worldFromCamera, glm::dvec3(0, 0, -wallAway)),
                    degrees * std::numbers::pi / 180, glm::dvec3(0, 1, 0));
    small->view.lens.focalLength = 800;
    small->view.width = small->view.height = 48;
    return small;
}

// Returns the distance in px over which the middle column changes from 10 % to 90 % of the texture's white.
double edgeWidth(const SmallWorld& small, const char* method, std::uint32_t samples) {
    // without keepAll, an image without blur is drawn with only 16 samples
    const RenderSettings settings{.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
    const Image image = imageByMethod(method, small.world, planFrame(small.world, small.view, settings));
    const auto crossing = [&](double level) {
        for (int y = 8; y < image.height - 8; ++y) {
            const double here = image.at(24, y)[0];
            const double below = image.at(24, y + 1)[0];
            if (here < level && below >= level) return y + (level - here) / (below - here);
        }
        return std::nan("");
    };
    return crossing(0.9) - crossing(0.1);
}

TEST_F(TextureSharpness, manySamplesShowEdgesAsSharpAsThePixel) {
    for (const double degrees : {0.0, 60.0, 80.0}) {
        const auto small = halfWhiteWall(degrees);
        for (const char* method : {"accumulation", "stochastic"})
            EXPECT_LE(edgeWidth(*small, method, 64), 1.2) << method << ", " << degrees << " degrees";
    }
}

TEST_F(TextureSharpness, growsWithTheSamples) {
    const auto small = halfWhiteWall(80);
    const double one = edgeWidth(*small, "accumulation", 1);
    const double few = edgeWidth(*small, "accumulation", 8);
    EXPECT_GT(one, 3);  // a single sample filters the texture over the full pixel
    EXPECT_LT(few, 0.6 * one);
    EXPECT_LE(edgeWidth(*small, "accumulation", 256), few);
}

}  // namespace
}  // namespace defocus::engine
