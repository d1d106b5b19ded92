#pragma once
// Computes lens cells: regions of the lens that are each represented by one lens sample (method "multirate").
//
// N samples divide the lens into N cells that pass equal amounts of light. A cell's image is approximately the image
// from the cell's centre, blurred slightly. The blur kernel is the lens's shape, √N times smaller. A sum of pinhole
// images without this blur shows ghost copies of a point instead of a disk. Therefore each image is rendered from a
// cell's centre and blurred by a Gaussian with a standard deviation σ of LensCells::blur·|c| px. c is the circle of
// confusion of the surface at the pixel. The image resolution follows the blur (Soler, Subr, Durand, Holzschuch and
// Sillion 2009, Fourier Depth of Field).
//
// Variances of convolved kernels add. The cells' centres are therefore placed such that their mean is the mean of the
// lens, and their covariance is the lens's covariance minus the covariance of the blur. Blurred points then keep their
// position and size for any N. Unmodified points of the sample sequence would shift blurred points by the mean of the
// sequence points. σ falls as 1/√N, so the result converges to that of plain accumulation.
//
// Blurring is linear. The pixel values of the samples' images are therefore sorted by σ into a few classes and summed
// over a block of samples; each class is then blurred once per block (render/accumulation/cell_sums.h). A pixel value
// contributes to the two classes with the nearest variances, with weights that preserve its own variance; this avoids
// popping. Pixel values with hardly any blur stay unblurred. Pixel values with an alpha-blended surface also stay
// unblurred, because the surface and its background differ in blur.

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace defocus::engine {

struct FramePlan;

inline constexpr int maxCellClasses = 5;  // max number of classes of similar blur on each side of the focus plane
// Returns the variance in px², along one axis, of the blur of class k ≥ 0: 4^k/3 + 1/6. A class is a group of pixel
// values with similar blur. The image of a class consists of tent-weighted means over squares of 2^k px, interpolated
// linearly between their centres.
double cellClassVariance(int k);
inline constexpr double minCellVariance = 0.01;  // px², subtracted from each blur's variance; too small to be visible

struct LensCells {
    double blur = 0;                // standard deviation of a cell's blur as a fraction of the CoC diameter; 0: no blur
    std::uint32_t firstSample = 0;  // LensSample::index of the first cell's lens sample
    std::vector<glm::vec2> middles;  // centre of each cell, in the coordinates of LensSample::lens
    // Shift in px that is added to LensSample::pixel, so that the mean position of the samples is the pixel's centre.
    glm::dvec2 pixelShift{0};
    // Numbers of blur classes, groups of pixel values with similar blur, in front of and behind the focus plane. Both
    // are 0 if the samples are so dense that their images need no blur. Samples are moved to the cells' centres even
    // then; otherwise, the image would pop when a class is added.
    int inFront = 0;
    int behind = 0;
    std::string reason;  // why the samples' images cannot be blurred; empty if they can be
    [[nodiscard]] int classes() const { return inFront + behind; }
};

// Returns why the images of the plan's samples cannot be blurred by lens cells; empty if they can be.
std::string reasonForNoCells(const FramePlan& plan);

// Returns the lens cells of the plan's samples. A frame may consist of several blocks of samples, each with a plan. The
// first block divides the lens into as many cells as the block has samples. Later blocks take their cells from a
// common, finer division of the lens. LensCells::blur of a later block depends on the number of samples that the frame
// has at the end of that block.
LensCells lensCells(const FramePlan& plan);

// Moves each sample of the plan to the centre of its lens cell, and shifts its position in the pixel by
// LensCells::pixelShift. Does nothing if cells.blur is 0.
void moveToCells(FramePlan& plan, const LensCells& cells);

// Returns the image resolution that a lens sample needs along each axis at a CoC of `coc` px, as a fraction of full
// resolution. The fraction is 2^−k for a blur with the variance cellClassVariance(k), and 1 for smaller variances than
// that of k = 0. It is always 1 if the images of the samples are not blurred (LensCells::blur is 0).
double pixelRate(const LensCells& cells, double coc);

}  // namespace defocus::engine
