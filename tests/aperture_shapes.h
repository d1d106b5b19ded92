#pragma once
// Computes reference aperture shapes and their light distributions from the definitions of the lens values. Tests
// compare aperture maps, the rasterizer and the ray tracer with these references.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <numbers>

#include "lens/lens.h"

namespace defocus::engine {

// Returns the radius of the aperture polygon in the direction of `p`, including the curvature of the blades. The first
// corner lies at the angle Lens::bladeRotation.
inline double edgeTowards(const Lens& lens, const glm::dvec2& p) {
    if (lens.bladeCount == 0) return 1;
    const double width = 2 * std::numbers::pi / lens.bladeCount;
    const double angle = std::atan2(p.y, p.x) - lens.bladeRotation;
    const double fromMiddle = angle - (std::floor(angle / width) + 0.5) * width;
    const double chord = std::cos(width / 2) / std::cos(fromMiddle);
    return (1 - lens.bladeCurvature) * chord + lens.bladeCurvature;
}

// Returns the light density, in arbitrary units, at a point p of the lens.
inline double lightDensity(const Lens& lens, glm::dvec2 p) {
    p.x *= std::max(lens.anamorphicRatio, 1.0);
    p.y /= std::min(lens.anamorphicRatio, 1.0);
    // Fraction of the aperture's area that lies inside a copy of its outline, scaled to pass through p.
    const double area = glm::dot(p, p) / std::pow(edgeTowards(lens, p), 2);
    const double hidden = lens.obstruction * lens.obstruction;
    if (area > 1 || area < hidden) return 0;
    return 1 + lens.sphericalAberration * (2 * (area - hidden) / (1 - hidden) - 1);
}

struct ApertureShape {
    const char* name;
    int blades = 0;
    double rotation = 0;
    double curvature = 0;
    double ratio = 1;
    double obstruction = 0;
    double aberration = 0;

    [[nodiscard]] Lens lens(Lens lens = {}) const {
        lens.bladeCount = blades;
        lens.bladeRotation = rotation;
        lens.bladeCurvature = curvature;
        lens.anamorphicRatio = ratio;
        lens.obstruction = obstruction;
        lens.sphericalAberration = aberration;
        return lens;
    }
};

inline const ApertureShape apertureShapes[] = {
    {.name = "disk"},
    {.name = "triangle", .blades = 3, .rotation = 0.2},
    {.name = "pentagon", .blades = 5, .rotation = -2},
    {.name = "curvedTriangle", .blades = 3, .rotation = 0.2, .curvature = 0.5},
    {.name = "curvedHexagon", .blades = 6, .curvature = 0.7},
    {.name = "sixtyFourBlades", .blades = 64},
    {.name = "fullyCurvedIsADisk", .blades = 7, .curvature = 1},
    {.name = "tallOval", .ratio = 2},
    {.name = "wideHexagon", .blades = 6, .rotation = 0.3, .ratio = 0.5},
    {.name = "ring", .obstruction = 0.5},
    {.name = "thinRing", .obstruction = 0.9},
    {.name = "pentagonalRing", .blades = 5, .rotation = 1, .curvature = 0.3, .obstruction = 0.4},
    {.name = "soapBubble", .aberration = 1},
    {.name = "creamy", .aberration = -1},
    {.name = "slightBubbleOfBlades", .blades = 8, .rotation = 0.1, .aberration = 0.6},
    {.name = "creamyRing", .obstruction = 0.6, .aberration = -0.7},
};

// Returns the value of the aperture image's pixel at a point of the lens; 0 outside the unit disk.
inline double apertureImageAt(const Image& image, const glm::dvec2& p) {
    const double half = 0.5 * std::max(image.width, image.height);
    const int x = static_cast<int>(std::floor(p.x * half + 0.5 * image.width));
    const int y = static_cast<int>(std::floor(0.5 * image.height - p.y * half));
    if (glm::dot(p, p) > 1 || x < 0 || y < 0 || x >= image.width || y >= image.height) return 0;
    return *image.at(x, y);
}

// Returns a function of the lens position that gives the light density: the value of the aperture image if the lens has
// one, else lightDensity(). Blade rotation and anamorphic ratio do not apply to the image.
inline auto lightOf(const Lens& lens) {
    return [lens](const glm::dvec2& p) {
        return lens.apertureImage ? apertureImageAt(*lens.apertureImage, p) : lightDensity(lens, p);
    };
}

// Returns an aperture image that is wider than tall, with black parts, a black last row and values far above 1.
inline Image lopsidedImage() {
    Image image(9, 5, 1);
    const char* const rows[] = {"001230000", "000450021", "090002112", "003300220", "000000000"};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) *image.at(x, y) = static_cast<float>(rows[y][x] - '0');
    return image;
}

}  // namespace defocus::engine
