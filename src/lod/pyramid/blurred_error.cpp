#include "lod/pyramid/blurred_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "lod/pyramid/four.h"
#include "lod/pyramid/level_selection.h"
#include "lod/pyramid/picture.h"

namespace defocus::engine {

namespace {

constexpr std::size_t viewCount = 4;
constexpr int minResolution = 128;
// Max pixels per side of an image. The largest patches of a BlurTable have this side.
constexpr int maxResolution = 512;
static_assert(maxResolution == 1 << (blurSizes - 1));
constexpr double minBlurredGrowth = 1.1;  // a level's blurred error is at least this multiple of the next finer level's
constexpr double minError = 1e-6;         // lower bound on blurred errors, relative to the mesh's mean radiance
// On a grey background, the ratio of a level's error to the contrast of level 0 may reach only this fraction of
// measuredLimit(). With 1 instead of 0.9, levels would raise the FLIP error of a smooth surface in focus by more than a
// fifth.
constexpr double greyShare = 0.9;
constexpr double minGreyContrast = 0.004;  // min contrast on a grey background, relative to the mean radiance
// Max ratio of the errors of consecutive levels. On a smooth surface, the ratio is about 2: half the triangles have
// twice the squared edge length, to which the error is proportional. This limit is twice that. If a level's triangles
// are smaller than the pixels of the image, its error cannot be measured. It is then at least the next coarser level's
// error divided by this limit.
constexpr float maxUnseenGrowth = 4;

// ---- averages over patches of an image ---------------------------------------------------------

// Sums over all pixels and channels of an image, one per patch size. Entry 0 sums the squared values (for example
// radiance) of single pixels. Entry i sums the squared means over patches of 2^i × 2^i pixels, each weighted by the
// patch's number of pixels.
using SquareSums = std::array<double, blurSizes>;
using SurroundSums = std::array<SquareSums, surrounds.size()>;

// An image with its means over square patches with sides of 2, 4, … pixels. Each patch has two means, over its pixels
// on the white and on the black squares of a checkerboard with squares of one pixel.
class Patches {
    struct Size {
        CellBox shown;  // box of the patches that may contain non-black pixels
        CellBox kept;   // box of the patches that are stored; contains `shown`
        // Means over the white and over the black pixels of each patch; empty for single pixels.
        std::array<LargeVector<glm::vec3>, 2> means;
    };

public:
    explicit Patches(const Eye& eye) : sizes_{{eye.box, eye.box, {}}} {
        for (int divisor = 2; divisor <= eye.resolution; divisor *= 2) {
            const CellBox all = {0, eye.resolution / divisor, 0, eye.resolution / divisor};
            const CellBox box = {eye.box.left / divisor, eye.box.right / divisor, eye.box.bottom / divisor,
                                 eye.box.top / divisor};
            Size& size = sizes_.emplace_back();
            size.shown = divisor <= boxAlignment ? box : all;
            size.kept = divisor < boxAlignment ? box : all;
            for (LargeVector<glm::vec3>& means : size.means) means.resize(size.kept.count());
        }
    }

    // Computes the patch means of the image whose pixels are `cells`. Keeps a reference to `cells`.
    void measure(const LargeVector<glm::vec3>& cells) {
        cells_ = &cells;
        for (std::size_t i = 1; i < sizes_.size(); ++i)
            for (int y = sizes_[i].shown.bottom; y < sizes_[i].shown.top; ++y)
                if (i == 1)
                    measureBoard(y);
                else
                    halve(i, y);
    }

    [[nodiscard]] std::size_t count() const { return sizes_.size(); }
    [[nodiscard]] const CellBox& box(std::size_t size) const { return sizes_[size].shown; }
    // Returns row y of the patch means for the size with index `size`, starting at the left edge of box(size). `black`
    // selects the means over the black pixels of the checkerboard, else over the white pixels. Size 0 stands for single
    // pixels: the row holds the pixel values, and `black` is ignored.
    [[nodiscard]] const glm::vec3* row(std::size_t size, bool black, int y) const {
        const LargeVector<glm::vec3>& values = size == 0 ? *cells_ : sizes_[size].means[black ? 1 : 0];
        return &values[sizes_[size].kept.indexOf(sizes_[size].shown.left, y)];
    }

private:
    void measureBoard(int y) {
        Size& size = sizes_[1];
        const CellBox& box = sizes_[0].kept;
        const glm::vec3* lower = &(*cells_)[box.indexOf(2 * size.shown.left, 2 * y)];
        const glm::vec3* upper = lower + box.width();
        glm::vec3* const white = &size.means[0][size.kept.indexOf(size.shown.left, y)];
        glm::vec3* const black = &size.means[1][size.kept.indexOf(size.shown.left, y)];
        for (int x = 0; x < size.shown.width(); ++x, lower += 2, upper += 2) {
            white[x] = 0.5f * (lower[0] + upper[1]);
            black[x] = 0.5f * (lower[1] + upper[0]);
        }
    }

