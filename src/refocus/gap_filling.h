#pragma once
// Fills the gaps that a refocused image shows if it is computed from few lens images (one image per lens sample): the
// sum of N sharp images shows N separate copies of each blurred surface. Instead, each lens image represents a cell,
// the part of the lens around its lens point. The image's pixels are blurred as a lens of the cell's size would blur
// them: σ = 0.5 · c / √N px for a circle of confusion of c px (plan/lens_cells/lens_cells.h). As in the multirate
// method, pixels are sorted by σ into a few classes on each side of the focus plane, and the sum of each class is
// blurred once. A pixel contributes to the two classes with the nearest variances. The classes are composited from the
// farthest to the nearest, each weighted by the fraction of the samples that no nearer class covers. A sharp outline
// thus stays sharp in front of a blurred background.

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "image/half_image.h"
#include "image/image_parts.h"

namespace defocus::engine {

// A lens image (the scene seen from one lens sample), moved by whole pixels, with its depths in m.
struct DeepMovedImage {
    const HalfImage* colour = nullptr;  // colours, including the margin around the visible image
    const Image* depth = nullptr;       // depths, with the same margin as `colour`
    glm::ivec2 move{0};                 // displacement in px, to the right and up
    float weight = 1;                   // weight of the image in the mean, > 0
};

// The circle of confusion has a diameter of `diameter` · (`focus` − 1/depth) px, positive behind the focus plane.
struct DioptreBlur {
    double diameter = 0;  // CoC diameter in px per dioptre of defocus
    double focus = 1;     // 1 / focus distance, dioptres
};

class GapFilling {
public:
    static constexpr std::size_t classes = 5;  // number of classes of similar blur on each side of the focus plane

    // `images`: number of images that will be passed to add().
    GapFilling(const PartSize& size, const DioptreBlur& blur, std::size_t images);

    void add(std::span<const DeepMovedImage> images);
    // Returns the mean of the blurred images: linear, premultiplied RGBA. Needs at least one image.
    [[nodiscard]] Image mean() const;

private:
    // Weighted sum of samples for each pixel: RGBA and the sum of the weights.
    using Sum = std::vector<float>;

    void addPixel(std::size_t pixel, const std::uint16_t* colour, float depth, float weight);
    void layOver(Image& image, const Sum& shown, const std::vector<float>& nearer, double variance) const;

    PartSize size_;
    DioptreBlur blur_;
    double cellVariance_;  // blur variance of one cell (part of the lens), divided by the squared CoC diameter
    double weights_ = 0;   // sum of the images' weights
    Sum sharp_;            // samples with hardly any blur
    std::vector<Sum> front_, behind_;  // sums of pixels grouped by blur, in front of and behind the focus plane
};

}  // namespace defocus::engine
