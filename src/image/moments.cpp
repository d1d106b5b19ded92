#include "image/moments.h"

#include <cmath>
#include <numbers>

namespace defocus::engine {

Moments momentsOf(const Image& image) {
    Moments moments;
    glm::dvec2 square(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double value = *image.at(x, y);
            const glm::dvec2 place(x + 0.5, y + 0.5);
            moments.energy += value;
            moments.mean += value * place;
            square += value * place * place;
        }
    moments.mean /= moments.energy;
    moments.variance = square / moments.energy - moments.mean * moments.mean;
    return moments;
}

double radiusBySecondMoment(const Moments& moments, int bladeCount, double square) {
    const double spread = moments.variance.x + moments.variance.y - 2 * (square * square + 1) / 12;
    const double corners = bladeCount == 0 ? 1.0 : std::cos(2 * std::numbers::pi / bladeCount);
    return std::sqrt(spread * 6 / (2 + corners));
}

}  // namespace defocus::engine
