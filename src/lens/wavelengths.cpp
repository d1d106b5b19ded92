#include "lens/wavelengths.h"

namespace defocus::engine {

double chromaticShift(double a, double dioptres, double t) {
    return 3 * a * dioptres * (0.5 - t);
}

std::vector<glm::vec3> bandWeights(std::span<const LensSample> samples) {
    std::vector<glm::vec3> weights;
    weights.reserve(samples.size());
    glm::dvec3 sum(0);
    for (const LensSample& sample : samples) {
        const double t = sample.band;
        const glm::dvec3 weight(2 * (1 - t), 1.5 * (1 - (2 * t - 1) * (2 * t - 1)), 2 * t);
        sum += weight;
        weights.emplace_back(weight);
    }
    for (glm::vec3& weight : weights)
        weight = glm::vec3(glm::dvec3(weight) * (static_cast<double>(samples.size()) / sum));
    return weights;
}

}  // namespace defocus::engine
