// Tests the choice between sorting and stochastic transparency for alpha-blended surfaces.
#include "plan/visible/blend_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns a closed cone around the z axis with its base at z = 0. Its front faces point outwards unless `inwards`.
Mesh coneMesh(int sides, bool inwards) {
    Mesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        mesh.vertices.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    mesh.vertices.positions.emplace_back(0, 0, 0);
    mesh.vertices.positions.emplace_back(0, 0, 1);
    const auto base = static_cast<std::uint32_t>(sides);
    Primitive primitive{0, {}};
    for (std::uint32_t i = 0; i < base; ++i) {
        const std::uint32_t next = (i + 1) % base;
        primitive.indices.insert(primitive.indices.end(), {i, next, base + 1, next, i, base});
    }
    if (inwards) std::ranges::reverse(primitive.indices);
    mesh.primitives.push_back(primitive);
    return mesh;
}

TEST(BlendOrder, convexBodiesFaceOutwards) {
    const auto isConvexMesh = [](const Mesh& mesh) {
        return isConvex(mesh.vertices.positions, mesh.primitives[0].indices);
    };
    EXPECT_TRUE(isConvexMesh(quad(0)));
    EXPECT_TRUE(isConvexMesh(coneMesh(20, false)));
    EXPECT_FALSE(isConvexMesh(coneMesh(20, true)));
    EXPECT_FALSE(isConvexMesh(bumpySphere(16, 8, 0)));
    Mesh dented = coneMesh(20, false);
    dented.vertices.positions[20].z = 0.1f;
    EXPECT_FALSE(isConvexMesh(dented));
}

// Returns a scene of alpha-blended panes. `places` are their transforms to world space.
std::unique_ptr<SmallWorld> panes(const std::vector<glm::dmat4>& places) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({1, 1, 1, 0.5f}));
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.meshes.push_back(quad(0));
    for (const glm::dmat4& worldFromObject : places) place(*small, 0, worldFromObject);
    finish(*small);
    return small;
}

// Returns, for each pane, whether it is drawn by stochastic transparency. `places` are the panes' transforms to world
// space.
std::vector<bool> choicesFor(const std::vector<glm::dmat4>& places) {
    const auto small = panes(places);
    const FramePlan plan = planFrame(small->world, small->view, {});
    std::vector<bool> choices(places.size());
    EXPECT_EQ(plan.blendOrder.size(), places.size());
    for (const BlendRun& run : plan.blendOrder) {
        const ObjectPlan& object = plan.objects[run.object];
        EXPECT_TRUE(object.blended);
        choices[static_cast<std::size_t>(object.object)] = run.stochastic;
    }
    return choices;
}

glm::dmat4 turnedPane(double x, double z, double degrees) {
    return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z)), glm::radians(degrees), glm::dvec3(0, 1, 0));
}

TEST(BlendOrder, panesAreSortedUnlessTheyMayCross) {
    const auto& at = turnedPane;
    using Choices = std::vector<bool>;
    EXPECT_EQ(choicesFor({at(0, -10, 40)}), Choices{false});
    EXPECT_EQ(choicesFor({at(0, -10, 40), at(0.5, -12, 40)}), (Choices{false, false})) << "behind each other";
    EXPECT_EQ(choicesFor({at(-2, -10, 40), at(2, -10, 30)}), (Choices{false, false})) << "side by side";
    const Choices crossing = choicesFor({at(0, -10, 40), at(0, -10, -40)});
    EXPECT_EQ(std::ranges::count(crossing, true), 1) << "crossing";
}

// Returns the indices of the panes from back to front. Fails the test if a pane is drawn by stochastic transparency,
// which has no order.
std::vector<int> orderOf(const SmallWorld& small) {
    const FramePlan plan = planFrame(small.world, small.view, {});
    std::vector<int> order;
    for (const BlendRun& run : plan.blendOrder) {
        EXPECT_FALSE(run.stochastic);
        order.push_back(plan.objects[run.object].object);
    }
    return order;
}

// Two parallel panes, rotated by 80°, overlap in depth. One reaches nearer to the camera, but lies behind the other's
// plane and must be drawn first.
TEST(BlendOrder, overlappingDepthsAreSortedByPlanes) {
    const auto small = panes({turnedPane(-0.2, -10, 80), turnedPane(0.1, -10.1, 80)});
    EXPECT_EQ(orderOf(*small), (std::vector<int>{0, 1}));
    small->world.pose.objects[0].worldFromObject = turnedPane(0.4, -10, 80);
    EXPECT_EQ(orderOf(*small), (std::vector<int>{1, 0}));
}

// The plane of a pane that is seen edge-on cuts through a large lens, so the lens sees both sides of the pane.
TEST(BlendOrder, lensOnBothSidesOfAPaneHasNoOrder) {
    auto small = panes({turnedPane(-0.05, -4, 90), turnedPane(0.05, -4, 90)});
    small->view.lens.dofEnabled = false;
    EXPECT_EQ(orderOf(*small).size(), 2u);
    small->view.lens.dofEnabled = true;
    small->view.lens.fStop = 0.1;
    small->view.lens.focusDistance = 4;
    const FramePlan plan = planFrame(small->world, small->view, {});
    EXPECT_EQ(std::ranges::count(plan.blendOrder, true, &BlendRun::stochastic), 1);
}

// Each of three flat bars covers the next bar at one end and is covered by the previous bar at the other end, so no
// drawing order of all three is correct. Any two bars can be ordered, because the plane of one does not cut the other.
TEST(BlendOrder, cyclesAreBroken) {
    const auto turned = [](int i, const glm::dvec3& vector) {
        return glm::dvec3(glm::rotate(glm::dmat4(1), i * 2 * std::numbers::pi / 3, {0, 0, 1}) * glm::dvec4(vector, 0));
    };
    std::vector<glm::dmat4> places;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 along = turned(i, {1, 0, 0.2});
        const glm::dvec3 across = 0.1 * turned(i + 1, {1, 0, 0.2});
        places.emplace_back(glm::dvec4(along, 0), glm::dvec4(across, 0), glm::dvec4(glm::cross(along, across), 0),
                            glm::dvec4(turned(i, {0, 0.4, 0}) - glm::dvec3(0, 0, 10), 1));
    }
    const auto stochastic = [](const std::vector<bool>& choices) { return std::ranges::count(choices, true); };
    EXPECT_EQ(stochastic(choicesFor(places)), 1);
    places.pop_back();
    EXPECT_EQ(stochastic(choicesFor(places)), 0);
}

}  // namespace
}  // namespace defocus::engine