    void halve(std::size_t i, int y) {
        Size& size = sizes_[i];
        const CellBox& box = sizes_[i - 1].kept;
        for (std::size_t black = 0; black < 2; ++black) {
            const glm::vec3* lower = &sizes_[i - 1].means[black][box.indexOf(2 * size.shown.left, 2 * y)];
            const glm::vec3* upper = lower + box.width();
            glm::vec3* const means = &size.means[black][size.kept.indexOf(size.shown.left, y)];
            for (int x = 0; x < size.shown.width(); ++x, lower += 2, upper += 2)
                means[x] = 0.25f * (lower[0] + lower[1] + upper[0] + upper[1]);
        }
    }

    const LargeVector<glm::vec3>* cells_ = nullptr;
    std::vector<Size> sizes_;
};

// Corresponding rows of pixels or patch means in two images: `before` is from the reference, `after` from the image
// that is compared with the reference.
struct Change {
    const glm::vec3* before;
    const glm::vec3* after;
};

// Returns the sum, over `count` pixels (or patches) and all channels, of the products of two differences: after −
// before in `first`, and after − before in `second`. Values are clamped to `brightest` before the subtraction.
double sumOfProducts(const Change& first, const Change& second, int count, float brightest) {
    const auto end = 3 * static_cast<std::size_t>(count);
    const auto at = [&](const Change& change, std::size_t i, auto bounded) {
        return bounded(&change.after->x + i) - bounded(&change.before->x + i);
    };
    Four sums{};
    std::size_t i = 0;
    const Four max = brightest - Four{};
    const auto four = [&](const float* from) {
        const Four values = loaded<Four>(from);
        return values < max ? values : max;
    };
    for (; i + 4 <= end; i += 4) sums += at(first, i, four) * at(second, i, four);
    float rest = 0;
    const auto one = [&](const float* from) { return std::min(*from, brightest); };
    for (; i < end; ++i) rest += at(first, i, one) * at(second, i, one);
    return double{sums[0]} + double{sums[1]} + double{sums[2]} + double{sums[3]} + double{rest};
}

// Returns the radiance `light` minus the background's radiance, so that the background becomes black. Returns `light`
// itself if the background is already black. Otherwise, the result is stored in `shifted`, whose memory is reused.
const LargeVector<glm::vec3>& before(float background, const LargeVector<glm::vec3>& light,
                                     LargeVector<glm::vec3>& shifted) {
    if (background == 0) return light;
    shifted = light;
    for (glm::vec3& value : shifted)
        if (value != glm::vec3(0)) value -= background;
    return shifted;
}

// Adds the squared differences between the images `seen` and `reference` to `sums`, for each patch size. A null
// `reference` stands for a black image; `dark` is then used as each of its rows.
//
// Each pixel samples one point of the surface, so that a patch mean contains sampling noise. Squaring the mean would
// add the variance of this noise. Therefore, the mean difference over the white squares of a checkerboard is
// multiplied by the mean difference over the black squares. The noise of the two means is uncorrelated and cancels on
// average.
void addSquares(const Patches* reference, const Patches& seen, std::span<const glm::vec3> dark, float brightest,
                SquareSums& sums) {
    for (std::size_t i = 0; i < seen.count(); ++i) {
        const CellBox& box = seen.box(i);
        double sum = 0;
        for (int y = box.bottom; y < box.top; ++y) {
            const auto change = [&](bool black) {
                return Change{reference != nullptr ? reference->row(i, black, y) : dark.data(), seen.row(i, black, y)};
            };
            sum += sumOfProducts(change(false), change(true), box.width(), brightest);
        }
        sums[i] += sum * std::pow(4.0, static_cast<double>(i));
    }
}

// For each patch and channel, adds the standard deviation of the radiance within the patch to `sums`, weighted by the
// patch's number of pixels. `seen` holds the means of the radiance, `squares` the means of the squared radiance.
void addDeviations(const Patches& seen, const Patches& squares, SquareSums& sums) {
    for (std::size_t i = 1; i < seen.count(); ++i) {
        const CellBox& box = seen.box(i);
        double sum = 0;
        for (int y = box.bottom; y < box.top; ++y)
            for (int x = 0; x < box.width(); ++x) {
                const glm::vec3 mean = 0.5f * (squares.row(i, false, y)[x] + squares.row(i, true, y)[x]);
                const glm::vec3 variance = mean - seen.row(i, false, y)[x] * seen.row(i, true, y)[x];
                const glm::vec3 deviation = glm::sqrt(glm::max(variance, 0.0f));
                sum += double{deviation.x} + double{deviation.y} + double{deviation.z};
            }
        sums[i] += sum * std::pow(4.0, static_cast<double>(i));
    }
}

// Clamps the noisy sums to possible values. The mean square never grows with the patch size. When the patch size
// doubles, the mean square falls to no less than 1/16 of its value. Two adjacent spots of opposite sign, which cancel
// each other, reach this bound.
void smooth(SquareSums& sums, std::size_t measured) {
    for (std::size_t i = measured; i > 1; --i) sums[i - 1] = std::max(sums[i - 1], sums[i]);
    for (std::size_t i = 1; i < blurSizes; ++i)
        sums[i] = i <= measured ? std::clamp(sums[i], sums[i - 1] / 16, sums[i - 1]) : sums[i - 1] / 4;
}

// Stores an image with many black pixels in compressed form.
class SparseCells {
public:
    SparseCells() = default;
    explicit SparseCells(const LargeVector<glm::vec3>& cells) : lit_(cells.size()) {
        const auto isLit = [](const glm::vec3& cell) { return cell != glm::vec3(0); };
        values_.reserve(static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), isLit)));
        for (std::size_t i = 0; i < cells.size(); ++i) {
            lit_[i] = isLit(cells[i]);
            if (lit_[i]) values_.push_back(cells[i]);
        }
    }

    [[nodiscard]] LargeVector<glm::vec3> all() const {
        LargeVector<glm::vec3> cells(lit_.size(), glm::vec3(0));
        auto value = values_.begin();
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (lit_[i]) cells[i] = *value++;
        return cells;
    }

