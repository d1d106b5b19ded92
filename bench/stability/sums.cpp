// Tests the accuracy of sums over many samples, and the rounding of the renderer's layer formats.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double sumLimit = 1e-6;              // max relative error of the renderer's sum of samples
constexpr double halfLimit = 0x1p-11 * 1.001;  // max relative rounding error of a half float
constexpr double comparison = std::numeric_limits<double>::infinity();

const RendererOptions exactLayers = {
    .layerFormat = LayerFormat::rgba32f, .wave = 0, .shaderFolder = {}, .settings = {}};

// Renders a wall of uniform radiance as an image of 12 × 8 px; blur doesn't change this image.
Image wall(const glm::vec3& radiance, std::uint32_t samples, const RendererOptions& options) {
    BoardScene boards(boardView(12, 8), {{4, {0, 0}, {40, 40}, radiance}});
    boards.settings.sampleCount = samples;
    return rendered(boards, "accumulation", options);
}

double largestRelativeError(const Image& image, const glm::dvec3& reference) {
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(double(image.at(x, y)[c]) - reference[c]) / reference[c];
                largest = std::isnan(error) ? comparison : std::max(largest, error);
            }
    return largest;
}

// Returns the relative error of the renderer's sum of equal values. 32-bit layers store the value exactly, so the error
// comes only from summation.
double constantError(float value, std::uint32_t samples) {
    return largestRelativeError(wall(glm::vec3(value), samples, exactLayers), glm::dvec3(value));
}

// Returns the relative error of a plain float sum, without compensation of rounding errors. Batches of `wave` samples
// are summed first.
double plainError(float value, std::uint32_t samples, std::uint32_t wave) {
    float sum = 0;
    for (std::uint32_t i = 0; i < samples; i += wave) {
        float part = 0;
        for (std::uint32_t k = 0; k < wave; ++k) part += value;
        sum += part;
    }
    return std::abs(static_cast<double>(sum / static_cast<float>(samples)) / value - 1);
}

// Returns the max relative error of an image's pixels. The image shows a light of radiance 10,000 that is blurred over
// a background of radiance 0.0001. The reference draws each sample separately and sums the samples in double precision.
double mixedError() {
    constexpr std::uint32_t samples = 300;
    View view = boardView(24, 16);
    setBlur(view, 6, 9);
    BoardScene boards(view, {squareAt(view, 6, 2, glm::vec3(1e4f, 1, 1e-4f))}, glm::vec3(1e-4f));
    const auto scene = [&](std::uint32_t first, std::uint32_t count) {
        boards.settings.sampleCount = count;
        boards.settings.firstSample = first;
        return rendered(boards, "accumulation", exactLayers);
    };
    const Image image = scene(0, samples);
    std::vector<double> sums(image.pixels.size());
    for (std::uint32_t i = 0; i < samples; ++i) {
        const Image layer = scene(i, 1);
        for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += layer.pixels[p];
    }
    double largest = 0;
    for (std::size_t p = 0; p < sums.size(); ++p)
        largest = std::max(largest, std::abs(image.pixels[p] / (sums[p] / samples) - 1));
    return largest;
}

}  // namespace

void addSumCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back({"sums", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    const char* relative = "relative error";
    for (const std::uint32_t samples : {1u, 2u, 3u, 61u, 127u, 4096u, 65'536u})
        add(fmt::format("{} samples of 0.1", samples), relative, "double sum", sumLimit,
            [samples] { return constantError(0.1f, samples); });
    for (const float value : {0.3f, 0.7f, 1.0f / 3, 1e4f, 1e-4f})
        add(fmt::format("4,096 samples of {:.4g}", value), relative, "double sum", sumLimit,
            [value] { return constantError(value, 4096); });
    add("65,536 samples of 0.1, plain 32-bit sum", relative, "double sum", comparison,
        [] { return plainError(0.1f, 65'536, 1); });
    add("65,536 samples of 0.1, 32-bit sums in waves of 8", relative, "double sum", comparison,
        [] { return plainError(0.1f, 65'536, 8); });
    add("a pixel with samples of 10,000 and 0.0001", relative, "double sum", sumLimit, mixedError);
    for (const float value : {0.1f, 0.3f, 0.7f, 1.0f / 3})
        add(fmt::format("half-float layers with the value {:.4g}", value), relative, "the value", halfLimit, [value] {
            return largestRelativeError(
                wall(glm::vec3(value), 64, {.layerFormat = LayerFormat::rgba16f, .shaderFolder = {}, .settings = {}}),
                glm::dvec3(value));
        });
    add("radiance of 1,000,000 (beyond the range of half floats)", relative, "the value", sumLimit,
        [] { return largestRelativeError(wall(glm::vec3(1e6f), 64, {}), glm::dvec3(1e6)); });
    for (const std::uint32_t wave : {1u, 7u, 64u})
        add(fmt::format("100 samples in waves of {}", wave), "pixels that differ", "waves of 8", 0, [wave] {
            BoardScene boards(
                boardView(),
                {{1.2, {-0.1, 0}, {0.1, 0.1}, {0.9f, 0.2f, 0.1f}}, {5, {0, 0}, {0.7, 0.5}, {0.1f, 0.5f, 0.9f}}},
                glm::vec3(0.3f));
            boards.settings.sampleCount = 100;
            const Image one = rendered(boards, "accumulation", {.wave = 8, .shaderFolder = {}, .settings = {}});
            const Image other = rendered(boards, "accumulation", {.wave = wave, .shaderFolder = {}, .settings = {}});
            double differing = 0;
            for (std::size_t i = 0; i < one.pixels.size(); ++i) differing += one.pixels[i] != other.pixels[i] ? 1 : 0;
            return differing;
        });
}

}  // namespace defocus::engine
