#include "frame/setup/exposure.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/luminance.h"
#include "lens/photographic_exposure.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

constexpr double middleGrey = 0.18;
constexpr double brightestAtMost = 1;
constexpr double brightestAtLeast = 0.4;
constexpr double brightestShare = 0.02;
constexpr double backgroundAtMost = 0.5;
constexpr int meterWidth = 160;  // width of the metered image, px
constexpr std::uint32_t meterSamples = 4;

// Makes the environment visible or invisible during the lifetime of this object.
struct ShownEnvironment {
    ShownEnvironment(World& changed, bool shown)
        : world(changed), visible(std::exchange(changed.environment.visible, shown)) {}
    ~ShownEnvironment() { world.environment.visible = visible; }
    ShownEnvironment(const ShownEnvironment&) = delete;
    ShownEnvironment& operator=(const ShownEnvironment&) = delete;
    World& world;
    bool visible;
};

double logAverage(const std::vector<double>& luminances) {
    double logarithms = 0;
    for (const double luminance : luminances) logarithms += std::log2(luminance);
    return logarithms / static_cast<double>(luminances.size());
}

// Replaces the colours of the background pixels (alpha ≤ 0.5) of `image` with the colours of `withEnvironment`, the
// same view in front of the environment.
void addBackground(Image& image, const Image& withEnvironment) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (float* const pixel = image.at(x, y); !(pixel[3] > 0.5f))
                std::copy_n(withEnvironment.at(x, y), 3, pixel);
}

}  // namespace

bool metersExposure(const Request& request, const Scene& scene, const Lens& lens) {
    if (std::holds_alternative<MeteredExposure>(request.exposure)) return true;
    const bool open = std::holds_alternative<DefaultExposure>(request.exposure);
    return open && lens.exposureTime == 0 && !scene.school && !scene.lights.empty();
}

double meteredExposure(const ImageView& image) {
    std::vector<double> surfaces, background;  // luminances
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* pixel = image.at(x, y);
            const bool surface = pixel[3] > 0.5f;
            const double value = luminance(pixel) / (surface ? pixel[3] : 1);
            if (value > 0 && std::isfinite(value)) (surface ? surfaces : background).push_back(value);
        }
    if (surfaces.empty()) return 0;
    const auto brightest =
        surfaces.begin() + static_cast<std::ptrdiff_t>((1 - brightestShare) * static_cast<double>(surfaces.size() - 1));
    std::nth_element(surfaces.begin(), brightest, surfaces.end());
    const double highlight = std::log2(*brightest);
    const double exposure = std::clamp(std::log2(middleGrey) - logAverage(surfaces),
                                       std::log2(brightestAtLeast) - highlight, std::log2(brightestAtMost) - highlight);
    return background.empty() ? exposure : std::min(exposure, std::log2(backgroundAtMost) - logAverage(background));
}

double meteredExposure(World& world, const View& view, const RenderSettings& settings,
                       const std::filesystem::path& shaderFolder) {
    View small = view;
    small.width = std::min(view.width, meterWidth);
    small.height = std::max(1, view.height * small.width / view.width);
    small.lens.dofEnabled = false;
    RenderSettings few = settings;
    few.sampleCount = meterSamples;
    few.positions = 1;
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f, .shaderFolder = shaderFolder};
    const std::unique_ptr<Renderer> renderer = makeAccumulationRenderer(world, options);
    const auto rendered = [&](bool withEnvironment) {
        const ShownEnvironment shown(world, withEnvironment);
        return imageOf(*renderer, planFrame(world, small, few));
    };
    Image image = rendered(false);
    if (world.environment.type != EnvironmentType::uniform) addBackground(image, rendered(true));
    return meteredExposure(image);
}

std::optional<double> exposureOf(const Request& request) {
    const auto* const value = std::get_if<ExposureValue>(&request.exposure);
    return value != nullptr ? std::optional(value->ev) : std::nullopt;
}

double unmeteredExposure(const Request& request, const Lens& lens) {
    return exposureOf(request).value_or(photographicExposure(lens));
}

double chosenExposure(const Request& request, World& world, const View& view, const RenderSettings& settings,
                      const std::filesystem::path& shaderFolder) {
    return metersExposure(request, *world.scene, view.lens) ? meteredExposure(world, view, settings, shaderFolder)
                                                            : unmeteredExposure(request, view.lens);
}

}  // namespace defocus::engine
