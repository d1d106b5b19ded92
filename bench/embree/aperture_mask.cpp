#include "embree/aperture_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/error.h"
#include "embree/lens_rays.h"

namespace defocus::engine {

namespace {

constexpr double minLight = 1.0 / 500;

double luminance(const Image& image, int x, int y) {
    const float* pixel = image.at(x, y);
    if (image.channels < 3) return static_cast<double>(pixel[0]);
    return 0.2126 * static_cast<double>(pixel[0]) + 0.7152 * static_cast<double>(pixel[1]) +
           0.0722 * static_cast<double>(pixel[2]);
}

}  // namespace

bool ApertureMask::isNeeded(const Lens& lens) {
    return lens.apertureImage || lens.obstruction > 0 || lens.sphericalAberration != 0 ||
           (lens.bladeCount > 0 && lens.bladeCurvature > 0);
}

ApertureMask::ApertureMask(const Lens& lens) : lens_(lens) {
    if (lens_.apertureImage) {
        brightest_ = 0;
        for (int y = 0; y < lens_.apertureImage->height; ++y)
            for (int x = 0; x < lens_.apertureImage->width; ++x)
                brightest_ = std::max(brightest_, luminance(*lens_.apertureImage, x, y));
    }
    constexpr int size = 512;
    double light = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 point(2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1);
            if (glm::dot(point, point) <= 1) light += at(point) / (size * size * std::numbers::pi / 4);
        }
    if (!(light >= minLight))
        fail("method embree: the aperture lets {:.2g} of the light through; its rays need {}", light, minLight);
}

double ApertureMask::imageAt(const glm::dvec2& point) const {
    const Image& image = *lens_.apertureImage;
    const double scale = 0.5 * std::max(image.width, image.height);  // px per lens radius
    const auto x = static_cast<int>(std::floor(0.5 * image.width + scale * point.x));
    const auto y = static_cast<int>(std::floor(0.5 * image.height - scale * point.y));
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return 0;
    return luminance(image, x, y) / brightest_;
}

double ApertureMask::at(const glm::dvec2& point) const {
    if (lens_.apertureImage) return imageAt(point);
    double edge = 1;  // radius of the aperture's edge in the direction of `point`
    if (lens_.bladeCount > 0) {
        const double half = std::numbers::pi / lens_.bladeCount;
        const double fromCorner = std::fmod(std::atan2(point.y, point.x) + 4 * std::numbers::pi, 2 * half);
        edge += (1 - lens_.bladeCurvature) * (std::cos(half) / std::cos(fromCorner - half) - 1);
    }
    const double area = glm::dot(point, point) / (edge * edge);
    const double hidden = lens_.obstruction * lens_.obstruction;
    if (area > 1 || area < hidden) return 0;
    const double nearer = (area - hidden) / (1 - hidden);  // fraction of the open area nearer the centre than `point`
    return (1 + lens_.sphericalAberration * (2 * nearer - 1)) / (1 + std::abs(lens_.sphericalAberration));
}

glm::dvec2 ApertureMask::lensPoint(std::uint32_t index, std::uint32_t stream, std::uint32_t seed) const {
    const Lens disk;
    glm::dvec2 point(0);
    for (std::uint32_t attempt = 0;; ++attempt) {
        const std::uint32_t salt = seed + 0x9e3779b9u * attempt;
        point = aperturePoint(disk, scrambledPoint(index, stream, SamplePair::lens, salt));
        if (scrambledPoint(index, stream, SamplePair::pixel, ~salt).x < at(point)) break;
    }
    const double c = std::cos(lens_.bladeRotation);
    const double s = std::sin(lens_.bladeRotation);
    point = {c * point.x - s * point.y, s * point.x + c * point.y};
    return {point.x / std::max(lens_.anamorphicRatio, 1.0), point.y * std::min(lens_.anamorphicRatio, 1.0)};
}

}  // namespace defocus::engine