private:
    std::vector<bool> lit_;
    LargeVector<glm::vec3> values_;  // radiance of the pixels that are not black
};

// Images and measurements for one view direction.
struct Sight {
    Eye eye;
    SparseCells reference;              // image of level 0
    double covered = 0, sum = 0;        // Picture::covered and Picture::sum of level 0
    SquareSums light{};                 // level 0 on a black background: sum of squared radiance per patch size
    SquareSums deviations{};            // level 0 on a grey background: sum of standard deviations per patch size
    std::vector<SurroundSums> changes;  // per level and background: sums of squared radiance differences from level 0

    // Measures the differences of each level from level 0. `unit` is the mean radiance of the mesh.
    void judge(const Pyramid& pyramid, std::span<const Finish> finishes, float unit) {
        const LargeVector<glm::vec3> cells = reference.all();
        reference = {};
        const std::vector<glm::vec3> dark(static_cast<std::size_t>(eye.resolution), glm::vec3(0));
        const auto brightest = static_cast<float>(shownWhite) * unit;
        // Clamp the radiance of each pixel before averaging, because a lens sample sees a single point, not an average.
        // Averages of clamped radiance never exceed `brightest`.
        LargeVector<glm::vec3> points = cells;
        for (glm::vec3& value : points) value = glm::min(value, brightest);
        std::array<LargeVector<glm::vec3>, surrounds.size()> shifted;
        std::vector<Patches> full(surrounds.size(), Patches(eye));
        Patches seen(eye);
        const auto backgroundOf = [&](std::size_t b) { return surrounds[b] == Surround::grey ? unit : 0; };
        for (std::size_t b = 0; b < surrounds.size(); ++b) full[b].measure(before(backgroundOf(b), cells, shifted[b]));
        seen.measure(points);
        addSquares(nullptr, seen, dark, brightest, light);
        LargeVector<glm::vec3> onGrey;
        LargeVector<glm::vec3> squares = before(unit, points, onGrey);
        for (glm::vec3& value : squares) value *= value;
        seen.measure(onGrey);
        Patches squared(eye);
        squared.measure(squares);
        addDeviations(seen, squared, deviations);
        changes.resize(pyramid.levels.size());
        Painter painter(pyramid, eye, finishes);
        Picture picture;
        for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
            painter.draw(l, picture);
            for (std::size_t b = 0; b < surrounds.size(); ++b) {
                seen.measure(before(backgroundOf(b), picture.light, onGrey));
                addSquares(&full[b], seen, dark, brightest - backgroundOf(b), changes[l][b]);
            }
        }
    }
};

