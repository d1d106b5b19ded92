// Tests shadows of straight edges under a disk-shaped light against closed forms.

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "image/metrics.h"
#include "plan/visible/shadows.h"
#include "render/shadowed.h"
#include "render/textured_wall.h"

namespace defocus::engine {
namespace {

TEST_F(Shadowed, penumbraOfADiskBehindAnEdge) {
    for (const double height : {0.5, 1.0}) {
        for (const double degrees : {10.0, 20.0}) {
            const double t = std::tan(glm::radians(degrees) / 2);
            const auto small = wall();
            addSun(*small, {1, 0, 1}, glm::radians(degrees));
            addEdge(*small, height, height);
            finish(*small);
            const RenderSettings settings = settingsFor(256, Shadows::on);
            const std::vector<double> shares = litShares(*small, settings);
            // The tolerance is one texel: a depth bias of up to a texel moves the shadow-map lookup towards the light,
            // and under light at 45° the shadow's edge by the same distance.
            const FramePlan plan = planFrame(small->world, small->view, settings);
            const double bias = shadowProjections(small->world, plan, {}).front().texel;
            double width = 0;  // number of columns in the penumbra
            double expectedWidth = 0;
            for (int x = 0; x < small->view.width; ++x) {
                const double place = wallX(small->view, x);
                // Test only the wall near the shadow's edge; farther right, the board itself hides the wall.
                if (std::abs(place) > 0.7 * height) continue;
                const double share = shares[static_cast<std::size_t>(x)];
                EXPECT_LT(share, litShareBehindEdge(place - bias, height, height, t) + 0.04) << place;
                EXPECT_GT(share, litShareBehindEdge(place + bias, height, height, t) - 0.04) << place;
                const double expected = litShareBehindEdge(place, height, height, t);
                width += share > 0.02 && share < 0.98 ? 1 : 0;
                expectedWidth += expected > 0.02 && expected < 0.98 ? 1 : 0;
            }
            EXPECT_NEAR(width, expectedWidth, 3) << height << " m, " << degrees << "°";
            EXPECT_GT(expectedWidth, 4);
        }
    }
}

TEST_F(Shadowed, umbraIsDarkAndWhatNothingHidesIsLitUnchanged) {
    const auto small = wall();
    addSun(*small, {1, 0, 1}, glm::radians(2.0));
    addEdge(*small, 1, 1);
    finish(*small);
    const std::vector<double> shares = litShares(*small, settingsFor(64, Shadows::on));
    for (int x = 0; x < small->view.width; ++x) {
        const double place = wallX(small->view, x);
        const double share = shares[static_cast<std::size_t>(x)];
        if (place < -0.25) {
            EXPECT_NEAR(share, 1, 1e-5) << place;
        } else if (place > 0.25 && place < 1) {
            EXPECT_EQ(share, 0) << place;
        }
    }
}

// No light leaks where a board touches the wall. The board stands at x = 0, and the wall beside it is dark, except
// within two texels of the board.
TEST_F(Shadowed, noLightLeaksAtAContact) {
    const auto small = wall();
    addSun(*small, {1, 0, 1}, glm::radians(1.0));
    const glm::dmat4 upright = glm::rotate(glm::dmat4(1), glm::radians(90.0), glm::dvec3(0, 1, 0));
    place(*small, 0,
          glm::translate(glm::dmat4(1), {0, 0, 0.5 - receiverDepth}) * upright *
              glm::scale(glm::dmat4(1), glm::dvec3(0.5, 3, 1)));
    finish(*small);
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64, Shadows::on));
    const std::vector<ShadowProjection> projections = shadowProjections(small->world, plan, {});
    const double texel = projections.front().texel;
    const std::vector<double> shares = litShares(*small, settingsFor(64, Shadows::on));
    int dark = 0;
    for (int x = 0; x < small->view.width; ++x) {
        const double place = wallX(small->view, x);
        if (place > -2 * texel || place < -0.9)
            // Skip the pixels next to the board, where the depth bias leaves up to two shadow-map texels lit. Also skip
            // the shadow's far edge at x = −1.
            continue;
        EXPECT_EQ(shares[static_cast<std::size_t>(x)], 0) << place;
        ++dark;
    }
    EXPECT_GT(dark, 15);
}

