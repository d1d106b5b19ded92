// The names and constants in this file follow the papers cited in flip.h; section numbers refer to the LDR paper (HPG
// 2020).

#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "image/comparable.h"
#include "image/separable_filter.h"

namespace defocus::engine {

namespace {

using FloatPlane = Plane<float>;
using FloatKernel = Kernel<float>;

// Matrix from linear sRGB to XYZ in row-major order, its inverse, and the XYZ white point.
constexpr std::array<float, 9> rgbToXyz = {0.412386564f, 0.357591491f, 0.180450491f, 0.212636822f, 0.715182982f,
                                           0.072180196f, 0.019330620f, 0.119197164f, 0.950372587f};
constexpr std::array<float, 9> xyzToRgb = {3.241003233f, -1.537398969f, -0.498615882f, -0.969224252f, 1.875929984f,
                                           0.041554226f, 0.055639420f,  -0.204011206f, 1.057148977f};
constexpr std::array<float, 3> white = {0.950428545f, 1.000000000f, 1.088900371f};

// Contrast sensitivity (LDR paper, section 4.1) as a sum of Gaussians a·√(π/b)·exp(−π²x²/b), x in degrees.
struct SensitivityTerm {
    double a;
    double b;
};
constexpr SensitivityTerm achromaticTerm{1.0, 0.0047};
constexpr SensitivityTerm redGreenTerm{1.0, 0.0053};
constexpr std::array<SensitivityTerm, 2> blueYellowTerms = {{{34.1, 0.04}, {13.5, 0.025}}};

// LDR paper, section 4.1: exponent of the colour difference, and the knee of the piecewise linear curve, which maps 0.4
// times the maximum difference to 0.95.
constexpr float colourExponent = 0.7f;
constexpr float kneeIn = 0.4f;
constexpr float kneeOut = 0.95f;
// LDR paper, section 4.2: feature width in degrees, and exponent of the feature difference.
constexpr double featureWidth = 0.082;
constexpr float featureExponent = 0.5f;

struct Colour {
    float x, y, z;
};

struct ColourPlanes {
    FloatPlane x, y, z;
    ColourPlanes(int width, int height) : x(width, height), y(width, height), z(width, height) {}
};

Colour transformed(const std::array<float, 9>& m, const Colour& c) {
    return {m[0] * c.x + m[1] * c.y + m[2] * c.z, m[3] * c.x + m[4] * c.y + m[5] * c.z,
            m[6] * c.x + m[7] * c.y + m[8] * c.z};
}

// Converts linear RGB to YCxCz, the opponent colour space of the spatial filters. The conversion is linear.
Colour opponentFromRgb(const Colour& rgb) {
    const Colour xyz = transformed(rgbToXyz, rgb);
    const float x = xyz.x / white[0], y = xyz.y / white[1], z = xyz.z / white[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Colour rgbFromOpponent(const Colour& opponent) {
    const float y = (opponent.x + 16) / 116;
    const float x = y + opponent.y / 500;
    const float z = y - opponent.z / 200;
    return transformed(xyzToRgb, {x * white[0], y * white[1], z * white[2]});
}

float labCurve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

// Converts linear RGB to L*a*b* with the Hunt effect: dark colours appear less colourful.
Colour huntLabFromRgb(const Colour& rgb) {
    const Colour xyz = transformed(rgbToXyz, rgb);
    const float x = labCurve(xyz.x / white[0]), y = labCurve(xyz.y / white[1]), z = labCurve(xyz.z / white[2]);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

// Returns the HyAB distance of two L*a*b* colours: absolute difference in lightness plus Euclidean distance in chroma.
// HyAB suits large differences better than CIE formulas.
float colourDistance(const Colour& p, const Colour& q) {
    return std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z);
}

Colour clamped(const Colour& c) {
    return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
}

// Applies K. Narkowicz's ACES curve with an exposure factor of 0.6. Inputs are clamped far above saturation, so that
// squares stay finite.
float acesCurve(float value) {
    const float x = 0.6f * std::clamp(value, 0.0f, 1e6f);
    return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

// Returns the weights exp(−falloff·x²) for x = −radius … radius in px; they are not normalised.
std::vector<double> gaussian(int radius, double falloff) {
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i) weights.push_back(std::exp(-falloff * i * i));
    return weights;
}

double sum(const std::vector<double>& weights) {
    double total = 0;
    for (const double weight : weights) total += weight;
    return total;
}

FloatKernel scaled(const std::vector<double>& weights, double scale) {
    FloatKernel kernel;
    for (const double weight : weights) kernel.push_back(static_cast<float>(weight * scale));
    return kernel;
}

// Normalises a derivative filter so that its positive weights sum to 1 and its negative weights to −1.
FloatKernel balanced(const std::vector<double>& weights) {
    double positive = 0, negative = 0;
    for (const double weight : weights) (weight > 0 ? positive : negative) += std::abs(weight);
    FloatKernel kernel;
    for (const double weight : weights)
        kernel.push_back(static_cast<float>(weight / (weight > 0 ? positive : negative)));
    return kernel;
}

struct SpatialFilters {
    FloatKernel achromatic, redGreen;
    std::array<FloatKernel, 2> blueYellow;   // two Gaussians; each sums to 1
    std::array<float, 2> blueYellowWeights;  // weights of the two kernels; sum to 1
};

SpatialFilters spatialFilters(double pixelsPerDegree) {
    constexpr double pi = std::numbers::pi;
    const double widest = std::max({achromaticTerm.b, redGreenTerm.b, blueYellowTerms[0].b, blueYellowTerms[1].b});
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixelsPerDegree));
    const auto weightsOf = [&](const SensitivityTerm& term) {
        return gaussian(radius, pi * pi / (term.b * pixelsPerDegree * pixelsPerDegree));
    };
    const auto normalised = [&](const SensitivityTerm& term) {
        const std::vector<double> weights = weightsOf(term);
        return scaled(weights, 1 / sum(weights));
    };
    // The blue-yellow filter is a sum of two separable Gaussians. `share` is a Gaussian's weight, the sum over its 2D
    // kernel.
    std::array<double, 2> share;
    for (std::size_t i = 0; i < share.size(); ++i) {
        const double total = sum(weightsOf(blueYellowTerms[i]));
        share[i] = blueYellowTerms[i].a * std::sqrt(pi / blueYellowTerms[i].b) * total * total;
    }
    return {
        normalised(achromaticTerm),
        normalised(redGreenTerm),
        {normalised(blueYellowTerms[0]), normalised(blueYellowTerms[1])},
        {static_cast<float>(share[0] / (share[0] + share[1])), static_cast<float>(share[1] / (share[0] + share[1]))}};
}

struct FeatureFilters {
    FloatKernel smooth, edge, point;  // kernels: Gaussian, its first derivative, its second derivative
};

FeatureFilters featureFilters(double pixelsPerDegree) {
    const double deviation = 0.5 * featureWidth * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const std::vector<double> smooth = gaussian(radius, 1 / (2 * deviation * deviation));
    std::vector<double> edge, point;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        const double x = static_cast<double>(i) - radius;
        edge.push_back(-x * smooth[i]);
        point.push_back((x * x / (deviation * deviation) - 1) * smooth[i]);
    }
    return {scaled(smooth, 1 / sum(smooth)), balanced(edge), balanced(point)};
}

// ToDisplay is a function float(float) that maps a linear channel to the displayed linear value in [0, 1].
template <typename ToDisplay>
ColourPlanes opponentPlanes(const Image& rgb, const ToDisplay& toDisplay) {
    ColourPlanes planes(rgb.width, rgb.height);
    forEachRow(rgb.height, [&](int y) {
        for (int x = 0; x < rgb.width; ++x) {
            const float* pixel = rgb.at(x, y);
            const Colour c = opponentFromRgb({toDisplay(pixel[0]), toDisplay(pixel[1]), toDisplay(pixel[2])});
            planes.x.row(y)[x] = c.x;
            planes.y.row(y)[x] = c.y;
            planes.z.row(y)[x] = c.z;
        }
    });
    return planes;
}

FloatPlane filtered(const FloatPlane& in, const FloatKernel& alongRows, const FloatKernel& alongColumns) {
    return filteredAlongColumns(filteredAlongRows(in, alongRows), alongColumns);
}

// Filters an image in YCxCz with the eye's contrast sensitivity. Returns L*a*b* with the Hunt effect.
ColourPlanes perceived(const ColourPlanes& opponent, const SpatialFilters& filters) {
    const FloatPlane achromatic = filtered(opponent.x, filters.achromatic, filters.achromatic);
    const FloatPlane redGreen = filtered(opponent.y, filters.redGreen, filters.redGreen);
    const FloatPlane wide = filtered(opponent.z, filters.blueYellow[0], filters.blueYellow[0]);
    const FloatPlane narrow = filtered(opponent.z, filters.blueYellow[1], filters.blueYellow[1]);
    ColourPlanes lab(achromatic.width, achromatic.height);
    forEachRow(achromatic.height, [&](int y) {
        for (int x = 0; x < achromatic.width; ++x) {
            const float blueYellow =
                filters.blueYellowWeights[0] * wide.row(y)[x] + filters.blueYellowWeights[1] * narrow.row(y)[x];
            const Colour rgb = rgbFromOpponent({achromatic.row(y)[x], redGreen.row(y)[x], blueYellow});
            const Colour c = huntLabFromRgb(clamped(rgb));
            lab.x.row(y)[x] = c.x;
            lab.y.row(y)[x] = c.y;
            lab.z.row(y)[x] = c.z;
        }
    });
    return lab;
}

struct Features {
    FloatPlane edges, points;  // magnitudes of the filter responses
};

Features features(const FloatPlane& achromatic, const FeatureFilters& filters) {
    FloatPlane grey = achromatic;
    forEachRow(grey.height, [&](int y) {
        for (int x = 0; x < grey.width; ++x) grey.row(y)[x] = (grey.row(y)[x] + 16) / 116;
    });
    const FloatPlane smooth = filteredAlongRows(grey, filters.smooth);
    const auto strength = [&](const FloatKernel& derivative) {
        FloatPlane acrossRows = filtered(grey, derivative, filters.smooth);
        const FloatPlane acrossColumns = filteredAlongColumns(smooth, derivative);
        for (std::size_t i = 0; i < acrossRows.values.size(); ++i) {
            const float a = acrossRows.values[i], b = acrossColumns.values[i];
            acrossRows.values[i] = std::sqrt(a * a + b * b);
        }
        return acrossRows;
    };
    return {strength(filters.edge), strength(filters.point)};
}

// Maps the difference of two L*a*b* colours to [0, 1] by a power function, then a piecewise linear curve with one knee.
class ColourDifference {
public:
    ColourDifference()
        : largest_(std::pow(colourDistance(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), colourExponent)) {}
    float operator()(const Colour& p, const Colour& q) const {
        const float error = std::pow(colourDistance(p, q), colourExponent);
        const float knee = kneeIn * largest_;
        if (error < knee) return kneeOut / knee * error;
        return kneeOut + (error - knee) / (largest_ - knee) * (1 - kneeOut);
    }

private:
    float largest_;  // max colour difference of FLIP: between pure green and pure blue
};

// Computes LDR-FLIP of the images after `toDisplay`. Each pixel of `map` keeps the larger of its old value and the new
// error.
template <typename ToDisplay>
void raiseToFlip(const ComparablePair& pair, double pixelsPerDegree, const ToDisplay& toDisplay, Image& map) {
    // Convert the displayed linear colours to the opponent colour space.
    const ColourPlanes opponentA = opponentPlanes(pair.reference, toDisplay);
    const ColourPlanes opponentB = opponentPlanes(pair.test, toDisplay);
    // Run the colour pipeline, which filters the images with the eye's contrast sensitivity.
    const SpatialFilters spatial = spatialFilters(pixelsPerDegree);
    const ColourPlanes labA = perceived(opponentA, spatial);
    const ColourPlanes labB = perceived(opponentB, spatial);
    // Run the feature pipeline, which detects edges and points.
    const FeatureFilters filters = featureFilters(pixelsPerDegree);
    const Features featuresA = features(opponentA.x, filters);
    const Features featuresB = features(opponentB.x, filters);
    // Combine the results of both pipelines: feature differences amplify colour differences.
    const ColourDifference colourDifference;
    forEachRow(map.height, [&](int y) {
        for (int x = 0; x < map.width; ++x) {
            const float colour = colourDifference({labA.x.row(y)[x], labA.y.row(y)[x], labA.z.row(y)[x]},
                                                  {labB.x.row(y)[x], labB.y.row(y)[x], labB.z.row(y)[x]});
            const float edge = std::abs(featuresA.edges.row(y)[x] - featuresB.edges.row(y)[x]);
            const float point = std::abs(featuresA.points.row(y)[x] - featuresB.points.row(y)[x]);
            const float feature =
                std::min(1.0f, std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, featureExponent));
            float* value = map.at(x, y);
            *value = std::max(*value, std::min(1.0f, std::pow(colour, 1 - feature)));
        }
    });
}

