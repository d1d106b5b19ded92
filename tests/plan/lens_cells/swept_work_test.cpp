// Tests the number of pixels that a triangle's screen bounds cover over all points of the lens, against closed forms.

#include "plan/lens_cells/swept_work.h"

#include <gtest/gtest.h>

#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns a square of 6 × 6 px in the middle of an image of 100 × 80 px, at a depth of 4 m.
std::unique_ptr<SmallWorld> smallSquare(bool turned) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.meshes.push_back(quad(-1));
    small->view.width = 100;
    small->view.height = 80;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    const double pixel = 2 * tanHalfHorizontalFov(small->view.lens) * 4 / 100;
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4));
    if (turned) matrix = glm::rotate(matrix, std::numbers::pi, glm::dvec3(0, 1, 0));
    place(*small, 0, glm::scale(matrix, glm::dvec3(3 * pixel)));
    finish(*small);
    return small;
}

Image sweptOf(const SmallWorld& small) {
    const RenderSettings settings{.keepAll = true};
    return sweptWork(planFrame(small.world, small.view, settings), small.world);
}

double sumOf(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += static_cast<double>(value);
    return sum;
}

// Expects each of the square's two triangles to have screen bounds of `side` × `side` px.
void expectSide(const SmallWorld& small, int side) {
    const Image image = sweptOf(small);
    EXPECT_EQ(sumOf(image), 2.0 * side * side);
    EXPECT_EQ(*image.at(50, 40), 2);
    EXPECT_EQ(*image.at(50 - side / 2, 40 - side / 2), 2);
    EXPECT_EQ(*image.at(50 + side / 2, 40), 0);
}

TEST(SweptWork, coversTheSquareAndItsBlurOnAllSides) {
    const auto small = smallSquare(false);
    small->view.lens.dofEnabled = false;
    expectSide(*small, 6);
    small->view.lens.dofEnabled = true;
    // The blur extends the square by 4.1 px on each side, so its bounds cover five more pixels there: 6 + 2·5 = 16.
    small->view.lens.blurScale = 8.2 / (0.05 * (1.0 / 2 - 1.0 / 4) * 100 / 0.72);
    expectSide(*small, 16);
    small->view.lens.backgroundLimit = 2.2;
    expectSide(*small, 10);
}

TEST(SweptWork, countsWhatAnySampleMayShow) {
    const auto small = smallSquare(false);
    small->view.lens.dofEnabled = false;
    small->world.shutter.poses.assign(2, small->world.pose);
    const double pixel = 2 * tanHalfHorizontalFov(small->view.lens) * 4 / 100;
    small->world.shutter.poses[1].objects[0].worldFromObject[3].x += 10 * pixel;
    EXPECT_EQ(sumOf(sweptOf(*small)), 2.0 * 16 * 6);
}

TEST(SweptWork, backsCountWhereTheyShow) {
    EXPECT_EQ(sumOf(sweptOf(*smallSquare(true))), 0);
    const auto small = smallSquare(true);
    Material material{.doubleSided = true};
    small->scene.materials.push_back(material);
    small->scene.meshes[0].primitives[0].material = 0;
    EXPECT_GT(sumOf(sweptOf(*small)), 0);
}

}  // namespace
}  // namespace defocus::engine
