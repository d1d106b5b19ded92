#include "plan/camera_path.h"

#include <glm/gtc/matrix_transform.hpp>

namespace defocus {

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

}  // namespace defocus
