// Uses the compensated sum of Neumaier 1974, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen.

#include "refocus/shifted_sum.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr int imagesPerBlock = 64;
constexpr int stripRows = 4;  // rows that one thread sums at a time, so that the sums stay in the core's cache

// Adds a value to a compensated sum. The result is bit-identical to shaders/include/compensated.glsl.
void addCompensated(float& sum, float& compensation, float value) {
    const float total = sum + value;
    const float taken = total - sum;
    const float lost = (sum - (total - taken)) + (value - taken);
    compensation += lost;
    sum = total;
}

// Adds `count` half-float values, each times `weight`, to compensated sums.
void addRow(const std::uint16_t* __restrict values, float weight, std::size_t count, float* __restrict sums,
            float* __restrict compensations) {
    for (std::size_t i = 0; i < count; ++i) addCompensated(sums[i], compensations[i], weight * fromHalf(values[i]));
}

// Adds `count` compensated sums to other compensated sums.
void addSums(const float* __restrict values, const float* __restrict parts, std::size_t count, float* __restrict sums,
             float* __restrict compensations) {
    for (std::size_t i = 0; i < count; ++i) {
        addCompensated(sums[i], compensations[i], values[i]);
        addCompensated(sums[i], compensations[i], parts[i]);
    }
}

}  // namespace

ShiftedSum::ShiftedSum(const PartSize& size) : size_(size) {
    for (Sum* sum : {&block_, &frame_}) sum->value = sum->compensation = Image(size.width, size.height, 4);
}

void ShiftedSum::add(std::span<const MovedImage> images) {
    const std::size_t rowFloats = 4 * static_cast<std::size_t>(size_.width);
    const auto strips = static_cast<std::size_t>((size_.height + stripRows - 1) / stripRows);
    parallelFor(strips, [&](std::size_t strip) {
        const int first = static_cast<int>(strip) * stripRows;
        const int end = std::min(first + stripRows, size_.height);
        const std::size_t floats = rowFloats * static_cast<std::size_t>(end - first);
        float* const sums = block_.value.at(0, first);
        float* const compensations = block_.compensation.at(0, first);
        int inBlock = inBlock_;
        for (const MovedImage& moved : images) {
            assert(moved.image->width == size_.fullWidth() && moved.image->height == size_.fullHeight());
            if (inBlock == imagesPerBlock) {
                addSums(sums, compensations, floats, frame_.value.at(0, first), frame_.compensation.at(0, first));
                std::fill_n(sums, floats, 0.0f);
                std::fill_n(compensations, floats, 0.0f);
                inBlock = 0;
            }
            for (int y = first; y < end; ++y)  // row 0 is at the top; move.y is positive upwards
                addRow(moved.image->at(size_.margin - moved.move.x, y + size_.margin + moved.move.y), moved.weight,
                       rowFloats, block_.value.at(0, y), block_.compensation.at(0, y));
            ++inBlock;
        }
    });
    for (const MovedImage& moved : images) {
        if (inBlock_ == imagesPerBlock) inBlock_ = 0;
        ++inBlock_;
        weights_ += static_cast<double>(moved.weight);
    }
}

Image ShiftedSum::mean() const {
    assert(weights_ > 0);
    Sum total = frame_;
    const std::size_t floats = total.value.pixels.size();
    addSums(block_.value.pixels.data(), block_.compensation.pixels.data(), floats, total.value.pixels.data(),
            total.compensation.pixels.data());
    const auto divisor = static_cast<float>(weights_);
    for (std::size_t i = 0; i < floats; ++i)
        total.value.pixels[i] = (total.value.pixels[i] + total.compensation.pixels[i]) / divisor;
    return total.value;
}

}  // namespace defocus::engine
