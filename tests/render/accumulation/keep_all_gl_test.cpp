// Tests that RenderSettings::keepAll, which draws even objects that no lens sample sees, does not change the image.
// Such objects must not affect the drawing order of blended surfaces, the visibility of glass behind glass, or shadows.

#include "likeness.h"
#include "render/accumulation/blended_panes.h"

namespace defocus::engine {
namespace {

class KeepAll : public BlendedPanes {
protected:
    // Expects bit-identical images with and without keepAll. The scene's last object must be invisible to all lens
    // samples.
    static void expectSameBits(const SmallWorld& small, const RenderSettings& settings) {
        const FramePlan culled = planFrame(small.world, small.view, settings);
        ASSERT_EQ(culled.objects.size() + 1, small.world.pose.objects.size());
        RenderSettings everything = settings;
        everything.keepAll = true;
        const FramePlan all = planFrame(small.world, small.view, everything);
        ASSERT_EQ(all.objects.size(), small.world.pose.objects.size());
        EXPECT_TRUE(sameBits(rendered(small, settings), rendered(small, everything)));
    }

    static void expectSameBits(const SmallWorld& small) { expectSameBits(small, settingsFor(16)); }
};

// Returns the transform of a horizontal pane beside the camera, at the height of the lens. The pane reaches from 3 m
// behind the camera to 3 m in front of it.
glm::dmat4 beside() {
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(3, 0, 0)), 1.5707963267948966, glm::dvec3(1, 0, 0));
    return glm::scale(turned, glm::dvec3(1, 3, 1));
}

void addPane(SmallWorld& small, const Material& material, const glm::dmat4& worldFromObject) {
    small.scene.meshes.push_back(quad(static_cast<int>(small.scene.materials.size())));
    small.scene.materials.push_back(material);
    place(small, static_cast<int>(small.scene.meshes.size()) - 1, worldFromObject);
    finish(small);
}

// An invisible pane beside the camera has no depth order with the visible panes. If the plan counted it, visible panes
// would be drawn by stochastic transparency.
TEST_F(KeepAll, unseenPanesDoNotChangeTheBlending) {
    const auto small = overlappingPanes();
    Material blended = unlitMaterial({1, 0, 0, 0.5f});
    blended.alphaMode = AlphaMode::blend;
    blended.doubleSided = true;
    addPane(*small, blended, beside());
    expectSameBits(*small);
}

// Only the eight nearest transmitting objects are visible through each other. An invisible object must not be one of
// the eight.
TEST_F(KeepAll, unseenGlassDoesNotChangeTheGlass) {
    Material glass = unlitMaterial({0.5f, 0.8f, 0.9f, 1});
    glass.unlit = false;
    glass.metallicFactor = 0;
    glass.roughnessFactor = 0;
    glass.transmissionFactor = 1;
    const auto small = sceneOf({{1, facing(0, 0, 6, 0.8)}});
    small->world.environment = gradientSky();
    for (int i = 0; i < 10; ++i) addPane(*small, glass, facing(0.1 * i - 0.4, 0, 1 + 0.4 * i, 0.5));
    addPane(*small, glass, beside());
    expectSameBits(*small);
}

TEST_F(KeepAll, unseenObjectsDoNotChangeShadows) {
    const auto small = fiveSpheres();
    small->world.pose.objects.back().worldFromObject = glm::translate(glm::dmat4(1), glm::dvec3(400, 0, -90));
    RenderSettings settings = settingsFor(8);
    settings.shadows = Shadows::on;
    expectSameBits(*small, settings);
}

}  // namespace
}  // namespace defocus::engine
