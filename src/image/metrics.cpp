#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/luminance.h"
#include "image/comparable.h"
#include "image/packed_pixels.h"
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

// Rows of the image that are compared together, and the margin above and below that the filters need.
struct Strip {
    int first = 0;  // compared rows: [first, end)
    int end = 0;
    int from = 0;  // rows including the margins: [from, to)
    int to = 0;
};

// Divides the image into strips that each fit into `maxBytes` together with all intermediate images.
std::vector<Strip> stripsOf(int width, int height, std::uint64_t maxBytes) {
    constexpr double bytesPerPixel = 160;  // measured with HDR-FLIP, the metric that needs the most memory
    const int margin = std::max(windowRadius, flipRadius());
    const double fitting = static_cast<double>(maxBytes) / (bytesPerPixel * width);
    const int rows = std::max(static_cast<int>(std::min(fitting, 1e9)) - 2 * margin, margin);
    std::vector<Strip> strips;
    for (int first = 0; first < height; first += rows) {
        const int end = height - first > rows ? first + rows : height;
        strips.push_back({first, end, std::max(0, first - margin), std::min(height - margin, end) + margin});
    }
    for (Strip& strip : strips) strip.to = std::min(strip.to, height);
    return strips;
}

// Returns the errors of one row of `pair`, which holds a strip of the images. `y` is the row's index in the strip,
// `maskRow` its index in the image.
ErrorSums rowErrors(const ComparablePair& pair, const Image& displayA, const Image& displayB, const Image* mask, int y,
                    int maskRow) {
    ErrorSums row;
    for (int x = 0; x < displayA.width; ++x) {
        if (!counts(mask, x, maskRow)) continue;
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
    return row;
}

DoublePlane luma(const Image& display) {
    DoublePlane plane(display.width, display.height);
    forEachRow(display.height, [&](int y) {
        for (int x = 0; x < display.width; ++x) {
            plane.row(y)[x] = luminance(display.at(x, y));
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

struct Mean {
    double total = 0;
    std::uint64_t pixels = 0;
    void add(double value) {
        total += value;
        ++pixels;
    }
    [[nodiscard]] double orElse(double empty) const { return pixels > 0 ? total / static_cast<double>(pixels) : empty; }
};

// Sums of pixel differences over the strips of an image. Values are added row by row, so that the result depends
// neither on the number of cores nor on the strips.
class DifferenceSums {
public:
    DifferenceSums(int width, int height, const CompareOptions& options)
        : width_(width), height_(height), options_(options) {}

    // `reference` and `test` are the strip's rows with margins.
    void add(const Strip& strip, const ImageView& reference, const ImageView& test) {
        // Convert both images to finite RGB over black, then to display-encoded values.
        const ComparablePair pair = comparablePair(reference, test);
        const Image displayA = displayEncoded(pair.reference);
        const Image displayB = displayEncoded(pair.test);
        addErrors(strip, pair, displayA, displayB);
        addSimilarity(strip, similarityMap(pair, displayA, displayB));
    }

    void addFlip(const Strip& strip, const ImageView& reference, const ImageView& test) {
        const Image map = flipErrorMap(reference, test, options_.hdrFlip);
        for (int y = strip.first; y < strip.end; ++y)
            for (int x = 0; x < width_; ++x)
                if (counts(options_.mask, x, y)) flip_.add(*map.at(x, y - strip.from));
        if (!options_.takeFlip) return;
        const auto row = static_cast<std::size_t>(width_);
        const std::span<const float> values(map.at(0, strip.first - strip.from),
                                            row * static_cast<std::size_t>(strip.end - strip.first));
        options_.takeFlip(ImageView(width_, strip.end - strip.first, 1, values));
    }

    [[nodiscard]] Difference difference() const {
        Difference difference;
        const double values = 3.0 * static_cast<double>(std::max<std::uint64_t>(errors_.pixels, 1));
        difference.mae = errors_.absolute / values;
        difference.rmse = std::sqrt(errors_.squared / values);
        difference.psnr =
            errors_.squared > 0 ? 10 * std::log10(values / errors_.squared) : std::numeric_limits<double>::infinity();
        if (largestRow_ >= 0) {
            difference.maxError = errors_.largest;
            difference.maxErrorPixel = {errors_.largestColumn, largestRow_};
        }
        difference.pixelCount = errors_.pixels;
        difference.nonFinite = errors_.nonFinite;
        difference.ssim = inside_.orElse(all_.orElse(1));
        difference.flip = flip_.orElse(0);
        return difference;
    }

private:
    void addErrors(const Strip& strip, const ComparablePair& pair, const Image& displayA, const Image& displayB) {
        std::vector<ErrorSums> rows(static_cast<std::size_t>(strip.end - strip.first));
        forEachRow(strip.end - strip.first, [&](int i) {
            const int y = strip.first + i;
            rows[static_cast<std::size_t>(i)] = rowErrors(pair, displayA, displayB, options_.mask, y - strip.from, y);
        });
        for (int y = strip.first; y < strip.end; ++y) {
            const ErrorSums& row = rows[static_cast<std::size_t>(y - strip.first)];
            errors_.absolute += row.absolute;
            errors_.squared += row.squared;
            errors_.pixels += row.pixels;
            errors_.nonFinite += row.nonFinite;
            if (row.largest <= errors_.largest) continue;
            errors_.largest = row.largest;
            errors_.largestColumn = row.largestColumn;
            largestRow_ = y;
        }
    }

    void addSimilarity(const Strip& strip, const DoublePlane& similarity) {
        for (int y = strip.first; y < strip.end; ++y) {
            const bool rowInside = y >= windowRadius && y < height_ - windowRadius;
            for (int x = 0; x < width_; ++x) {
                if (!counts(options_.mask, x, y)) continue;
                const double value = similarity.row(y - strip.from)[x];
                all_.add(value);
                if (rowInside && x >= windowRadius && x < width_ - windowRadius) inside_.add(value);
            }
        }
    }

    int width_, height_;
    const CompareOptions& options_;
    ErrorSums errors_;
    int largestRow_ = -1;
    Mean inside_;  // mean SSIM of the pixels whose window lies inside the image
    Mean all_;     // mean SSIM of all pixels
    Mean flip_;
};

}  // namespace

Difference compareStrips(const ImageStrips& reference, const ImageStrips& test, const CompareOptions& options,
                         std::uint64_t maxBytes) {
    const Image* mask = options.mask;
    if (mask != nullptr && (mask->width != reference.width || mask->height != reference.height || mask->channels != 1))
        fail("the comparison mask has {}x{} px and {} channels; it must have {}x{} px and 1 channel", mask->width,
             mask->height, mask->channels, reference.width, reference.height);
    DifferenceSums sums(reference.width, reference.height, options);
    for (const Strip& strip : stripsOf(reference.width, reference.height, maxBytes)) {
        const ImageView a = reference.rows(strip.from, strip.to - strip.from);
        const ImageView b = test.rows(strip.from, strip.to - strip.from);
        sums.add(strip, a, b);
        sums.addFlip(strip, a, b);
    }
    return sums.difference();
}

Difference compareImages(const ImageView& reference, const ImageView& test, const CompareOptions& options) {
    checkComparable(reference, test);
    const auto strips = [](const ImageView& image) {
        return ImageStrips{image.width, image.height,
                           [image](int first, int count) { return rowsOf(image, first, count); }};
    };
    CompareOptions own = options;
    if (options.flipMap != nullptr) {
        *options.flipMap = Image(reference.width, reference.height, 1);
        own.takeFlip = [&, taken = std::size_t{0}](const ImageView& rows) mutable {
            std::ranges::copy(rows.pixels, options.flipMap->pixels.begin() + static_cast<std::ptrdiff_t>(taken));
            taken += rows.pixels.size();
        };
    }
    return compareStrips(strips(reference), strips(test), own);
}

}  // namespace defocus::engine

defocus::Difference defocus::compareImages(const ImageView& reference, const ImageView& test) {
    return engine::compareImages(reference, test, engine::CompareOptions{});
}
