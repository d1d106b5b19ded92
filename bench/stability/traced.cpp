// Compares the rasteriser with the ray tracer on extreme scenes. Both use the same points on the lens and in the pixel,
// so that only geometry and visibility can differ.

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "image/metrics.h"
#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr const char* rayTracer = "embree-planned";

struct TracedCase {
    std::string name;
    double fStop = 1;
    double focusDistance = 2;  // m
    double fieldOfView = 40;   // degrees
    double nearest = 1.2;      // depth of the nearest board, m
    double farthest = 7;       // depth of the farthest board, m
    double fromOrigin = 0;     // distance of scene and camera from the origin, m
};

// Returns the RMSE between rasteriser and ray tracer for three boards that partly hide each other. They lie in front
// of, in and behind the focus plane.
double tracedError(const TracedCase& subject) {
    View view = boardView();
    view.lens.focalLength = view.lens.horizontalAperture / (2 * std::tan(glm::radians(0.5 * subject.fieldOfView)));
    view.lens.fStop = subject.fStop;
    view.lens.focusDistance = subject.focusDistance;
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), subject.fromOrigin * glm::dvec3(1, -0.3, 0.7));
    BoardScene boards(view, threeBoards(view, subject.nearest, subject.farthest), glm::vec3(0.4f));
    boards.view.worldFromCamera = moved * boards.view.worldFromCamera;
    for (Object& object : boards.world.pose.objects) object.worldFromObject = moved * object.worldFromObject;
    return compareImages(rendered(boards), rendered(boards, rayTracer)).rmse;
}

}  // namespace

void addTracedCases(std::vector<StabilityCase>& cases) {
    for (const TracedCase& subject : {
             TracedCase{.name = "three boards at f/0.1", .fStop = 0.1},
             TracedCase{.name = "three boards, focus at infinity", .fStop = 0.7, .focusDistance = infinite},
             TracedCase{.name = "three boards, focus at 0.06 m: blur wider than the image",
             .fStop = 0.7,
             .focusDistance = 0.06},
             TracedCase{.name = "three boards, 0.02 m to 2,000 km", .fStop = 20, .nearest = 0.02, .farthest = 2e6},
             TracedCase{.name = "three boards, 1 degree", .fStop = 50, .fieldOfView = 1},
             TracedCase{.name = "three boards, 170 degrees", .fStop = 0.02, .fieldOfView = 170},
             TracedCase{.name = "three boards 1e+07 m from the origin", .fromOrigin = 1e7},
         })
        cases.push_back({.area = "traced",
                         .name = subject.name,
                         .measured = "RMSE",
                         .reference = "ray tracer, same lens points",
                         .limit = 1e-3,
                         .error = [subject] { return tracedError(subject); },
                         .method = rayTracer});
}

}  // namespace defocus::engine
