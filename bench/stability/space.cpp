// Tests scenes with extreme dimensions: scales, distances, depth ratios and surfaces that cross the camera plane.

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "image/metrics.h"
#include "image/moments.h"
#include "lod/pyramid/build_all.h"
#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

// Returns the RMSE between the image of a scene and its image after scaling both the scene and the lens by `scale`.
double scaleError(double scale) {
    const View view = boardView();
    BoardScene boards(view, threeBoards(view, 1.2, 5), glm::vec3(0.4f));
    const Image image = rendered(boards);
    for (Object& object : boards.world.pose.objects)
        object.worldFromObject = glm::scale(glm::dmat4(1), glm::dvec3(scale)) * object.worldFromObject;
    boards.view.lens.focusDistance *= scale;
    boards.view.lens.blurScale *= scale;
    boards.view.nearPlane *= scale;
    return compareImages(image, rendered(boards)).rmse;
}

// Returns the shift (px) of a board's centre in the image when scene and camera are both moved `distance` m away from
// the origin.
double distanceError(double distance) {
    const View view = boardView(192, 128);
    BoardScene boards(view, {squareAt(view, 2, 9, glm::vec3(1), {31.3, 17.7})});
    boards.settings.sampleCount = 256;
    const Moments moments = momentsOf(rendered(boards));
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), glm::dvec3(distance, -0.3 * distance, 0.7 * distance));
    boards.view.worldFromCamera = moved * boards.view.worldFromCamera;
    for (Object& object : boards.world.pose.objects) object.worldFromObject = moved * object.worldFromObject;
    const Moments far = momentsOf(rendered(boards));
    return std::hypot(far.mean.x - moments.mean.x, far.mean.y - moments.mean.y);
}

// Returns the max error (px) of the position in the image of a board's centre, for camera positions in steps of 0.5 mm.
// The board's vertices are `distance` m from its node's origin.
double ownDistanceError(double distance) {
    const View view = boardView(192, 128);
    BoardScene near(view, {squareAt(view, 2, 9, glm::vec3(1), {31.3, 17.7})});
    BoardScene far(view, {squareAt(view, 2, 9, glm::vec3(1), {31.3, 17.7})});
    glm::dmat4& worldFromObject = far.world.pose.objects[0].worldFromObject;
    // Offset in units of the mesh's coordinates. As integers up to 2²³, they keep the coordinates exact in floats.
    const glm::vec3 offset(
        glm::round(glm::vec3(distance / worldFromObject[0].x, -0.5 * distance / worldFromObject[1].y, 0)));
    for (glm::vec3& position : far.scene->meshes[0].vertices.positions) position += offset;
    far.world.pyramids = buildPyramids(far.scene->meshes);
    worldFromObject = glm::translate(worldFromObject, -glm::dvec3(offset));
    double largest = 0;
    for (int step = 0; step < 4; ++step) {
        for (BoardScene* boards : {&near, &far}) {
            boards->settings.sampleCount = 64;
            boards->view.worldFromCamera = glm::translate(glm::dmat4(1), glm::dvec3(5e-4 * step, 0, 0));
        }
        const Moments expected = momentsOf(rendered(near));
        const Moments moments = momentsOf(rendered(far));
        largest = std::max(largest, std::hypot(moments.mean.x - expected.mean.x, moments.mean.y - expected.mean.y));
    }
    return largest;
}

// Returns the max difference between the images of two floors: one begins behind the camera, the other at the near
// plane.
double cameraPlaneError() {
    const View view = boardView();
    const auto floorFrom = [&](double nearest) {
        BoardScene boards(view, {{2, {0, 0}, {30, 1}, {0.7f, 0.5f, 0.2f}}}, glm::vec3(0.1f, 0.2f, 0.4f));
        const double length = 40 - nearest;
        glm::dmat4 lying = glm::translate(glm::dmat4(1), glm::dvec3(0, -0.4, -nearest - 0.5 * length));
        lying = glm::rotate(lying, -std::acos(-1.0) / 2, glm::dvec3(1, 0, 0));
        boards.world.pose.objects[0].worldFromObject = glm::scale(lying, glm::dvec3(30, 0.5 * length, 1));
        return rendered(boards);
    };
    return largestError(floorFrom(-25), floorFrom(view.nearPlane));
}

// Returns the max error of an image of three sharp boards at 0.02 m, 1,990 km and 2,000 km. Each board must hide the
// boards behind it.
double depthRatioError() {
    View view = boardView();
    view.lens.dofEnabled = false;
    const glm::vec3 near(0.9f, 0.1f, 0.1f);
    const glm::vec3 middle(0.1f, 0.9f, 0.1f);
    const glm::vec3 far(0.1f, 0.1f, 0.9f);
    BoardScene boards(
        view, {squareAt(view, 2e6, 90, far), squareAt(view, 1.99e6, 40, middle), squareAt(view, 0.02, 12, near)});
    const Image image = rendered(boards);
    double largest = 0;
    const auto expect = [&](int x, const glm::vec3& color) {
        for (int c = 0; c < 3; ++c) largest = std::max<double>(largest, std::abs(image.at(x, 32)[c] - color[c]));
    };
    expect(48, near);
    expect(48 + 15, middle);
    expect(48 + 35, far);
    return largest;
}

// Returns the errors of the blur diameter and the position of the light at `depth`. The scene has a red light at 0.02 m
// and a blue light at 2,000 km, both blurred.
BlurredLight lightAt(double depth) {
    View view = boardView(192, 128);
    view.lens.focusDistance = 0.035;
    setBlur(view, 2e6, 24);
    const glm::dvec2 nearPlace(-50.3, 30.7);
    const glm::dvec2 farPlace(45.3, -20.7);
    BoardScene boards(view,
                      {squareAt(view, 0.02, 3, {8, 0, 0}, nearPlace), squareAt(view, 2e6, 3, {0, 0, 8}, farPlace)});
    boards.settings.sampleCount = 1024;
    const bool near = depth < 1;
    const LightPlace light{.depth = depth, .offset = near ? nearPlace : farPlace, .channel = near ? 0 : 2};
    return blurredLight(rendered(boards), view, light);
}

}  // namespace

void addSpaceCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back({"space", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    for (const double scale : {1e-4, 1e-2, 1e3, 1e6})
        add(fmt::format("everything {:g} times as large", scale), "RMSE", "the scene at scale 1", 1e-3,
            [scale] { return scaleError(scale); });
    for (const double distance : {1e4, 1e7})
        add(fmt::format("scene and camera {:g} m from the origin", distance), "place, px", "the scene at the origin",
            0.1, [distance] { return distanceError(distance); });
    for (const double distance : {17e3, 1e5})
        add(fmt::format("a board {:g} m from its node's origin", distance), "place, px", "the board at its origin",
            0.01, [distance] { return ownDistanceError(distance); });
    add("a floor through the camera plane (w reaches 0)", "largest difference", "clipped at the near plane", 2e-3,
        cameraPlaneError);
    add("depths of 0.02 m, 1,990 km and 2,000 km", "largest error", "the nearest board", 1e-3, depthRatioError);
    for (const double depth : {0.02, 2e6})
        add(fmt::format("lights at 0.02 m and 2,000 km: the light at {:g} m", depth), "disk diameter, px",
            "closed form", 0.5, [depth] { return lightAt(depth).diameterError; });
    for (const double depth : {0.02, 2e6})
        add(fmt::format("lights at 0.02 m and 2,000 km: the light at {:g} m", depth), "place, px", "closed form", 0.1,
            [depth] { return lightAt(depth).placeError; });
}

}  // namespace defocus::engine
