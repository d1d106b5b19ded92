#include "eval/convergence/crops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/accumulation/accumulation.h"
#include "render/aov/aov.h"

namespace defocus::engine {

namespace {

// Summed-area table: entry (x, y) is the sum of all values to the left of column x and above row y. The sum over any
// rectangle follows from four entries (Crow 1984).
class SummedArea {
public:
    explicit SummedArea(const Image& values)
        : stride_(static_cast<std::size_t>(values.width) + 1),
          sums_(stride_ * (static_cast<std::size_t>(values.height) + 1)) {
        for (int y = 0; y < values.height; ++y) {
            double row = 0;
            for (int x = 0; x < values.width; ++x) {
                row += *values.at(x, y);
                sum(x + 1, y + 1) = sum(x + 1, y) + row;
            }
        }
    }

    [[nodiscard]] double of(int x, int y, int size) const {
        return sum(x + size, y + size) - sum(x, y + size) - sum(x + size, y) + sum(x, y);
    }

private:
    [[nodiscard]] double& sum(int x, int y) {
        return sums_[static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const double& sum(int x, int y) const {
        return sums_[static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x)];
    }

    std::size_t stride_;
    std::vector<double> sums_;
};

bool overlap(const Crop& crop, int x, int y, int size) {
    return x < crop.x + crop.width && crop.x < x + size && y < crop.y + crop.height && crop.y < y + size;
}

Image errorOfFewSamples(const World& world, const View& view, const ReferenceImage& reference, std::uint32_t fewSamples,
                        const RendererOptions& options) {
    const RenderSettings settings{.sampleCount = fewSamples, .lod = LodMode::off};
    RendererOptions own = options;
    own.settings.clear();
    const auto renderer = makeAccumulationRenderer(world, own);
    return flipErrorMap(reference.image, imageOf(*renderer, planFrame(world, view, settings)));
}

Image blurOfGeometry(const World& world, const View& view, const RendererOptions& options) {
    const RenderSettings settings{.lod = LodMode::off};
    const AovImages aovs = renderAovs(world, planFrame(world, view, settings), options.shaderFolder);
    Image blur = aovs.coc;
    for (std::size_t i = 0; i < blur.pixels.size(); ++i)
        blur.pixels[i] = std::isfinite(aovs.depth.pixels[i]) ? std::abs(blur.pixels[i]) : 0;
    return blur;
}

}  // namespace

std::optional<Crop> largestSquare(const Image& values, int size, const std::optional<Crop>& other) {
    const SummedArea area(values);
    std::optional<Crop> best;
    double max = -1;
    for (int y = 0; y + size <= values.height; ++y)
        for (int x = 0; x + size <= values.width; ++x) {
            const double sum = area.of(x, y, size);
            if (!(sum > max) || (other && overlap(*other, x, y, size))) continue;
            max = sum;
            best = Crop{"", x, y, size, size};
        }
    return best;
}

std::vector<Crop> tellingCrops(const World& world, const View& view, const ReferenceImage& reference,
                               std::uint32_t fewSamples, const RendererOptions& options) {
    const int size = std::max(1, std::min(view.width, view.height) / 4);
    std::vector<Crop> crops;
    std::optional<Crop> worst = largestSquare(errorOfFewSamples(world, view, reference, fewSamples, options), size);
    if (worst) {
        worst->title = fmt::format("largest error of {} lens samples at full detail", fewSamples);
        crops.push_back(*worst);
    }
    std::optional<Crop> blurred = largestSquare(blurOfGeometry(world, view, options), size, worst);
    if (blurred) {
        blurred->title = "most blurred objects";
        crops.push_back(*blurred);
    }
    return crops;
}

}  // namespace defocus::engine
