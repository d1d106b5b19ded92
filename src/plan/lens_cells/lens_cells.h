#pragma once
// Lens cells: the pieces of the lens that lens samples stand for (method "multirate").
//
// N samples divide the lens into N cells of the same light. What a cell sees is the image from its middle, blurred a
// little more: by a shape √N times smaller than the lens's own. A sum of images from points leaves that out, and shows
// copies where there should be a disk. So the images are seen from the middles of the cells, and each is blurred by a
// Gaussian of σ = blur·|c| px, with c the circle of confusion of what a pixel shows: the image's grid follows the blur
// (Soler, Subr, Durand, Holzschuch and Sillion 2009, Fourier Depth of Field).
//
// Variances add. So the middles have the mean of the lens, and its covariance less that of the blur: what is blurred
// keeps its place and its size for any N, where points of a sequence move it by their mean. σ falls as 1/√N, and the
// limit is that of the accumulation.
//
// Blurring is linear, so what pixels show is sorted by σ into a few classes, summed, and each class is blurred once a
// block (render/accumulation/cell_sums.h). A pixel belongs to the two classes whose variances are nearest to its own,
// in shares that keep it: nothing pops. What is hardly blurred stays as it is, and so does a pixel where an
// alpha-blended surface shows what lies behind it, as both have a blur of their own.

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace defocus::engine {

struct FramePlan;

inline constexpr int maxCellClasses = 5;  // on each side of the focus; σ ends with the last's
// px² along an axis, of class k ≥ 0 of a side, 4^k/3 + 1/6: its image has means over squares of 2^k px, weighed by a
// tent, and linear interpolation between their middles.
double cellClassVariance(int k);
inline constexpr double minCellVariance = 0.01;  // px², taken from all: what a pixel's own width hides

struct LensCells {
    double blur = 0;                 // σ as a share of |c|; 0: images stay as they are
    std::uint32_t firstSample = 0;   // LensSample::index of the first of them
    std::vector<glm::vec2> middles;  // as LensSample::lens
    glm::dvec2 pixelShift{0};        // px; brings the mean of the pixel offsets to the pixels' middle
    // Classes that what is in front of the focus needs, and what is behind it. Where samples leave no gaps there are
    // none: the middles of the cells are all that is left, so that nothing pops.
    int inFront = 0;
    int behind = 0;
    std::string reason;  // why images stay as they are; empty if they don't
    [[nodiscard]] int classes() const { return inFront + behind; }
};

// Of the samples that were planned together. A frame that grows block by block has cells of its own in each block,
// whose images are blurred as those of all samples until then.
LensCells lensCells(const FramePlan& plan);

// The share of the pixels along an axis that an image blurred by `coc` px needs: a square of a class of that variance
// for a pixel. 1 where images stay as they are.
double pixelRate(const LensCells& cells, double coc);

}  // namespace defocus::engine