void checkOptions(const std::optional<HdrFlipOptions>& hdr, double pixelsPerDegree) {
    if (!(pixelsPerDegree >= 1 && pixelsPerDegree <= 1000))
        fail("FLIP: {} pixels per degree is out of range; choose 1 to 1000", pixelsPerDegree);
    if (!hdr) return;
    const double start = hdr->startExposure, stop = hdr->stopExposure;
    if (!(start >= -60 && start <= stop && stop <= 60))
        fail(
            "FLIP: the exposure range {} to {} EV is invalid; the first must not exceed the second, and both must be "
            "within ±60 EV",
            start, stop);
    if (hdr->exposures < 1 || hdr->exposures > 64)
        fail("FLIP: the number of exposures, {}, is out of range; choose 1 to 64", hdr->exposures);
}

}  // namespace

int flipRadius(double pixelsPerDegree) {
    const std::size_t widest =
        std::max(spatialFilters(pixelsPerDegree).achromatic.size(), featureFilters(pixelsPerDegree).smooth.size());
    // One filter of each kind suffices, because all filters of a kind have the same size.
    return static_cast<int>(widest / 2);
}

Image flipErrorMap(const ImageView& reference, const ImageView& test, const std::optional<HdrFlipOptions>& hdr,
                   double pixelsPerDegree) {
    checkOptions(hdr, pixelsPerDegree);
    const ComparablePair pair = comparablePair(reference, test);
    Image map(reference.width, reference.height, 1);
    if (!hdr) {
        raiseToFlip(
            pair, pixelsPerDegree, [](float value) { return std::clamp(value, 0.0f, 1.0f); }, map);
    } else {
        // HDR-FLIP of a pixel is the max of its LDR-FLIP values over all exposures.
        const double step = hdr->exposures > 1 ? (hdr->stopExposure - hdr->startExposure) / (hdr->exposures - 1) : 0.0;
        for (int i = 0; i < hdr->exposures; ++i) {
            const auto gain = static_cast<float>(std::exp2(hdr->startExposure + i * step));
            raiseToFlip(
                pair, pixelsPerDegree, [gain](float value) { return acesCurve(gain * value); }, map);
        }
    }
    // If a pixel is NaN or infinite in only one image, set its error to 1; if it is in both, to 0.
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        if (pair.state[i] == PixelState::nonFiniteInOne) map.pixels[i] = 1;
        if (pair.state[i] == PixelState::nonFiniteInBoth) map.pixels[i] = 0;
    }
    return map;
}

}  // namespace defocus::engine
