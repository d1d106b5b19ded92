#include "frame/setup/exposure.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "lens/photographic_exposure.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

constexpr double middleGrey = 0.18;
constexpr double brightestAtMost = 1;
constexpr double brightestAtLeast = 0.4;
constexpr double brightestShare = 0.02;
constexpr int meterWidth = 160;  // width of the metered image, px
constexpr std::uint32_t meterSamples = 4;

struct HiddenSurroundings {
    explicit HiddenSurroundings(World& hidden)
        : world(hidden), visible(std::exchange(hidden.environment.visible, false)) {}
    ~HiddenSurroundings() { world.environment.visible = visible; }
    HiddenSurroundings(const HiddenSurroundings&) = delete;
    HiddenSurroundings& operator=(const HiddenSurroundings&) = delete;
    World& world;
    bool visible;
};

}  // namespace

bool metersExposure(const Request& request, const Scene& scene, const Lens& lens) {
    if (std::holds_alternative<MeteredExposure>(request.exposure)) return true;
    const bool open = std::holds_alternative<DefaultExposure>(request.exposure);
    return open && lens.exposureTime == 0 && !scene.school && !scene.lights.empty();
}

double meteredExposure(const ImageView& image) {
    std::vector<double> luminances;
    double logarithms = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* pixel = image.at(x, y);
            if (!(pixel[3] > 0.5f)) continue;
            const double luminance = (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]) / pixel[3];
            if (!(luminance > 0) || !std::isfinite(luminance)) continue;
            luminances.push_back(luminance);
            logarithms += std::log2(luminance);
        }
    if (luminances.empty()) return 0;
    const auto brightest = luminances.begin() + static_cast<std::ptrdiff_t>((1 - brightestShare) *
                                                                            static_cast<double>(luminances.size() - 1));
    std::nth_element(luminances.begin(), brightest, luminances.end());
    const double average = logarithms / static_cast<double>(luminances.size());
    const double highlight = std::log2(*brightest);
    return std::clamp(std::log2(middleGrey) - average, std::log2(brightestAtLeast) - highlight,
                      std::log2(brightestAtMost) - highlight);
}

double meteredExposure(World& world, const View& view, const RenderSettings& settings,
                       const std::filesystem::path& shaderFolder) {
    View small = view;
    small.width = std::min(view.width, meterWidth);
    small.height = std::max(1, view.height * small.width / view.width);
    small.lens.dofEnabled = false;
    RenderSettings few = settings;
    few.sampleCount = meterSamples;
    const HiddenSurroundings hidden(world);
    RendererOptions options;
    options.layerFormat = LayerFormat::rgba32f;
    options.shaderFolder = shaderFolder;
    const std::unique_ptr<Renderer> renderer = methodNamed("accumulation").make(world, options);
    renderer->start(planFrame(world, small, few));
    while (renderer->advance()) {
    }
    return meteredExposure(renderer->image());
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
