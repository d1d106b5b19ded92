// Source: Welford 1986, Aberrations of Optical Systems.

#include "lens/aberrations.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace defocus::engine {

double comaOfTail(double length) {
    return 2 * length / 3;
}

glm::dvec2 aberration(const ClipCircleOfConfusion& coc, const glm::dvec2& ndc, const glm::dvec2& lensPoint) {
    const glm::dvec2 field(ndc.x, ndc.y / coc.aspect);
    const double along = glm::dot(field, lensPoint);
    return coc.astigmatism * along * field +
           coc.coma * (2 * along * lensPoint + glm::dot(lensPoint, lensPoint) * field);
}

double aberrationReach(const ClipCircleOfConfusion& coc, double radius) {
    if (!coc.aberrates()) return 0;
    return std::abs(coc.astigmatism) * radius * radius + 3 * std::abs(coc.coma) * radius;
}

}  // namespace defocus::engine
