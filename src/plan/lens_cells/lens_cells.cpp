#include "plan/lens_cells/lens_cells.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "plan/frame_plan.h"
#include "plan/lens_cells/even_division.h"

namespace defocus::engine {

namespace {

// With N samples, a lens cell's blur has σ = cellWidth/√N times the CoC diameter. A disk-shaped cell has σ = 1/4 of its
// diameter; the value here is 40 % larger to close the gaps between cells.
constexpr double cellWidth = 0.35;
// Min number of samples for lens cells. With fewer samples, the images of the samples are not blurred.
constexpr std::uint32_t fewestSamples = 4;
constexpr std::uint32_t maxPointsOfCell = 16;
constexpr std::uint32_t maxPoints = 1u << 14;  // max number of lens points, summed over all cells
// Min number of cells in the common division of the lens, which all blocks of samples after the first use.
constexpr std::uint32_t cellsOfBlocks = maxPoints / maxPointsOfCell;

// Mean and covariance of lens points, and the fraction of the unit disk that they cover. The default values describe a
// uniform unit disk.
struct LensSpread {
    glm::dvec2 mean{0};
    glm::dmat2 covariance{0.25};
    double area = 1;
};

LensSpread spreadOf(const std::vector<LensSample>& samples) {
    LensSpread spread{{}, glm::dmat2(0), 1};
    const auto count = static_cast<double>(samples.size());
    for (const LensSample& sample : samples) spread.mean += glm::dvec2(sample.lens) / count;
    for (const LensSample& sample : samples) {
        const glm::dvec2 off = glm::dvec2(sample.lens) - spread.mean;
        spread.covariance += glm::outerProduct(off, off) / count;
    }
    return spread;
}

// Returns the effective open area of an aperture image as a fraction of the unit disk: (Σ w)² / Σ w² over the
// transmittances w of the image's cells (see ApertureImage), divided by the number of these cells in the disk.
double filledArea(const ApertureImage& image) {
    double squares = 0;
    double rowsBefore = 0;
    const auto columns = static_cast<std::size_t>(image.columns);
    for (std::size_t row = 0; row < image.rowEnds.size(); ++row) {
        const double inRow = image.rowEnds[row] - std::exchange(rowsBefore, image.rowEnds[row]);
        double before = 0;
        for (std::size_t column = 0; column < columns; ++column) {
            const double end = image.cellEnds[row * columns + column];
            squares += std::pow(inRow * (end - std::exchange(before, end)), 2);
        }
    }
    const double diameter = std::max(image.columns, image.rows);  // diameter of the unit disk, in cells of the image
    return std::min(1.0, 1 / (squares * std::numbers::pi / 4 * diameter * diameter));
}

LensSpread lensSpread(const Lens& lens) {
    const Aperture aperture = makeAperture(lens);
    if (isUniformDisk(aperture)) return {};
    LensSpread spread = spreadOf(lensSamples(lens, Sequence::sobol, 0, 4096, 0));
    // Area of the uniform ellipse with this covariance, relative to the unit disk. The hole of a ring-shaped aperture
    // is subtracted below.
    spread.area = std::min(1.0, 4 * std::sqrt(glm::determinant(spread.covariance)));
    spread.area *= (1 - aperture.obstruction) / (1 + aperture.obstruction);
    if (!aperture.image.rowEnds.empty()) spread.area = std::min(spread.area, filledArea(aperture.image));
    return spread;
}

void rotate(std::vector<LensSample>& samples, double angle) {
    const auto cosine = static_cast<float>(std::cos(angle));
    const auto sine = static_cast<float>(std::sin(angle));
    const glm::mat2 rotation(cosine, sine, -sine, cosine);
    for (LensSample& sample : samples) sample.lens = rotation * sample.lens;
}

// Moves each of `samples`, the first points of the sample sequence, to the mean point of its lens cell, the region of
// the lens that the sample represents. A cell is approximated by several points of the same sequence: `points` points
// per sample are computed, and each sample gets equally many points near it. The division runs along two axes, so the
// mean points form rows and columns. The axes are rotated, so that adjacent columns interleave across a blurred
// vertical or horizontal edge.
void moveToMeans(std::vector<LensSample>& samples, const FramePlan& plan) {
    const auto count = static_cast<std::uint32_t>(samples.size());
    const std::uint32_t points = std::min(maxPointsOfCell, maxPoints / count);
    if (points < 2) return;
    std::vector<LensSample> dense =
        lensSamples(plan.view.lens, plan.settings.sequence, 0, count * points, plan.settings.seed);
    const double turn = 0.5 / std::sqrt(static_cast<double>(count));
    rotate(dense, -turn);
    rotate(samples, -turn);
    const std::vector<std::uint32_t> order = evenDivision(dense, samples, points);
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec2 sum(0);
        for (std::size_t j = 0; j < points; ++j) sum += glm::dvec2(dense[order[i * points + j]].lens);
        samples[i].lens = glm::vec2(sum / static_cast<double>(points));
    }
    rotate(samples, turn);
}

// Returns the lower triangular matrix L with L·Lᵀ = m (Cholesky decomposition).
glm::dmat2 root(const glm::dmat2& m) {
    const double a = std::sqrt(std::max(m[0][0], 1e-12));
    const double b = m[0][1] / a;
    return {a, b, 0, std::sqrt(std::max(m[1][1] - b * b, 1e-12))};
}

// Returns the lens points of `samples`, transformed so that their mean is the mean of `lens`, and their covariance is
// the covariance of `lens` minus `variance` along each axis.
std::vector<glm::vec2> matched(const std::vector<LensSample>& samples, const LensSpread& lens, double variance) {
    glm::dmat2 wanted = lens.covariance;
    for (glm::length_t axis = 0; axis < 2; ++axis) wanted[axis][axis] -= std::min(variance, 0.75 * wanted[axis][axis]);
    const LensSpread drawn = spreadOf(samples);
    const glm::dmat2 matrix = root(wanted) * glm::inverse(root(drawn.covariance));
    std::vector<glm::vec2> points;
    for (const LensSample& sample : samples) {
        const glm::dvec2 point = lens.mean + matrix * (glm::dvec2(sample.lens) - drawn.mean);
        points.emplace_back(point / std::max(1.0, glm::length(point)));
    }
    return points;
}

double varianceOf(double blur, double coc) {
    return std::max(0.0, blur * coc * blur * coc - minCellVariance);
}

// Returns how many blur classes are needed for CoC diameters up to `coc` px. A blur class is a group of pixel values
// with similar blur (see lens_cells.h).
int classesFor(double blur, double coc) {
    const double variance = varianceOf(blur, coc);
    int classes = variance > 0 ? 1 : 0;
    while (classes > 0 && classes < maxCellClasses && variance > cellClassVariance(classes - 1)) ++classes;
    return classes;
}

}  // namespace

