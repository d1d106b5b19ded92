// Tests motion that a single straight segment between shutter opening and closing cannot represent.

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "lens/lens_samples.h"
#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr std::uint32_t movingSamples = 1024;
constexpr double halfSide = 8;  // half the side of the white square, px
constexpr double way = 40;      // length of the square's path in the image, px
constexpr double squareDepth = 4;

// Returns the matrix of a square at `time` in [0, 1] of the exposure. `middle` is the matrix that puts the square at
// the image's centre.
using Path = std::function<glm::dmat4(const glm::dmat4& middle, double time)>;

Image movedSquare(const Path& path, int segments) {  // number of segments of the path; 0: a pose per sample
    View view = boardView(128, 64);
    view.lens.dofEnabled = false;
    BoardScene square(view, {squareAt(view, squareDepth, 2 * halfSide, glm::vec3(1))});
    square.settings.sampleCount = movingSamples;
    std::vector<double> times;
    if (segments == 0)
        for (const LensSample& sample : lensSamples(view.lens, square.settings.sequence, 0, movingSamples, 0))
            times.push_back(static_cast<double>(sample.time));
    for (int i = 0; segments > 0 && i <= segments; ++i) times.push_back(static_cast<double>(i) / segments);
    const glm::dmat4 middle = square.world.pose.objects[0].worldFromObject;
    square.world.shutter.perSample = segments == 0;
    square.world.shutter.poses.assign(times.size(), square.world.pose);
    for (std::size_t i = 0; i < times.size(); ++i)
        square.world.shutter.poses[i].objects[0].worldFromObject = path(middle, times[i]);
    return rendered(square);
}

// Returns a path on which a square moves back and forth `turns` times at constant speed.
Path toAndFro(int turns) {
    return [turns](const glm::dmat4& middle, double time) {
        const double phase = time * turns - std::floor(time * turns);
        const View view = boardView(128, 64);
        const double pixel = view.lens.horizontalAperture / view.lens.focalLength * squareDepth / view.width;  // m/px
        const double place = way * (0.5 - std::abs(2 * phase - 1));
        return glm::translate(glm::dmat4(1), glm::dvec3(pixel * place, 0, 0)) * middle;
    };
}

// Returns the max error of the image's middle row relative to the exact brightness of the moving square. Over x, this
// brightness is a trapezoid: the square covers a column while |x − position| < halfSide, and its position is uniformly
// distributed over the path.
double trapezoidError(const Image& image) {
    double largest = 0;
    for (int x = 0; x < image.width; ++x) {
        const double column = x + 0.5 - 0.5 * image.width;
        const double from = std::max((column - halfSide) / way + 0.5, 0.0);
        const double to = std::min((column + halfSide) / way + 0.5, 1.0);
        const double covered = static_cast<double>(image.at(x, image.height / 2)[0]);
        largest = std::max(largest, std::abs(covered - std::max(to - from, 0.0)));
    }
    return largest;
}

// Returns the RMSE between the image of a square that spins 20 turns about its centre and the exact image. In each
// turn, a point at radius r is outside each side of the square over an angle of 2·acos(halfSide/r).
double spinError() {
    const Image image = movedSquare(
        [](const glm::dmat4& middle, double time) {
            return glm::rotate(middle, 20 * 2 * std::numbers::pi * time, glm::dvec3(0, 0, 1));
        },
        0);
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double r = std::hypot(x + 0.5 - 0.5 * image.width, y + 0.5 - 0.5 * image.height);
            double covered = 1;
            if (r > halfSide) covered = 1 - 4 / std::numbers::pi * std::acos(halfSide / r);
            const double error = static_cast<double>(image.at(x, y)[0]) - std::max(covered, 0.0);
            sum += error * error;
        }
    return std::sqrt(sum / (static_cast<double>(image.width) * image.height));
}

// Returns how many values of the image lie outside [0, 1] if a square moves through the camera and back.
double throughCameraError() {
    const Image image = movedSquare(
        [](const glm::dmat4& middle, double time) {
            const double ahead = 2 * squareDepth * (1 - std::abs(2 * time - 1));
            return glm::translate(glm::dmat4(1), glm::dvec3(0, 0, ahead)) * middle;
        },
        2);
    double wrong = 0;
    for (const float value : image.pixels) wrong += !(value >= 0 && value <= 1.0001f);
    return wrong;
}

}  // namespace

void addMotionCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back(
            {"motion", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    const auto addPath = [&](std::string name, int turns, int segments, double limit) {
        add(std::move(name), "largest difference", "closed form", limit,
            [turns, segments] { return trapezoidError(movedSquare(toAndFro(turns), segments)); });
    };
    addPath("there and back, 2 segments", 1, 2, 0.02);
    addPath("there and back, one pose per sample", 1, 0, 0.02);
    addPath("20 times there and back, one pose per sample", 20, 0, 0.05);
    addPath("there and back, 1 segment (shows no motion)", 1, 1, infinite);
    add("20 turns, one pose per sample", "RMSE", "closed form", 0.02, spinError);
    add("through the camera and back", "pixel values outside [0, 1]", "finite light", 0, throughCameraError);
}

}  // namespace defocus::engine
