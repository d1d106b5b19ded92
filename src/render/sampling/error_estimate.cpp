// Sources of the exponents: Owen 1997, Scrambled Net Variance for Integrals of Smooth Functions; for edges Mitchell
// 1996, Consequences of Stratified Sampling in Graphics.

#include "render/sampling/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

constexpr double maxPixelsSeen = 1 << 20;

// Returns a hash of a tile's position, which selects one pixel of the tile. Random pixels avoid bias from regular
// patterns.
std::uint32_t tileHash(std::uint32_t x, std::uint32_t y) {
    return fmix32(x * 0x9e3779b9u + y * 0x85ebca6bu + 1);
}

std::vector<float> encodedPixels(const ImageView& image) {
    const auto tile = static_cast<std::uint32_t>(
        std::max(1.0, std::ceil(std::sqrt(static_cast<double>(image.width) * image.height / maxPixelsSeen))));
    const auto across = static_cast<std::uint32_t>(image.width);
    const auto down = static_cast<std::uint32_t>(image.height);
    const std::uint32_t columns = (across + tile - 1) / tile;
    const std::uint32_t rows = (down + tile - 1) / tile;
    std::vector<float> encoded(std::size_t{3} * columns * rows);
    parallelFor(rows, [&](std::size_t row) {
        const auto r = static_cast<std::uint32_t>(row);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t hash = tileHash(column, r);
            const std::uint32_t x = std::min(column * tile + hash % tile, across - 1);
            const std::uint32_t y = std::min(r * tile + (hash >> 16) % tile, down - 1);
            const float* pixel = image.at(static_cast<int>(x), static_cast<int>(y));
            for (std::size_t c = 0; c < 3; ++c) encoded[3 * (row * columns + column) + c] = srgbEncode(pixel[c]);
        }
    });
    return encoded;
}

struct Differences {
    double meanSquare = 0;
    double meanAbsolute = 0;
};

Differences differences(const std::vector<float>& a, const std::vector<float>& b) {
    Differences sum;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = static_cast<double>(a[i]) - b[i];
        sum.meanSquare += difference * difference;
        sum.meanAbsolute += std::abs(difference);
    }
    const auto count = static_cast<double>(std::max<std::size_t>(a.size(), 1));
    return {sum.meanSquare / count, sum.meanAbsolute / count};
}

}  // namespace

double errorOverDifference(double m, double n, double exponent) {
    const auto squaredError = [exponent](double blocks) { return std::pow(blocks, -2 * exponent); };
    const double rest = n - m;
    const double common =
        (n * n * squaredError(n) - m * m * squaredError(m) - rest * rest * squaredError(rest)) / (2 * m * rest);
    const double stretches = squaredError(m) + squaredError(rest) - 2 * common;
    return std::sqrt(squaredError(n) / stretches) * n / rest;
}

double encodedDifference(const ImageView& a, const ImageView& b) {
    return std::sqrt(differences(encodedPixels(a), encodedPixels(b)).meanSquare);
}

void ErrorEstimate::add(const ImageView& mean, std::uint32_t samples) {
    if (!kept_.empty() && (mean.width != width_ || mean.height != height_))
        fail("error estimate: the image differs in size from the previous one");
    width_ = mean.width;
    height_ = mean.height;
    Kept latest{samples, encodedPixels(mean)};

    // Average the estimates from all earlier images with 25 to 75 % of the samples. If there is none, use the image
    // closest to 50 %.
    const auto share = [&](const Kept& kept) { return static_cast<double>(kept.samples) / samples; };
    Differences sum;
    int count = 0;
    const auto addFrom = [&](const Kept& kept) {
        const double factor = errorOverDifference(kept.samples, samples);
        const Differences difference = differences(kept.encoded, latest.encoded);
        sum.meanSquare += factor * factor * difference.meanSquare;
        sum.meanAbsolute += factor * difference.meanAbsolute;
        ++count;
    };
    for (const Kept& kept : kept_)
        if (share(kept) >= 0.25 && share(kept) <= 0.75) addFrom(kept);
    if (count == 0 && !kept_.empty()) {
        const auto fromHalf = [&](const Kept& kept) { return std::abs(std::log(2 * share(kept))); };
        addFrom(*std::ranges::min_element(kept_, {}, fromHalf));
    }
    if (count > 0) {
        error_ = std::sqrt(sum.meanSquare / count);
        flip_ = flipOverDifference * sum.meanAbsolute / count;
    }

    // Keep the images with which later images may be compared.
    kept_.push_back(std::move(latest));
    while (kept_.size() > 2 && kept_[1].samples <= samples / 4) kept_.erase(kept_.begin());
}

}  // namespace defocus::engine