// Surfaces do not shadow themselves. A plane under grazing light is as bright as without shadows, and so is the lit
// side of a rippled ball, well inside its outline.
TEST_F(Shadowed, surfacesDoNotShadowThemselves) {
    for (const double degrees : {0.0, 45.0, 80.0, 87.0}) {
        const auto small = wall();
        addSun(*small, {std::sin(glm::radians(degrees)), 0, std::cos(glm::radians(degrees))}, 0.01);
        finish(*small);
        for (const double share : litShares(*small, settingsFor(16, Shadows::on)))
            EXPECT_NEAR(share, 1, 1e-5) << degrees;
    }
    const auto small = wall();
    addSun(*small, {0, 0, 1}, 0.01);
    small->scene.meshes.push_back(bumpySphere(120, 90, 0));
    place(*small, 1, glm::translate(glm::dmat4(1), {0, 0, -receiverDepth}));
    finish(*small);
    const Image shadowed = shadowImage(*small, settingsFor(32, Shadows::on));
    const Image lit = shadowImage(*small, settingsFor(32, Shadows::off));
    double max = 0;
    for (int y = 18; y < 54; ++y)
        for (int x = 30; x < 66; ++x)
            max = std::max(max, static_cast<double>(lit.at(x, y)[0] - shadowed.at(x, y)[0]) / lit.at(x, y)[0]);
    EXPECT_LT(max, 0.02);
}

// The floor in front of a wall casts no shadow on the wall, although a texel of the shadow map covers both. The sun is
// at an elevation of about 70° and grazes the wall at an angle of 12°.
TEST_F(Shadowed, floorDoesNotShadowTheFootOfAWall) {
    const auto small = wall();
    small->world.pose.objects.clear();
    const glm::dmat4 level = glm::rotate(glm::dmat4(1), glm::radians(-90.0), glm::dvec3(1, 0, 0));
    place(*small, 0, level * glm::scale(glm::dmat4(1), glm::dvec3(6)));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0.5, 0}), glm::dvec3(0.5)));
    addSun(*small, {0.294, 0.935, 0.2}, 0.01);
    small->view.worldFromCamera = glm::translate(glm::dmat4(1), {0, 0.5, 2});
    finish(*small);
    const Image shadowed = shadowImage(*small, settingsFor(64, Shadows::on));
    const Image lit = shadowImage(*small, settingsFor(64, Shadows::off));
    const double pixel = 2 * tanHalfWidth * 2 / small->view.width;  // size of a pixel on the wall, m
    int seen = 0;
    for (int y = 0; y < shadowed.height; ++y) {
        const double height = 0.5 + (0.5 * shadowed.height - y - 0.5) * pixel;
        if (height < 0.5 * pixel || height > 0.3) continue;
        for (int x = 0; x < shadowed.width; ++x) {
            if (std::abs(x + 0.5 - 0.5 * shadowed.width) * pixel > 0.5 - pixel) continue;
            EXPECT_NEAR(shadowed.at(x, y)[0], lit.at(x, y)[0], 1e-5) << x << ", " << height << " m";
            ++seen;
        }
    }
    EXPECT_GT(seen, 500);
}

// The shadow of a glass pane is as bright as the light that the pane transmits. Textures cancel the pane's metalness of
// 1 and halve its transmission, and its volume absorbs light by the Beer-Lambert law.
TEST_F(Shadowed, glassShadesByItsTexturesAndThickness) {
    constexpr double side = 4;  // side of the pane, m
    constexpr double thickness = 0.1;
    const auto small = wall();
    addSun(*small, {1, 0, 1}, 0.01);
    Mesh pane = quad(1);
    pane.vertices.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    small->scene.meshes.push_back(pane);
    Material glass{.metallicFactor = 1,
                   .transmissionFactor = 1,
                   .thicknessFactor = static_cast<float>(thickness),
                   .attenuationDistance = 0.5f,
                   .attenuationColor = glm::vec3(0.5f)};
    glass.metallicRoughness.texture = addTexture(small->scene, 1, [](int, int) { return Texel{255, 255, 0, 255}; });
    glass.transmission.texture = addTexture(small->scene, 1, [](int, int) { return Texel{128, 0, 0, 255}; });
    small->scene.materials.push_back(glass);
    place(*small, 1,
          glm::scale(glm::translate(glm::dmat4(1), {1 + side / 2, 0, 1 - receiverDepth}), glm::dvec3(side / 2)));
    finish(*small);
    const std::vector<double> shares = litShares(*small, settingsFor(256, Shadows::on));
    const double expected = 128 / 255.0 * std::pow(0.5, thickness * (side / 2) / 0.5);
    double sum = 0;
    int seen = 0;
    for (int x = 0; x < small->view.width; ++x) {
        const double place = wallX(small->view, x);
        // skip the shadow's edge (left) and the part of the wall behind the pane (right)
        if (place < 0.1 || place > 0.9) continue;
        sum += shares[static_cast<std::size_t>(x)];
        ++seen;
    }
    EXPECT_GT(seen, 10);
    EXPECT_NEAR(sum / seen, expected, 0.01);
}

