#pragma once
// Estimates the error of the mean of n lens samples from means of fewer samples of the same sequence.
//
// Blocks of a low-discrepancy sequence are not independent: each fills gaps of the earlier blocks, so the error of n
// blocks is not the error of one block divided by √n. Model: the error of the mean of k successive blocks is
// proportional to k^(−a). The difference of the means of two successive ranges of blocks is then a known multiple of
// the error of their common mean, for any scene. Let s(k) = k^(−2a), and let M(k) be the mean of the first k blocks.
// For a range of m blocks and the next n − m blocks, the covariance of the errors of the two means is
//   c = (n² s(n) − m² s(m) − (n − m)² s(n − m)) / (2 m (n − m)).
// Then, in units of the squared error of one block,
//   E|M(n) − M(m)|² = ((n − m)/n)² (s(m) + s(n − m) − 2c), E|M(n) − truth|² = s(n).
// Random samples (a = 1/2) give σ/√n.
//
// The ranges compared are as long as possible, about half of the samples each. Thus the estimate depends little on the
// exponent: an error of 0.1 in a changes the result by an eighth. An estimate from single blocks would depend on it far
// more.

#include <cstdint>
#include <optional>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

// Exponent a for lens samples: the error of n samples is proportional to n^(−a). The exponent is 0.5 for random points,
// and 0.75 for straight edges with well distributed points. The mean measured over four sequences and three scenes,
// from 64 to 1,024 samples, is 0.59 (bench/results/llvmpipe-sequences.txt).
inline constexpr double lensSampleExponent = 0.6;

// Returns the expected ratio of RMS differences |M(n) − truth| / |M(n) − M(m)|, 0 < m < n, where M(k) is the mean of
// the first k blocks. The error of M(k) is assumed to be proportional to k^(−exponent).
double errorOverDifference(double m, double n, double exponent = lensSampleExponent);

// Returns the RMS difference of two images of equal size, over the same pixels and display-encoded values as
// ErrorEstimate::error.
double encodedDifference(const ImageView& a, const ImageView& b);

// Ratio of an image's FLIP to the mean absolute error of its display-encoded values, for small errors. Measured over 16
// scenes and 16 to 256 samples: 4.5 to 11, median 7.5.
inline constexpr double flipOverDifference = 7.5;

class ErrorEstimate {
public:
    // Adds the mean of the first `samples` samples of a frame: linear, at least 3 channels (a fourth is ignored).
    // `samples` must increase from call to call. Uses at most about a million pixels: one pixel of each k × k tile.
    // Throws Error if the image size changes.
    void add(const ImageView& mean, std::uint32_t samples);

    // Returns the RMS error of the latest image over pixels and channels, in display-encoded values in [0, 1] at EV 0;
    // nullopt for fewer than two images.
    [[nodiscard]] std::optional<double> error() const { return error_; }
    // Returns the FLIP of the latest image, estimated from the mean absolute error of the display-encoded values;
    // nullopt for fewer than two images.
    [[nodiscard]] std::optional<double> flip() const { return flip_; }
    [[nodiscard]] std::uint32_t samples() const { return kept_.empty() ? 0 : kept_.back().samples; }

private:
    struct Kept {
        std::uint32_t samples = 0;
        std::vector<float> encoded;  // RGB of the selected pixels
    };

    int width_ = 0;
    int height_ = 0;
    // Images of the frame, sorted by sample count. The first has about a quarter of the samples of the last.
    std::vector<Kept> kept_;
    std::optional<double> error_;
    std::optional<double> flip_;
};

}  // namespace defocus::engine
