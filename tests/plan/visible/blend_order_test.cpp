// Tests of the choice between sorting and stochastic transparency.
#include "plan/visible/blend_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns a closed cone around the z axis with its base at z = 0; its fronts face outwards unless `inwards`.
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
    const auto isConvexMesh = [](const Mesh& mesh) { return isConvex(mesh.vertices, mesh.primitives[0]); };
    EXPECT_TRUE(isConvexMesh(quad(0)));
    EXPECT_TRUE(isConvexMesh(coneMesh(20, false)));
    EXPECT_FALSE(isConvexMesh(coneMesh(20, true)));
    EXPECT_FALSE(isConvexMesh(bumpySphere(16, 8, 0)));
    Mesh dented = coneMesh(20, false);
    dented.vertices.positions[20].z = 0.1f;
    EXPECT_FALSE(isConvexMesh(dented));
}

// Returns whether each of the panes, at the given places, is drawn by stochastic transparency.
std::vector<bool> choicesFor(const std::vector<glm::dmat4>& places) {
    SmallWorld small;
    small.scene.materials.push_back(unlitMaterial({1, 1, 1, 0.5f}));
    small.scene.materials[0].alphaMode = AlphaMode::blend;
    small.scene.meshes.push_back(quad(0));
    for (const glm::dmat4& worldFromObject : places) place(small, 0, worldFromObject);
    finish(small);
    const FramePlan plan = planFrame(small.world, small.view, {});
    std::vector<bool> choices(places.size());
    for (const ObjectPlan& object : plan.objects) {
        EXPECT_TRUE(object.blended);
        choices[static_cast<std::size_t>(object.object)] = object.stochasticAlpha;
    }
    return choices;
}

TEST(BlendOrder, panesAreSortedUnlessTheyMayCross) {
    const auto at = [](double x, double z, double degrees) {
        return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z)), glm::radians(degrees),
                           glm::dvec3(0, 1, 0));
    };
    using Choices = std::vector<bool>;
    EXPECT_EQ(choicesFor({at(0, -10, 40)}), Choices{false});
    EXPECT_EQ(choicesFor({at(0, -10, 40), at(0.5, -12, 40)}), (Choices{false, false})) << "behind each other";
    EXPECT_EQ(choicesFor({at(-2, -10, 40), at(2, -10, 30)}), (Choices{false, false})) << "side by side";
    const Choices crossing = choicesFor({at(0, -10, 40), at(0, -10, -40)});
    EXPECT_EQ(std::ranges::count(crossing, true), 1) << "crossing";
}

}  // namespace
}  // namespace defocus::engine
