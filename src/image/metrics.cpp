#include "image/metrics.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "image/comparable.h"
#include "image/separable_filter.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

// SSIM parameters of Wang et al. 2004, section III-C.
constexpr int windowRadius = 5;
constexpr double windowDeviation = 1.5;
constexpr double c1 = 0.01 * 0.01;
constexpr double c2 = 0.03 * 0.03;

using DoublePlane = Plane<double>;

struct ErrorSums {
    double absolute = 0;
    double squared = 0;
    double largest = -1;
    int largestColumn = 0;
    std::uint64_t pixels = 0;
    std::uint64_t nonFinite = 0;
};

bool counts(const Image* mask, int x, int y) {
    return mask == nullptr || *mask->at(x, y) > 0;
}

PixelState stateAt(const ComparablePair& pair, int x, int y) {
    return pair.state[static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.reference.width) +
                      static_cast<std::size_t>(x)];
}

// Sets MAE, RMSE, PSNR, the maximum error and the pixel counts of `difference`. Sums are formed per row and added in
// row order, so that the result does not depend on the number of cores.
void measureErrors(const ComparablePair& pair, const Image& displayA, const Image& displayB, const Image* mask,
                   Difference& difference) {
    std::vector<ErrorSums> rows(static_cast<std::size_t>(displayA.height));
    forEachRow(displayA.height, [&](int y) {
        ErrorSums& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < displayA.width; ++x) {
            if (!counts(mask, x, y)) continue;
            const PixelState state = stateAt(pair, x, y);
            ++row.pixels;
            if (state != PixelState::finite) ++row.nonFinite;
            for (int c = 0; c < 3; ++c) {
                const double error = state == PixelState::nonFiniteInOne
                                         ? 1.0
                                         : std::abs(double(displayA.at(x, y)[c]) - double(displayB.at(x, y)[c]));
                row.absolute += error;
                row.squared += error * error;
                if (error > row.largest) {
                    row.largest = error;
                    row.largestColumn = x;
                }
            }
        }
    });

    ErrorSums total;
    for (std::size_t y = 0; y < rows.size(); ++y) {
        total.absolute += rows[y].absolute;
        total.squared += rows[y].squared;
        total.pixels += rows[y].pixels;
        total.nonFinite += rows[y].nonFinite;
        if (rows[y].largest <= total.largest) continue;
        total.largest = rows[y].largest;
        difference.maxError = total.largest;
        difference.maxErrorPixel = {rows[y].largestColumn, static_cast<int>(y)};
    }
    const double values = 3.0 * static_cast<double>(std::max<std::uint64_t>(total.pixels, 1));
    difference.mae = total.absolute / values;
    difference.rmse = std::sqrt(total.squared / values);
    difference.psnr =
        total.squared > 0 ? 10 * std::log10(values / total.squared) : std::numeric_limits<double>::infinity();
    difference.pixelCount = total.pixels;
    difference.nonFinite = total.nonFinite;
}

DoublePlane luma(const Image& display) {
    DoublePlane plane(display.width, display.height);
    forEachRow(display.height, [&](int y) {
        for (int x = 0; x < display.width; ++x) {
            const float* pixel = display.at(x, y);
            plane.row(y)[x] = 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
        }
    });
    return plane;
}

Kernel<double> ssimWindow() {
    Kernel<double> window;
    double total = 0;
    for (int i = -windowRadius; i <= windowRadius; ++i) {
        window.push_back(std::exp(-i * i / (2 * windowDeviation * windowDeviation)));
        total += window.back();
    }
    for (double& weight : window) weight /= total;
    return window;
}

DoublePlane product(const DoublePlane& a, const DoublePlane& b) {
    DoublePlane result(a.width, a.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
    return result;
}

// Returns SSIM per pixel. Windows that reach outside the image use repeated edge pixels.
DoublePlane similarityMap(const ComparablePair& pair, const Image& displayA, const Image& displayB) {
    const Kernel<double> window = ssimWindow();
    const auto mean = [&](const DoublePlane& plane) {
        return filteredAlongColumns(filteredAlongRows(plane, window), window);
    };
    const DoublePlane a = luma(displayA);
    const DoublePlane b = luma(displayB);
    const DoublePlane meanA = mean(a);
    const DoublePlane meanB = mean(b);
    const DoublePlane meanAA = mean(product(a, a));
    const DoublePlane meanBB = mean(product(b, b));
    const DoublePlane meanAB = mean(product(a, b));
    DoublePlane similarity(a.width, a.height);
    for (std::size_t i = 0; i < similarity.values.size(); ++i) {
        const double ma = meanA.values[i], mb = meanB.values[i];
        const double varianceA = meanAA.values[i] - ma * ma;
        const double varianceB = meanBB.values[i] - mb * mb;
        const double covariance = meanAB.values[i] - ma * mb;
        similarity.values[i] =
            (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (varianceA + varianceB + c2));
        if (pair.state[i] == PixelState::nonFiniteInOne) similarity.values[i] = 0;
        if (pair.state[i] == PixelState::nonFiniteInBoth) similarity.values[i] = 1;
    }
    return similarity;
}

double meanSimilarity(const DoublePlane& similarity, const Image* mask) {
    const auto meanInside = [&](int margin) -> std::optional<double> {
        double total = 0;
        std::uint64_t pixels = 0;
        for (int y = margin; y < similarity.height - margin; ++y)
            for (int x = margin; x < similarity.width - margin; ++x)
                if (counts(mask, x, y)) {
                    total += similarity.row(y)[x];
                    ++pixels;
                }
        if (pixels == 0) return std::nullopt;
        return total / static_cast<double>(pixels);
    };
    if (const auto inside = meanInside(windowRadius)) return *inside;
    return meanInside(0).value_or(1.0);
}

double meanValue(const Image& map, const Image* mask) {
    double total = 0;
    std::uint64_t pixels = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            if (counts(mask, x, y)) {
                total += *map.at(x, y);
                ++pixels;
            }
    return pixels > 0 ? total / static_cast<double>(pixels) : 0.0;
}

}  // namespace

Difference compareImages(const ImageView& reference, const ImageView& test, const CompareOptions& options) {
    // Convert both images to finite RGB over black, then to display-encoded values.
    const ComparablePair pair = comparablePair(reference, test);
    const Image* mask = options.mask;
    if (mask != nullptr && (mask->width != reference.width || mask->height != reference.height || mask->channels != 1))
        fail("comparison mask: {}x{} with {} channels, but the images need {}x{} with 1", mask->width, mask->height,
             mask->channels, reference.width, reference.height);
    const Image displayA = displayEncoded(pair.reference);
    const Image displayB = displayEncoded(pair.test);

    // Compute per-channel errors.
    Difference difference;
    measureErrors(pair, displayA, displayB, mask, difference);

    // Compute the metrics that use a neighbourhood of each pixel.
    difference.ssim = meanSimilarity(similarityMap(pair, displayA, displayB), mask);
    Image flip = flipErrorMap(reference, test, options.hdrFlip);
    difference.flip = meanValue(flip, mask);
    if (options.flipMap != nullptr) *options.flipMap = std::move(flip);
    return difference;
}

}  // namespace defocus::engine

defocus::Difference defocus::compareImages(const ImageView& reference, const ImageView& test) {
    return engine::compareImages(reference, test, engine::CompareOptions{});
}
