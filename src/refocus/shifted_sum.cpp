// Source of the compensated sum: Neumaier 1974, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen.

#include "refocus/shifted_sum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr int imagesPerBlock = 64;
constexpr std::size_t taps = 4;
// Overshoot of Catmull–Rom interpolation at a step from 0 to 1: its smallest weight, −2/27.
constexpr float maxOvershoot = 2.0f / 27;

// Position between pixels: the value lies between pixel `first` + 1 and the next one, and `weights` are those of the
// pixels from `first` on.
struct Taps {
    int first = 0;
    bool exact = false;  // the value is pixel `first` + 1 itself
    std::array<float, taps> weights{};
};

// Returns the taps for values at `offset` + i with 0 ≤ i < `count`, all within `size` pixels. Catmull–Rom spline.
Taps tapsAt(double offset, int count, int size) {
    const double whole = std::floor(offset);
    const double t = offset - whole;
    Taps result;
    result.first = std::clamp(static_cast<int>(whole) - 1, 0, size - count - static_cast<int>(taps) + 1);
    result.exact = t == 0;
    const double weights[taps] = {((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
                                  ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
    for (std::size_t i = 0; i < taps; ++i) result.weights[i] = static_cast<float>(weights[i]);
    return result;
}

// Writes the weighted sums of four rows of values. Each sum exceeds the range of its four values by at most
// `overshoot`.
void blend(const std::array<const float*, taps> rows, const std::array<float, taps> weights, float overshoot,
           std::size_t count, float* to) {
    for (std::size_t i = 0; i < count; ++i) {
        const float a = rows[0][i];
        const float b = rows[1][i];
        const float c = rows[2][i];
        const float d = rows[3][i];
        const float sum = weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d;
        const float low = std::min(std::min(a, b), std::min(c, d)) - overshoot;
        const float high = std::max(std::max(a, b), std::max(c, d)) + overshoot;
        to[i] = std::min(std::max(sum, low), high);
    }
}

// Writes row `y` of the moved image to `row`. `line` is scratch memory.
void moveRow(const Image& image, const Taps& columns, const Taps& rows, float overshoot, int y,
             std::vector<float>& line, std::vector<float>& row) {
    std::array<const float*, taps> sources{};
    for (int i = 0; i < static_cast<int>(taps); ++i)
        sources[static_cast<std::size_t>(i)] = image.at(columns.first, y + rows.first + i);
    if (rows.exact)
        std::copy_n(sources[1], line.size(), line.begin());
    else
        blend(sources, rows.weights, overshoot, line.size(), line.data());
    if (columns.exact)
        std::copy_n(line.begin() + 4, row.size(), row.begin());
    else
        blend({line.data(), line.data() + 4, line.data() + 8, line.data() + 12}, columns.weights, overshoot, row.size(),
              row.data());
}

// Adds a value to a compensated sum, with the bits of shaders/include/compensated.glsl.
void addCompensated(float& sum, float& compensation, float value) {
    const float total = sum + value;
    const float taken = total - sum;
    const float lost = (sum - (total - taken)) + (value - taken);
    compensation += lost;
    sum = total;
}

}  // namespace

ShiftedSum::ShiftedSum(const PartSize& size, float white) : size_(size), overshoot_(maxOvershoot * white) {
    for (Sum* sum : {&block_, &frame_}) sum->value = sum->compensation = Image(size.width, size.height, 4);
}

void ShiftedSum::add(const Image& image, const glm::dvec2& shift, float weight) {
    assert(image.width == size_.fullWidth() && image.height == size_.fullHeight() && image.channels == 4);
    if (inBlock_ == imagesPerBlock) {
        addBlock(frame_, block_);
        for (Image* part : {&block_.value, &block_.compensation}) std::ranges::fill(part->pixels, 0.0f);
        inBlock_ = 0;
    }
    const Taps columns = tapsAt(size_.margin - shift.x, size_.width, image.width);
    const Taps rows = tapsAt(size_.margin + shift.y, size_.height, image.height);  // rows run downwards
    constexpr int rowsAtOnce = 16;
    const auto strips = static_cast<std::size_t>((size_.height + rowsAtOnce - 1) / rowsAtOnce);
    parallelFor(strips, [&](std::size_t strip) {
        std::vector<float> row(4 * static_cast<std::size_t>(size_.width));
        std::vector<float> line(row.size() + 4 * (taps - 1));
        const int first = static_cast<int>(strip) * rowsAtOnce;
        for (int y = first; y < std::min(first + rowsAtOnce, size_.height); ++y) {
            moveRow(image, columns, rows, overshoot_, y, line, row);
            float* const sum = block_.value.at(0, y);
            float* const compensation = block_.compensation.at(0, y);
            for (std::size_t i = 0; i < row.size(); ++i) addCompensated(sum[i], compensation[i], weight * row[i]);
        }
    });
    ++inBlock_;
    weights_ += static_cast<double>(weight);
}

void ShiftedSum::addBlock(Sum& frame, const Sum& block) {
    for (std::size_t i = 0; i < block.value.pixels.size(); ++i) {
        float& sum = frame.value.pixels[i];
        float& compensation = frame.compensation.pixels[i];
        addCompensated(sum, compensation, block.value.pixels[i]);
        addCompensated(sum, compensation, block.compensation.pixels[i]);
    }
}

Image ShiftedSum::mean() const {
    assert(weights_ > 0);
    Sum total = frame_;
    addBlock(total, block_);
    const auto divisor = static_cast<float>(weights_);
    for (std::size_t i = 0; i < total.value.pixels.size(); ++i)
        total.value.pixels[i] = (total.value.pixels[i] + total.compensation.pixels[i]) / divisor;
    for (std::size_t i = 3; i < total.value.pixels.size(); i += 4)  // interpolation may overshoot
        total.value.pixels[i] = std::clamp(total.value.pixels[i], 0.0f, 1.0f);
    return total.value;
}

}  // namespace defocus::engine