// A pane of coloured glass tints the light by the base colours of both surfaces and by absorption inside the glass.
TEST_F(Shadowed, colouredGlassTintsTheLight) {
    const glm::vec3 colour(1, 0.2f, 0.5f);
    for (const bool closed : {false, true}) {
        const auto small = wall();
        addSun(*small, {1, 0, 1}, 0.01);
        Material glass{.baseColorFactor = glm::vec4(colour, 1), .metallicFactor = 0, .transmissionFactor = 1};
        Mesh pane = quad(1);
        if (closed) {
            glass.thicknessFactor = 1;
            glass.attenuationDistance = 2;
            glass.attenuationColor = {0.5f, 1, 1};
            for (int i = 0; i < 4; ++i)
                pane.vertices.positions.push_back(pane.vertices.positions[i] - glm::vec3(0, 0, 0.001f));
            pane.vertices.normals.insert(pane.vertices.normals.end(), 4, {0, 0, -1});
            std::vector<std::uint32_t>& indices = pane.primitives[0].indices;
            indices.insert(indices.end(), {4, 6, 5, 4, 7, 6});
        }
        small->scene.meshes.push_back(pane);
        small->scene.materials.push_back(glass);
        place(*small, 1, glm::translate(glm::dmat4(1), {2, 0, 1 - receiverDepth}));
        finish(*small);
        glm::dvec3 expected = colour;
        if (closed) expected *= glm::dvec3(colour) * glm::dvec3(std::sqrt(0.5), 1, 1);
        const RenderSettings settings = settingsFor(256, Shadows::on);
        const Image lit = shadowImage(*small, settingsFor(256, Shadows::off));
        const Image image = shadowImage(*small, settings);
        glm::dvec3 mean(0);
        int seen = 0;
        for (int x = 0; x < small->view.width; ++x) {
            const double place = wallX(small->view, x);
            // skip the shadow's edge (left) and the part of the wall behind the pane (right)
            if (place < 0.1 || place > 0.65) continue;
            for (int c = 0; c < 3; ++c) mean[c] += double{image.at(x, 36)[c]} / double{lit.at(x, 36)[c]};
            ++seen;
        }
        ASSERT_GT(seen, 10);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / seen, expected[c], 0.01) << closed << ' ' << c;
    }
}

