#include "refocus/gap_filling.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr std::size_t channels = 5;  // red, green, blue, alpha and weight
// Standard deviation of the blur of a cell (the part of the lens that one of N images represents), in units of c/√N for
// a circle of confusion of c px. A disk-shaped cell would have 1/4. Real cells differ in size and shape; twice the
// value of a disk gives the smallest error (docs/refocus.md).
constexpr double cellBlur = 0.5;
// Variance in px² that is subtracted from the blur variance of every pixel. An invisible blur thus counts as sharp.
constexpr double minVariance = 0.01;

// Returns the blur variance of class k, px². Pixels are sorted into classes by their blur.
double classVariance(std::size_t k) {
    return 0.5 * std::ldexp(1.0, 2 * static_cast<int>(k));
}

std::vector<float> gaussian(double variance) {
    const int reach = static_cast<int>(std::ceil(3 * std::sqrt(variance)));
    std::vector<float> weights;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += std::exp(-i * i / (2 * variance));
    for (int i = -reach; i <= reach; ++i)
        weights.push_back(static_cast<float>(std::exp(-i * i / (2 * variance)) / sum));
    return weights;
}

// Returns an image of `depth` interleaved floats per pixel, convolved with a Gaussian. Pixels outside the image equal
// the nearest pixel inside it.
std::vector<float> blurred(const std::vector<float>& image, const PartSize& size, std::size_t depth, double variance) {
    const std::vector<float> weights = gaussian(variance);
    const int reach = static_cast<int>(weights.size() / 2);
    const auto width = static_cast<std::size_t>(size.width);
    const std::size_t rowFloats = width * depth;
    std::vector<float> result(image.size());
    parallelFor(static_cast<std::size_t>(size.height), [&](std::size_t row) {
        // Copy of a row of the image, with a margin of `reach` pixels on each side.
        std::vector<float> line(rowFloats + 2 * static_cast<std::size_t>(reach) * depth);
        float* const inner = line.data() + static_cast<std::size_t>(reach) * depth;
        for (int i = -reach; i <= reach; ++i) {
            const int y = std::clamp(static_cast<int>(row) + i, 0, size.height - 1);
            const float weight = weights[static_cast<std::size_t>(i + reach)];
            const float* const from = image.data() + static_cast<std::size_t>(y) * rowFloats;
            for (std::size_t k = 0; k < rowFloats; ++k) inner[k] += weight * from[k];
        }
        for (std::size_t x = 0; x < static_cast<std::size_t>(reach); ++x)
            for (std::size_t c = 0; c < depth; ++c) {
                line[x * depth + c] = inner[c];
                inner[rowFloats + x * depth + c] = inner[rowFloats - depth + c];
            }
        float* const to = result.data() + row * rowFloats;
        for (std::size_t i = 0; i < weights.size(); ++i)
            for (std::size_t k = 0; k < rowFloats; ++k) to[k] += weights[i] * line[i * depth + k];
    });
    return result;
}

}  // namespace