int resolutionFor(std::uint32_t triangles) {
    const double root = std::sqrt(static_cast<double>(triangles));
    const auto wanted = static_cast<unsigned>(std::clamp(root, double{minResolution}, double{maxResolution}));
    return static_cast<int>(std::bit_ceil(wanted));
}

// Interpolates a table with blurSizes entries linearly at the patch side `side`. Entry 0 is for side 0, and entry i for
// side 2^(i − 1) · `smallest`. Beyond the largest side, returns the last entry. at(i) returns entry i.
template <typename At>
double interpolated(double smallest, double side, const At& at) {
    double low = 0;
    double high = smallest;
    std::size_t i = 0;
    for (; i + 2 < blurSizes && side > high; ++i) {
        low = high;
        high *= 2;
    }
    const double f = std::clamp((side - low) / (high - low), 0.0, 1.0);
    return (1 - f) * at(i) + f * at(i + 1);
}

std::size_t indexOf(Surround surround) {
    return static_cast<std::size_t>(surround);
}

double squared(float value) {
    return double{value} * double{value};
}

}  // namespace

// Returns directions on a Fibonacci lattice of the sphere, which is not aligned with the coordinate axes.
std::vector<glm::dvec3> blurredErrorViews() {
    std::vector<glm::dvec3> directions(viewCount);
    for (std::size_t i = 0; i < viewCount; ++i) {
        const double height = 1 - (2 * static_cast<double>(i) + 1) / viewCount;
        const double turn = 2 * std::numbers::pi * (static_cast<double>(i) * std::numbers::phi + 0.1);
        const double radius = std::sqrt(1 - height * height);
        directions[i] = {radius * std::cos(turn), radius * std::sin(turn), height};
    }
    return directions;
}

void measureBlurredErrors(Pyramid& pyramid, std::span<const Finish> finishes, std::size_t helpers) {
    const double size = glm::length(pyramid.bounds.size());
    if (pyramid.levels.size() < 2 || !(size > 0) || !std::isfinite(size)) return;
    const std::vector<Finish> matt(finishes.empty() ? pyramid.levels.front().primitives.size() : 0);
    if (finishes.empty()) finishes = matt;

    // Render level 0 from each view direction.
    const int resolution = resolutionFor(pyramid.levels.front().triangleCount);
    const std::vector<glm::dvec3> directions = blurredErrorViews();
    std::array<Sight, viewCount> sights;
    const auto fromAll = [&](const auto& look) {
        Tasks tasks(helpers);
        for (std::size_t i = 0; i < viewCount; ++i) tasks.add([&, i] { look(sights[i], directions[i]); });
        tasks.wait();
    };
    fromAll([&](Sight& sight, const glm::dvec3& direction) {
        sight.eye = eyeAlong(pyramid, direction, resolution);
        const Picture reference = pictureOf(pyramid, 0, sight.eye, finishes);
        sight.reference = SparseCells(reference.light);
        sight.covered = static_cast<double>(reference.covered);
        sight.sum = reference.sum;
    });

    // Compute the mean radiance `unit` of the mesh. The errors of a black mesh stay 0, because errors are relative to
    // this mean.
    double covered = 0;
    double light = 0;
    for (const Sight& sight : sights) {
        covered += sight.covered;
        light += sight.sum;
    }
    if (!(light > 0)) return;
    const double unit = light / covered;
    const double scale = 1 / (3 * covered * unit * unit);

    // Compare the other levels with level 0 in each view direction.
    fromAll([&](Sight& sight, const glm::dvec3&) { sight.judge(pyramid, finishes, static_cast<float>(unit)); });
    const auto measured = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(resolution)));
    const auto total = [&](const auto& sumsOf) {
        SquareSums sums{};
        for (const Sight& sight : sights)
            for (std::size_t i = 0; i < blurSizes; ++i) sums[i] += scale * sumsOf(sight)[i];
        smooth(sums, measured);
        return sums;
    };
    pyramid.smallestPatch = 2 * size / resolution;
    const SquareSums all = total([](const Sight& sight) -> const SquareSums& { return sight.light; });
    auto& [contrast, greyContrast] = pyramid.contrast;
    for (std::size_t i = 0; i < blurSizes; ++i) contrast[i] = static_cast<float>(std::sqrt(all[0] - all[i]));
    for (std::size_t i = 1; i < blurSizes; ++i) {
        double sum = 0;
        for (const Sight& sight : sights) sum += sight.deviations[i];
        greyContrast[i] = std::max(greyContrast[i - 1], static_cast<float>(sum * scale * unit));
    }
    for (std::size_t b = 0; b < surrounds.size(); ++b) {
        BlurTable finer{};
        for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
            const SquareSums sums = total([&](const Sight& sight) -> const SquareSums& { return sight.changes[l][b]; });
            BlurTable& own = pyramid.levels[l].blurredError[b];
            for (std::size_t i = 0; i < blurSizes; ++i)
                own[i] =
                    static_cast<float>(std::max({std::sqrt(sums[i]), minBlurredGrowth * double{finer[i]}, minError}));
            finer = own;
        }
        for (std::size_t l = pyramid.levels.size() - 1; --l > 0;) {
            if (pyramid.levels[l].triangleCount * viewCount <= covered) continue;
            BlurTable& own = pyramid.levels[l].blurredError[b];
            const BlurTable& coarser = pyramid.levels[l + 1].blurredError[b];
            for (std::size_t i = 0; i < blurSizes; ++i) own[i] = std::max(own[i], coarser[i] / maxUnseenGrowth);
        }
    }
}

