#pragma once
// Filters the rows and columns of a one-channel image with 1D kernels; edge pixels are repeated outside the image.
// Inner loops access contiguous memory so that the compiler vectorises them; rows are processed in parallel.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/parallel.h"

namespace defocus::engine {

template <typename T>
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<T> values;  // width · height values, top row first

    Plane(int planeWidth, int planeHeight)
        : width(planeWidth),
          height(planeHeight),
          values(static_cast<std::size_t>(planeWidth) * static_cast<std::size_t>(planeHeight)) {}
    [[nodiscard]] T* row(int y) {
        return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    }
    [[nodiscard]] const T* row(int y) const {
        return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    }
};

// Weights of a 1D filter; their number is odd, and the middle weight has offset 0.
template <typename T>
using Kernel = std::vector<T>;

// Calls body(y) for each row in parallel.
template <typename Body>
void forEachRow(int height, const Body& body) {
    parallelFor(static_cast<std::size_t>(height), [&](std::size_t y) { body(static_cast<int>(y)); });
}

// Returns out(x, y) = Σ kernel[i] · in(x + i − radius, y), where radius = kernel.size() / 2.
template <typename T>
Plane<T> filteredAlongRows(const Plane<T>& in, const Kernel<T>& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane<T> out(in.width, in.height);
    forEachRow(in.height, [&](int y) {
        const T* source = in.row(y);
        std::vector<T> padded(static_cast<std::size_t>(in.width + 2 * radius));
        std::fill_n(padded.begin(), radius, source[0]);
        std::copy_n(source, in.width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, source[in.width - 1]);
        T* target = out.row(y);
        for (std::size_t i = 0; i < kernel.size(); ++i) {
            const T weight = kernel[i];
            const T* shifted = padded.data() + i;
            for (int x = 0; x < in.width; ++x) target[x] += weight * shifted[x];
        }
    });
    return out;
}

// Returns out(x, y) = Σ kernel[i] · in(x, y + i − radius), where radius = kernel.size() / 2.
template <typename T>
Plane<T> filteredAlongColumns(const Plane<T>& in, const Kernel<T>& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane<T> out(in.width, in.height);
    forEachRow(in.height, [&](int y) {
        T* target = out.row(y);
        for (int i = 0; i < static_cast<int>(kernel.size()); ++i) {
            const T weight = kernel[static_cast<std::size_t>(i)];
            const T* source = in.row(std::clamp(y + i - radius, 0, in.height - 1));
            for (int x = 0; x < in.width; ++x) target[x] += weight * source[x];
        }
    });
    return out;
}

}  // namespace defocus::engine
