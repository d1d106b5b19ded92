#pragma once
// Measures how similar images and arrays are.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool sameBits(const Image& a, const Image& b) {
    return sameBits(a.pixels, b.pixels);
}

// Returns the max absolute difference over all channels and pixels; infinity if a value is NaN. The images must have
// the same size.
inline double largestDifference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double difference = std::abs(double(a.pixels[i]) - double(b.pixels[i]));
        largest = std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(largest, difference);
    }
    return largest;
}

// Returns the root mean square difference over all channels and pixels. The images must have the same size.
inline double rootMeanSquare(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i]) - double(b.pixels[i]), 2);
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

inline double meanRed(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y)[0]);
    return sum / (static_cast<double>(image.width) * image.height);
}

}  // namespace defocus::engine