double squaredError(const Pyramid& pyramid, std::size_t level, double side, Surround surround) {
    const BlurTable& table = pyramid.levels[level].blurredError[indexOf(surround)];
    if (!(pyramid.smallestPatch > 0) || !(table.back() > 0)) return 0;
    const double largest = pyramid.smallestPatch * std::exp2(double{blurSizes - 2});
    const double beyond = side > largest ? largest / side : 1;
    return beyond * beyond /
           interpolated(pyramid.smallestPatch, side, [&](std::size_t i) { return 1 / squared(table[i]); });
}

double squaredContrast(const Pyramid& pyramid, double side, Surround surround) {
    if (!(pyramid.smallestPatch > 0)) return 0;
    const BlurTable& table = pyramid.contrast[indexOf(surround)];
    if (surround == Surround::black)
        return interpolated(pyramid.smallestPatch, side, [&](std::size_t i) { return squared(table[i]); });
    const double mean = interpolated(pyramid.smallestPatch, side, [&](std::size_t i) { return double{table[i]}; });
    const double shown = std::max(greyShare * mean, minGreyContrast);
    return shown * shown;
}

double levelOfBlurredError(const Pyramid& pyramid, std::span<const double> sides, double pixelsPerUnit, double light) {
    const auto rootOfSum = [&](const auto& squared) {
        double sum = 0;
        for (const double side : sides) sum += squared(side);
        return std::sqrt(sum);
    };
    std::array<double, surrounds.size()> contrast{};
    for (const Surround surround : surrounds)
        contrast[indexOf(surround)] = rootOfSum([&](double side) { return squaredContrast(pyramid, side, surround); });
    if (!(contrast[indexOf(Surround::black)] > 0) || !(light > 0)) return 0;
    // Returns by how much the ratio of level `l`'s error to the contrast of level 0 exceeds the limit for this level;
    // negative below the limit.
    const auto excess = [&](std::size_t l) {
        double error = 0;
        for (const Surround surround : surrounds) {
            const double own = rootOfSum([&](double side) { return squaredError(pyramid, l, side, surround); });
            error = std::max(error, own / contrast[indexOf(surround)]);
        }
        return error - measuredLimit(light, pyramid.levels[l].meanEdge * pixelsPerUnit);
    };
    double fine = excess(0);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const double coarse = excess(l);
        if (coarse > 0) return static_cast<double>(l) - coarse / (coarse - fine);
        fine = coarse;
    }
    return static_cast<double>(pyramid.levels.size() - 1);
}

}  // namespace defocus::engine
