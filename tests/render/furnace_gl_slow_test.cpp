// Tests surfaces in a white furnace, with a radiance of 1 from all directions. No surface may reflect more light than
// it receives, or a negative amount.

#include <gtest/gtest.h>

#include "gl_conduct.h"
#include "render/lit_wall.h"

namespace defocus::engine {
namespace {

class Furnace : public LitWall {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

struct Extremes {
    double min = 1e9;
    double max = -1e9;
};

Extremes furnaceRadiance(const Material& material, double cosine) {
    const Image image = furnaceImage(material, cosine);
    Extremes extremes;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                extremes.min = std::min<double>(extremes.min, image.at(x, y)[c]);
                extremes.max = std::max<double>(extremes.max, image.at(x, y)[c]);
            }
    return extremes;
}

Material furnaceMaterial(float base, float metallic, float roughness) {
    return {.baseColorFactor = {base, base, base, 1}, .metallicFactor = metallic, .roughnessFactor = roughness};
}

constexpr double rounding = 1e-5;
constexpr float roughnesses[] = {0, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 1};
// cosines of the angle between normal and view axis; the pixels' view directions deviate by up to 20° from the axis
constexpr double cosines[] = {1, 0.8, 0.5, 0.2, 0.05};

// A white dielectric reflects all light: its diffuse base reflects the light that the specular layer transmits.
TEST_F(Furnace, aWhiteDielectricThrowsBackAllOfTheLight) {
    for (const float roughness : roughnesses)
        for (const double cosine : cosines) {
            const Extremes radiance = furnaceRadiance(furnaceMaterial(1, 0, roughness), cosine);
            EXPECT_NEAR(radiance.min, 1, rounding) << roughness << ' ' << cosine;
            EXPECT_NEAR(radiance.max, 1, rounding) << roughness << ' ' << cosine;
        }
}

TEST_F(Furnace, noSurfaceThrowsBackMoreThanItReceivesOrLessThanNothing) {
    for (const float base : {0.0f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 0.5f, 1.0f})
            for (const float roughness : roughnesses)
                for (const double cosine : cosines) {
                    const Extremes radiance = furnaceRadiance(furnaceMaterial(base, metallic, roughness), cosine);
                    EXPECT_GE(radiance.min, 0) << base << ' ' << metallic << ' ' << roughness << ' ' << cosine;
                    EXPECT_LE(radiance.max, 1 + rounding)
                        << base << ' ' << metallic << ' ' << roughness << ' ' << cosine;
                }
}

// A white metal loses light only because of its roughness. The model omits light that scatters several times between
// facets, so rougher surfaces lose more light. A mirror loses none.
TEST_F(Furnace, aWhiteMetalLosesLightWithItsRoughnessAlone) {
    double before = 1;
    for (const float roughness : roughnesses) {
        const double radiance = furnaceRadiance(furnaceMaterial(1, 1, roughness), 1).min;
        EXPECT_LE(radiance, before + rounding) << roughness;
        before = radiance;
    }
    EXPECT_NEAR(furnaceRadiance(furnaceMaterial(1, 1, 0), 0.5).min, 1, 1e-3);
}

}  // namespace
}  // namespace defocus::engine
