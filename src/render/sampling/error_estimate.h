#pragma once
// Estimates how far the mean of N lens samples is from its limit, from the means of fewer samples that lead to it.
//
// Blocks of samples of a low-discrepancy sequence aren't independent: each fills the gaps of those before, and the
// error of n blocks isn't that of one over √n. What holds for such sequences is that k blocks in a row err as k^(−a).
// Two stretches of blocks then differ by a known multiple of the error of their mean, whatever the scene is. With
// s(k) = k^(−2a), m blocks before n − m others, and
//   c = (n² s(n) − m² s(m) − (n − m)² s(n − m)) / (2 m (n − m)),
// which is what the two stretches' errors have in common,
//   E|M(n) − M(m)|² = ((n − m)/n)² (s(m) + s(n − m) − 2c),   E|M(n) − truth|² = s(n),
// both times the squared error of one block. Random samples (a = 1/2) give the familiar σ/√n.
//
// The stretches compared are the longest that there are, about half of the samples each: the step from their
// difference to the error is then short: an exponent that is off by 0.1 changes the result by an eighth, where the
// spread of single blocks would carry that to the power of their number.

#include <cstdint>
#include <optional>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

// The exponent a of lens samples in a picture. Random points have 0.5, straight edges under a well spread set 0.75; the
// mean over four sequences and three scenes, from 64 to 1,024 samples, is 0.59 (bench/results/llvmpipe-sequences.txt).
inline constexpr double lensSampleExponent = 0.6;

// |M(n) − truth| over |M(n) − M(m)|, as above; 0 < m < n.
double errorOverDifference(double m, double n, double exponent = lensSampleExponent);

// Root mean square of the difference of two images of one size, of the same pixels and values as ErrorEstimate::error.
double encodedDifference(const ImageView& a, const ImageView& b);

class ErrorEstimate {
public:
    // `mean` is the image of the first `samples` samples of a frame, linear, 3 channels or more (a fourth says
    // nothing); `samples` grows from call to call. At most a million pixels of it are looked at, one of each k × k, and
    // kept. Throws Error for an image of another size than the one before.
    void add(const ImageView& mean, std::uint32_t samples);

    // Root mean square of the latest image's error over its pixels and channels, on display-encoded values in [0, 1] at
    // EV 0; nothing before there are two images.
    [[nodiscard]] std::optional<double> error() const { return error_; }
    [[nodiscard]] std::uint32_t samples() const { return kept_.empty() ? 0 : kept_.back().samples; }

private:
    struct Kept {
        std::uint32_t samples = 0;
        std::vector<float> encoded;  // of the pixels looked at, RGB
    };

    int width_ = 0;
    int height_ = 0;
    std::vector<Kept> kept_;  // by number of samples; those of about half the latest number, and since
    std::optional<double> error_;
};

}  // namespace defocus::engine
