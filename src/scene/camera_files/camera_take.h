#pragma once
// Samples of a camera over time, to be written to a file.

#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera_track.h"

namespace defocus::engine {

struct CameraSample {
    double time = 0;                  // time of the sample in s
    glm::dmat4 worldFromCamera{1.0};  // rigid transform in m, y up
    double nearPlane = 0.01;          // depth of the near plane, m
    // Lens values by their names in lens/lens_fields.h; focalLength and horizontalAperture give the field of view.
    std::map<std::string, double, std::less<>> lens;
};

struct CameraTake {
    std::string name;
    double aspect = 1;      // width / height of the image
    double frameRate = 24;  // frames per second; each sample is at the time of a frame
    std::vector<CameraSample> samples;
    std::optional<ShutterInterval> shutter;
};

// Returns a lens value of a sample, or `otherwise` if the sample lacks the value.
double lensValueOf(const CameraSample& sample, std::string_view name, double otherwise);

// Returns the tangent of half the horizontal field of view.
double tanHalfHorizontal(const CameraSample& sample);

// Returns the names of all lens values, sorted.
std::vector<std::string> lensNames(const CameraTake& take);

}  // namespace defocus::engine