// Blended surfaces behind each other, here in one mesh, transmit the product of their transmittances.
TEST_F(Shadowed, blendedLayersShadeByTheirProduct) {
    const auto small = wall();
    addSun(*small, {1, 0, 1}, 0.01);
    Mesh layers;
    Primitive primitive{1, {}};
    for (const float alpha : {0.4f, 0.7f}) {
        const auto first = static_cast<std::uint32_t>(layers.vertices.count());
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            layers.vertices.positions.emplace_back(corner, alpha);
            layers.vertices.colors.emplace_back(1, 1, 1, alpha);
        }
        primitive.indices.insert(primitive.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
    layers.vertices.normals.assign(layers.vertices.count(), {0, 0, 1});
    layers.primitives.push_back(primitive);
    small->scene.meshes.push_back(layers);
    small->scene.materials.push_back(matt());
    small->scene.materials.back().alphaMode = AlphaMode::blend;
    place(*small, 1, glm::scale(glm::translate(glm::dmat4(1), {3, 0, 1 - receiverDepth}), {2, 2, 0.1}));
    finish(*small);
    const std::vector<double> shares = litShares(*small, settingsFor(256, Shadows::on));
    double sum = 0;
    int seen = 0;
    for (int x = 0; x < small->view.width; ++x) {
        const double place = wallX(small->view, x);
        // skip the shadow's edge (left) and the part behind the blended layers (right)
        if (place < 0.15 || place > 0.65) continue;
        sum += shares[static_cast<std::size_t>(x)];
        ++seen;
    }
    EXPECT_GT(seen, 10);
    EXPECT_NEAR(sum / seen, 0.6 * 0.3, 0.01);
}

// Lamps cast magnified shadows. A lamp 1 m in front of a board and 2 m in front of the wall doubles the board's width
// of 0.4 m. The lamp needs one shadow map, or six if an object also stands behind the lamp.
TEST_F(Shadowed, lampsThrowMagnifiedShadows) {
    for (const bool amid : {false, true}) {
        for (const LightType type : {LightType::point, LightType::spot}) {
            const auto small = wall();
            place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, 1 - receiverDepth}), glm::dvec3(0.2)));
            if (amid) place(*small, 0, glm::translate(glm::dmat4(1), {0, 0, 3}));
            PlacedLight lamp;
            lamp.light.type = type;
            lamp.light.intensity = 10;
            lamp.light.radius = 0.001f;
            lamp.light.innerConeAngle = 1.0f;
            lamp.light.outerConeAngle = 1.1f;
            lamp.position = {0, 0, 2 - receiverDepth};
            small->world.lights.push_back(lamp);
            finish(*small);
            const FramePlan plan = planFrame(small->world, small->view, settingsFor(16, Shadows::on));
            EXPECT_EQ(plan.shadows.maps.size(), amid && type == LightType::point ? 6u : 1u);
            const std::vector<double> shares = litShares(*small, settingsFor(16, Shadows::on));
            for (int x = 0; x < small->view.width; ++x) {
                const double place = std::abs(wallX(small->view, x));
                if (place < 0.29) continue;  // nearer to the centre, the board hides the wall
                if (std::abs(place - 0.4) < 0.08) continue;
                EXPECT_NEAR(shares[static_cast<std::size_t>(x)], place < 0.4 ? 0 : 1, 1e-4) << place;
            }
        }
    }
}

// Under a uniform sky, a tall and wide board at right angles to the wall hides half of the sky from the wall beside the
// board.
TEST_F(Shadowed, surroundingsAreHiddenByHalf) {
    const auto small = wall();
    small->world.environment = {EnvironmentType::uniform, glm::vec3(1), glm::vec3(1), glm::vec3(1), nullptr, 1};
    const glm::dmat4 upright = glm::rotate(glm::dmat4(1), glm::radians(90.0), glm::dvec3(0, 1, 0));
    place(*small, 0,
          glm::translate(glm::dmat4(1), {0.5, 0, 20 - receiverDepth}) * upright *
              glm::scale(glm::dmat4(1), glm::dvec3(20, 40, 1)));
    small->view.worldFromCamera = glm::translate(glm::dmat4(1), {-0.5, 0, 0});
    finish(*small);
    const std::vector<double> shares = litShares(*small, settingsFor(512, Shadows::on));
    int seen = 0;
    for (int x = 0; x < small->view.width; ++x) {
        const double place = wallX(small->view, x) - 0.5;
        if (place < -1.5 || place > 0.1) continue;
        EXPECT_NEAR(shares[static_cast<std::size_t>(x)], 0.5, 0.05) << place;
        ++seen;
    }
    EXPECT_GT(seen, 10);
}

TEST_F(Shadowed, withoutLightTheImageKeepsItsBits) {
    const auto small = fiveSpheres();
    small->world.lights.clear();
    small->world.environment.lighting = 0;
    EXPECT_EQ(shadowImage(*small, settingsFor(16, Shadows::on)).pixels,
              shadowImage(*small, settingsFor(16, Shadows::off)).pixels);
}

TEST_F(Shadowed, coarseCastersThrowTheSameShadows) {
    const auto small = fiveSpheres();
    RenderSettings settings = settingsFor(64, Shadows::on);
    const Image full = shadowImage(*small, settings);
    settings.lod = LodMode::fractional;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    EXPECT_TRUE(
        std::ranges::any_of(plan.shadows.casters, [](const ObjectPlan& caster) { return caster.fine.level > 0; }));
    EXPECT_GT(compareImages(full, shadowImage(*small, settings)).psnr, 38);
}

}  // namespace
}  // namespace defocus::engine