std::string reasonForNoCells(const FramePlan& plan) {
    if (!plan.usesLens || plan.largestBlur < minBlur) return "no blur reaches half a pixel";
    if (plan.frameSamples < fewestSamples) return "there are too few samples";
    if (plan.needsAlpha) return "the background is transparent";
    if (plan.coc.chromatic > 0) return "each sample has its own wavelength";
    if (plan.usesOwnBlur) return "objects or vertices have their own blur (--node-blur, vertex attributes)";
    if (plan.usesTransmission) return "a material transmits light";
    return "";
}

LensCells lensCells(const FramePlan& plan) {
    LensCells cells;
    cells.reason = reasonForNoCells(plan);
    if (!cells.reason.empty()) return cells;

    const LensSpread lens = lensSpread(plan.view.lens);
    const double blur = cellWidth * std::sqrt(lens.area / plan.frameSamples);
    double inFront = 0;
    double behind = largestCocAtInfinity(plan.coc, plan.view.width);
    for (const ObjectPlan& object : plan.objects) {
        inFront = std::max(inFront, -object.coc.nearest);
        behind = std::max(behind, object.coc.farthest);
    }
    cells.inFront = classesFor(blur, inFront);
    cells.behind = classesFor(blur, behind);
    cells.blur = blur;
    cells.firstSample = plan.frameFirst;
    // All blocks of samples after the first take their cells from a common division of the lens, which is refined only
    // beyond 1,024 samples. If each block had its own division, the cells of different blocks would have nearly the
    // same centres, and many blocks would show a light as the same few dots.
    const std::uint32_t count =
        plan.frameFirst == 0 ? plan.frameSamples : std::max(cellsOfBlocks, std::bit_ceil(plan.frameSamples));
    std::vector<LensSample> samples = lensSamples(plan.view.lens, plan.settings.sequence, 0, count, plan.settings.seed);
    moveToMeans(samples, plan);
    samples.resize(plan.frameSamples);
    samples.erase(samples.begin(), samples.begin() + plan.frameFirst);
    for (const LensSample& sample : samples)
        cells.pixelShift -= glm::dvec2(sample.pixel) / static_cast<double>(samples.size());
    // For a CoC of c px, the lens point (1, 0) moves the image by c/2 px. A standard deviation of `blur`·c px in the
    // image therefore corresponds to 2·`blur` lens radii on the lens.
    cells.middles = matched(samples, lens, 4 * blur * blur);
    return cells;
}

void moveToCells(FramePlan& plan, const LensCells& cells) {
    if (cells.blur == 0) return;
    for (LensSample& sample : plan.samples) {
        assert(sample.index - cells.firstSample < cells.middles.size());
        sample.lens = cells.middles[sample.index - cells.firstSample];
        sample.pixel += glm::vec2(cells.pixelShift);
    }
}

double cellClassVariance(int k) {
    return std::exp2(2 * k) / 3 + 1.0 / 6;
}

double pixelRate(const LensCells& cells, double coc) {
    const double variance = std::min(varianceOf(cells.blur, coc), cellClassVariance(maxCellClasses - 1));
    return 1 / std::sqrt(std::max(1.0, 3 * (variance - 1.0 / 6)));
}

}  // namespace defocus::engine
