#include "plan/motion/camera_path.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"

namespace defocus::engine {

glm::dmat4 lookingAt(const glm::dvec3& position, const glm::dvec3& target) {
    const glm::dvec3 backward = position - target;
    const double distance = glm::length(backward);
    if (!(distance > 0) || !std::isfinite(distance))
        fail("the camera's position and target are the same point; move one of them");
    const glm::dvec3 z = backward / distance;
    glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), z);
    if (glm::length(x) < 1e-9) x = glm::cross(glm::dvec3(0, 0, z.y > 0 ? -1 : 1), z);
    x = glm::normalize(x);
    const glm::dvec3 y = glm::cross(z, x);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

View dollied(const View& view, double forward) {
    View result = view;
    result.worldFromCamera = glm::translate(view.worldFromCamera, glm::dvec3(0, 0, -forward));
    return result;
}

View carriedAround(const View& view, const glm::dvec3& centre, double angle) {
    glm::dmat4 turn = glm::translate(glm::dmat4(1), centre);
    turn = glm::rotate(turn, angle, glm::dvec3(0, 1, 0));
    View result = view;
    result.worldFromCamera = glm::translate(turn, -centre) * view.worldFromCamera;
    return result;
}

double focusBetween(double from, double to, double place) {
    return 1 / ((1 - place) / from + place / to);
}

}  // namespace defocus::engine
