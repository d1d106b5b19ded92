#include "embree/lens_rays.h"

#include <cmath>
#include <numbers>

#include "embree/sample_scramble.h"

namespace defocus::engine {

namespace {

constexpr double fullTurn = 2 * std::numbers::pi;

// Returns a 32-bit hash of (value, salt): two rounds of multiply and shift.
std::uint32_t mixed(std::uint32_t value, std::uint32_t salt) {
    std::uint64_t x = (static_cast<std::uint64_t>(salt) << 32 | value) + 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return static_cast<std::uint32_t>((x ^ (x >> 31)) >> 16);
}

// Returns the second dimension of point `index` of Sobol's sequence as a 32-bit fraction (Kollig and Keller 2002). The
// first dimension is the bit-reversed index.
std::uint32_t sobolSecond(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1) {
        if ((index & 1u) != 0) result ^= v;
    }
    return result;
}

}  // namespace

LensCamera lensCamera(const View& view) {
    const Lens& lens = view.lens;
    const double focal = lens.focalLength / 1000;
    LensCamera camera;
    camera.tanHalfHorizontal = lens.horizontalAperture / (2 * lens.focalLength);
    camera.reciprocalFocus = 1 / lens.focusDistance;
    // With focus breathing, the sensor is at the image distance s·f/(s − f) of a thin lens with focal length f and
    // focus distance s, instead of at f.
    if (lens.focusBreathing) camera.tanHalfHorizontal *= 1 - focal * camera.reciprocalFocus;
    camera.tanHalfVertical = camera.tanHalfHorizontal * view.height / view.width;
    if (lens.dofEnabled) camera.lensRadius = 0.5 * lens.blurScale * focal / lens.fStop;
    if (std::isfinite(lens.foregroundLimit) && camera.lensRadius > 0) {
        camera.cone = lens.foregroundLimit * camera.tanHalfHorizontal / view.width;
        camera.lensDepth = 1 / (camera.reciprocalFocus + camera.cone / camera.lensRadius);
    }
    return camera;
}

LensRay eyeRay(const LensCamera& camera, const glm::dvec2& image, const glm::dvec2& lens) {
    const glm::dvec2 axis(image.x * camera.tanHalfHorizontal, image.y * camera.tanHalfVertical);
    return {glm::vec3(0), glm::vec3(axis + camera.cone * lens, -1)};
}

LensRay refractedRay(const LensCamera& camera, const glm::dvec2& image, const LensRay& eye) {
    const glm::dvec2 axis(image.x * camera.tanHalfHorizontal, image.y * camera.tanHalfVertical);
    const glm::dvec2 slope(eye.direction.x, eye.direction.y);
    const double alpha = camera.lensDepth;
    const double reciprocalFocal = 1 / (alpha * (1 - alpha * camera.reciprocalFocus));  // inverse focal length 1/f
    const glm::dvec2 height = alpha * (slope - axis);
    return {glm::vec3(alpha * slope, -alpha), glm::vec3(slope - height * reciprocalFocal, -1)};
}

LensRay lensRay(const LensCamera& camera, const glm::dvec2& image, const glm::dvec2& lens) {
    const glm::dvec2 point = camera.lensRadius * lens;
    const glm::dvec2 slope(image.x * camera.tanHalfHorizontal - point.x * camera.reciprocalFocus,
                           image.y * camera.tanHalfVertical - point.y * camera.reciprocalFocus);
    return {glm::vec3(point, 0), glm::vec3(slope, -1)};
}

ReversedPoint unscrambledPoint(std::uint32_t index, std::uint32_t order, SamplePair pair, std::uint32_t seed) {
    // The lens and the pixel take the Sobol' points in different orders, so that their points aren't correlated. Owen
    // scrambling of the bit-reversed index permutes the points only within aligned blocks of 2^n points, so each block
    // remains a (0,2)-net.
    const std::uint32_t salt = mixed(mixed(seed, static_cast<std::uint32_t>(pair)), 1);
    const std::uint32_t shuffled = owenScrambled(reversedBits(index), mixed(order, salt));
    return {shuffled, reversedBits(sobolSecond(shuffled))};
}

ReversedPoint scrambleSeeds(std::uint32_t stream, SamplePair pair, std::uint32_t seed) {
    const std::uint32_t salt = mixed(stream, mixed(seed, static_cast<std::uint32_t>(pair)));
    return {mixed(salt, 2), mixed(salt, 3)};
}

glm::dvec2 scrambledPoint(std::uint32_t index, std::uint32_t stream, SamplePair pair, std::uint32_t seed) {
    const ReversedPoint point = unscrambledPoint(index, stream % orderCount, pair, seed);
    const ReversedPoint own = scrambleSeeds(stream, pair, seed);
    return {owenScrambled(point.x, own.x) * 0x1p-32, owenScrambled(point.y, own.y) * 0x1p-32};
}

glm::dvec2 aperturePoint(const Lens& lens, const glm::dvec2& square) {
    glm::dvec2 point(0);
    const double radius = std::sqrt(square.x);
    if (lens.bladeCount < 3) {
        point = radius * glm::dvec2(std::cos(fullTurn * square.y), std::sin(fullTurn * square.y));
    } else {
        // The polygon is a fan of equal triangles: select a triangle, then a uniformly distributed point in it.
        const double turn = square.y * lens.bladeCount;
        const double blade = std::floor(turn);
        const double first = lens.bladeRotation + fullTurn * blade / lens.bladeCount;
        const double second = lens.bladeRotation + fullTurn * (blade + 1) / lens.bladeCount;
        const glm::dvec2 from(std::cos(first), std::sin(first));
        const glm::dvec2 to(std::cos(second), std::sin(second));
        point = radius * (from + (turn - blade) * (to - from));
    }
    if (lens.anamorphicRatio > 1) point.x /= lens.anamorphicRatio;
    if (lens.anamorphicRatio < 1) point.y *= lens.anamorphicRatio;
    return point;
}

}  // namespace defocus::engine
