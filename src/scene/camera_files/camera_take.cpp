#include "scene/camera_files/camera_take.h"

#include <set>

namespace defocus::engine {

double lensValueOf(const CameraSample& sample, std::string_view name, double otherwise) {
    const auto found = sample.lens.find(name);
    return found == sample.lens.end() ? otherwise : found->second;
}

double tanHalfHorizontal(const CameraSample& sample) {
    return lensValueOf(sample, "horizontalAperture", 36) / (2 * lensValueOf(sample, "focalLength", 50));
}

std::vector<std::string> lensNames(const CameraTake& take) {
    std::set<std::string> names;
    for (const CameraSample& sample : take.samples)
        for (const auto& [name, value] : sample.lens) names.insert(name);
    return {names.begin(), names.end()};
}

}  // namespace defocus::engine