GapFilling::GapFilling(const PartSize& size, const DioptreBlur& blur, std::size_t images)
    : size_(size), blur_(blur), cellVariance_(cellBlur * cellBlur / static_cast<double>(images)) {
    const Sum empty(channels * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    sharp_ = empty;
    front_.assign(classes, empty);
    behind_.assign(classes, empty);
}

void GapFilling::addPixel(std::size_t pixel, const std::uint16_t* colour, float depth, float weight) {
    const double dioptres = depth > 0 ? 1 / static_cast<double>(depth) : 0;
    const double c = blur_.diameter * (blur_.focus - dioptres);
    const double variance = std::clamp(cellVariance_ * c * c - minVariance, 0.0, classVariance(classes - 1));
    std::size_t upper = 0;  // first class (pixels of similar blur) with a variance of at least `variance`
    while (classVariance(upper) < variance) ++upper;
    const double lower = upper > 0 ? classVariance(upper - 1) : 0;
    const auto share = static_cast<float>((variance - lower) / (classVariance(upper) - lower));
    std::vector<Sum>& side = c < 0 ? front_ : behind_;
    const auto addTo = [&](Sum& sum, float part) {
        float* const to = sum.data() + channels * pixel;
        for (std::size_t i = 0; i < 4; ++i) to[i] += part * fromHalf(colour[i]);
        to[4] += part;
    };
    if (share > 0) addTo(side[upper], weight * share);
    if (share < 1) addTo(upper > 0 ? side[upper - 1] : sharp_, weight * (1 - share));
}

void GapFilling::add(std::span<const DeepMovedImage> images) {
    parallelFor(static_cast<std::size_t>(size_.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (const DeepMovedImage& moved : images) {
            const int column = size_.margin - moved.move.x;
            const int line = y + size_.margin + moved.move.y;  // row 0 is at the top; move.y is positive upwards
            const std::uint16_t* const colours = moved.colour->at(column, line);
            const float* const depths = moved.depth->at(column, line);
            const std::size_t first = row * static_cast<std::size_t>(size_.width);
            for (std::size_t x = 0; x < static_cast<std::size_t>(size_.width); ++x)
                addPixel(first + x, colours + 4 * x, depths[x], moved.weight);
        }
    });
    for (const DeepMovedImage& moved : images) weights_ += static_cast<double>(moved.weight);
}

// Composites the pixels `shown`, a class of pixels with similar blur, over `image`. `nearer`: for each pixel, the
// weight of the samples that lie nearer to the camera than this class.
void GapFilling::layOver(Image& image, const Sum& shown, const std::vector<float>& nearer, double variance) const {
    std::vector<float> open(nearer.size());
    for (std::size_t p = 0; p < open.size(); ++p) open[p] = static_cast<float>(weights_) - nearer[p];
    const Sum shownMeans = blurred(shown, size_, channels, variance);
    const std::vector<float> openMeans = blurred(open, size_, 1, variance);
    for (std::size_t p = 0; p < open.size(); ++p) {
        if (!(openMeans[p] > 1e-3f * static_cast<float>(weights_))) continue;
        const float* const own = shownMeans.data() + channels * p;
        const float rest = std::max(openMeans[p] - own[4], 0.0f);
        float* const pixel = image.pixels.data() + 4 * p;
        for (std::size_t c = 0; c < 4; ++c) pixel[c] = (own[c] + rest * pixel[c]) / openMeans[p];
    }
}

Image GapFilling::mean() const {
    assert(weights_ > 0);
    const auto total = static_cast<float>(weights_);
    Image image(size_.width, size_.height, 4);
    const std::size_t pixels = image.pixels.size() / 4;
    const auto isEmpty = [&](const Sum& sum) {
        for (std::size_t p = 0; p < pixels; ++p)
            if (sum[channels * p + 4] > 0) return false;
        return true;
    };
    const auto addWeights = [&](const Sum& sum, float sign, std::vector<float>& weights) {
        for (std::size_t p = 0; p < pixels; ++p) weights[p] += sign * sum[channels * p + 4];
    };
    // Composite the pixels behind the focus plane, grouped by blur, from most to least blurred, which is from far to
    // near.
    std::vector<float> nearer(pixels);
    for (const Sum& sum : front_) addWeights(sum, 1, nearer);
    const std::vector<float> inFront = nearer;
    addWeights(sharp_, 1, nearer);
    for (std::size_t k = 0; k + 1 < classes; ++k) addWeights(behind_[k], 1, nearer);
    for (std::size_t k = classes; k-- > 0;) {
        if (!isEmpty(behind_[k])) layOver(image, behind_[k], nearer, classVariance(k));
        if (k > 0) addWeights(behind_[k - 1], -1, nearer);
    }
    // Composite the sharp samples. Where samples in front of the focus plane cover a pixel, its background is unknown;
    // use the mean of these samples instead.
    for (std::size_t p = 0; p < pixels; ++p) {
        const float open = total - inFront[p];
        float* const pixel = image.pixels.data() + 4 * p;
        const float* const sharp = sharp_.data() + channels * p;
        for (std::size_t c = 0; c < 4; ++c) {
            if (open > 0.5f / 64 * total) {
                pixel[c] = (sharp[c] + std::max(open - sharp[4], 0.0f) * pixel[c]) / open;
                continue;
            }
            float sum = 0;
            for (const Sum& front : front_) sum += front[channels * p + c];
            pixel[c] = sum / std::max(inFront[p], 1e-6f);
        }
    }
    // Composite the pixels in front of the focus plane, grouped by blur, from least to most blurred, which is from far
    // to near.
    nearer = inFront;
    for (std::size_t k = 0; k < classes; ++k) {
        addWeights(front_[k], -1, nearer);
        if (!isEmpty(front_[k])) layOver(image, front_[k], nearer, classVariance(k));
    }
    return image;
}

}  // namespace defocus::engine
