#include "render/layered/layered.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "render/accumulation/layer_sum.h"
#include "render/layered/depth_layers.h"
#include "render/layered/lens_rays.h"
#include "render/post_process/pinhole_pass.h"
#include "render/post_process/post_process.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

// Returns how far beyond the image's edges lens rays may hit surfaces, in px; at most half the image's longer side.
int borderOf(const FramePlan& plan) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects) largest = std::max(largest, object.coc.largest);
    const int max = (std::max(plan.view.width, plan.view.height) + 1) / 2;
    return plan.usesLens ? static_cast<int>(std::min<double>(std::ceil(largest / 2) + 1, max)) : 0;
}

// Returns the number of samples that are drawn together (a wave): `asked`, or, if `asked` is 0, as many as fit into
// RendererOptions::waveBytes. The result is at most `run`, the number of consecutive samples with the same pinhole
// image. `run` is a power of two; so is the result, which therefore divides `run`.
std::uint32_t chosenWave(const FramePlan& plan, const RendererOptions& options, std::uint32_t asked, LayerFormat format,
                         std::uint32_t run) {
    const std::uint64_t pixels = pixelCount(plan.view.width, plan.view.height);
    const std::uint64_t wanted = asked > 0 ? asked : options.waveBytes / (pixels * layerPixelBytes(format));
    return std::bit_floor(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, 1, run)));
}

class LayeredRenderer final : public Renderer {
public:
    LayeredRenderer(const World& world, const RendererOptions& options)
        : options_(options), wave_(options.wave), scene_(world) {}

    void setWave(const WaveLimit& limit) override { wave_ = limit.withDefault(options_.wave); }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        if (plan.coc.chromatic > 0 && (plan.usesCocControls || plan.usesOwnBlur))
            fail(
                "method layered: axial chromatic aberration cannot be combined with blur controls, such as "
                "--foreground-limit or --node-blur; leave one out or choose accumulation");
        if (plan.usesLens && plan.coc.aberrates())
            fail("method layered: astigmatism and coma are not supported; leave them out or choose accumulation");
        const auto total = static_cast<std::uint32_t>(plan.samples.size());
        const auto asked = static_cast<std::uint32_t>(numberOf(options_.settings, "pinholes"));
        pinholeCount_ = std::min(asked, total);
        run_ = std::bit_floor(std::min(total / pinholeCount_, blockSamples));
        const int border = borderOf(plan);
        pinholes_ = pinholePlan(scene_.world(), plan, pinholeCount_);
        // Copy the plan, and shift each sample by the subpixel offset of the pinhole image that it reads.
        plan_ = plan;
        plan_.moments.clear();
        for (std::uint32_t i = 0; i < total; ++i) plan_.samples[i].pixel += pinholes_.samples[pinholeOf(i)].pixel;
        pinholes_ = widened(pinholes_, border);
        prepareTargets(border);

        scene_.prepare(pinholes_);
        pinholeFrame_.upload(scene_.world(), pinholes_, 1);
        layers_->prepare(pinholes_, pinholeFrame_);
        frame_.upload(scene_.world(), plan_, waveLayers_->info().count);
        rays_->prepare(plan_, frame_);
        if (drawsSky()) prepareSky();
        peeled_.reset();
        maxLayers_ = 0;
        stats_.trianglesDrawn = 0;
        stats_.peakBytes = std::max<std::uint64_t>(
            stats_.peakBytes, scene_.bytes() + pinholeFrame_.bytes() + frame_.bytes() + layers_->bytes() +
                                  rays_->bytes() + waveLayers_->bytes() + sum_->bytes());
        clock_.beginFrame();
    }

    bool advance() override {
        const std::uint32_t first = sum_->samples();
        const std::uint32_t total = sampleTotal();
        if (first >= total) return false;
        clock_.beginWave();
        const std::uint32_t pinhole = pinholeOf(first);
        if (peeled_ != pinhole) peel(pinhole);
        const std::uint32_t count = std::min(waveLayers_->info().count, total - first);
        waveLayers_->begin();
        rays_->trace(*layers_, pinholes_.samples[pinhole].pixel, first, count);
        if (drawsSky()) drawSky(first, count);
        sum_->add(*waveLayers_, frame_, first, count);
        clock_.endWave();
        if (first + count == total) clock_.endFrame();
        return first + count < total;
    }

    [[nodiscard]] std::uint32_t samples() const override { return sum_ ? sum_->samples() : 0; }
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] Image image() override { return sum_->mean(); }
    [[nodiscard]] const GlTexture* imageTexture() override { return &sum_->meanTexture(); }

    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = stats_;
        stats.samples = samples();
        clock_.fill(stats);
        stats.wave = waveLayers_->info().count;
        stats.layerFormat = layerFormatName(sum_->info().format);
        stats.figures = {{"depth layers", static_cast<double>(maxLayers_)}};
        return stats;
    }

private:
    // Returns the index of the pinhole image that a lens sample uses. Each image is used for run_ consecutive samples,
    // which are well distributed over the lens.
    [[nodiscard]] std::uint32_t pinholeOf(std::uint32_t sample) const {
        return static_cast<std::uint32_t>(std::uint64_t{sample / run_ * run_} * pinholeCount_ / plan_.samples.size());
    }

    void prepareTargets(int border) {
        const LayerFormat format = chosenLayerFormat(scene_.world(), options_.layerFormat);
        const View& view = plan_.view;
        const auto layers = static_cast<std::uint32_t>(numberOf(options_.settings, "layers"));
        const DepthLayersInfo depth{.width = view.width + 2 * border,
                                    .height = view.height + 2 * border,
                                    .layers = layers,
                                    .format = format,
                                    .blended = plan_.usesBlending,
                                    .shaderFolder = options_.shaderFolder};
        if (!layers_ || !(layers_->info() == depth)) {
            layers_.reset();  // free the old layers first: there may not be enough memory for both
            layers_.emplace(scene_, depth);
        }
        const LensRaysInfo rays{.width = view.width,
                                .height = view.height,
                                .border = border,
                                .layers = layers,
                                .format = format,
                                .blended = plan_.usesBlending,
                                .vertexShaderLayers = vertexShaderLayers(),
                                .shaderFolder = options_.shaderFolder};
        if (!rays_ || !(rays_->info() == rays)) {
            rays_.reset();
            rays_.emplace(rays);
        }
        const WaveLayersInfo wave{view.width, view.height, chosenWave(plan_, options_, wave_, format, run_), format};
        if (!waveLayers_ || waveLayers_->info() != wave) {
            waveLayers_.reset();
            sum_.reset();
            waveLayers_.emplace(wave);
            sum_.emplace(LayerSumInfo{view.width, view.height, format, options_.shaderFolder});
        }
        sum_->reset();
    }

    [[nodiscard]] bool vertexShaderLayers() const {
        return vertexShaderMayPickLayer() && !options_.geometryShaderLayers;
    }

    void peel(std::uint32_t pinhole) {
        layers_->peel(pinhole);
        rays_->bound(*layers_);
        peeled_ = pinhole;
        maxLayers_ = std::max(maxLayers_, layers_->count());
        const std::uint32_t passes = std::min(layers_->count() + 1, layers_->info().layers);
        stats_.trianglesDrawn += pinholes_.trianglesDrawn / pinholeCount_ * passes;
    }

    // Returns whether the environment is drawn into the accumulated layers. Environments that are not maps are
    // composited when the layers are added.
    [[nodiscard]] bool drawsSky() const {
        return !plan_.needsAlpha && scene_.world().environment.type == EnvironmentType::map;
    }

    void prepareSky() {
        if (!sky_)
            sky_.emplace(scene_, scene_.pacer(),
                         SurfacePassInfo{.fragmentShader = "accumulation/object.frag",
                                         .defines = layerFormatDefines(sum_->info().format),
                                         .vertexShaderLayers = vertexShaderLayers(),
                                         .shaderFolder = options_.shaderFolder});
        sky_->prepare(withoutObjects(plan_), frame_);
    }

    // Draws the environment behind the content of the layers.
    void drawSky(std::uint32_t first, std::uint32_t count) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
        sky_->drawSky(first, count);
        glDisable(GL_BLEND);
    }

    RendererOptions options_;
    std::uint32_t wave_;  // requested number of samples drawn together; 0: as many as fit into waveBytes
    GpuScene scene_;
    // Plan of the frame. The pixel position of each lens sample includes the subpixel offset of the pinhole image that
    // the sample reads.
    FramePlan plan_;
    FramePlan pinholes_;  // pinhole images: one sample each, larger than the frame by borderOf() px on each side
    std::uint32_t pinholeCount_ = 1;
    std::uint32_t run_ = 1;  // consecutive samples that read the same pinhole image; a divisor of blockSamples
    FrameUniforms pinholeFrame_, frame_;
    std::optional<DepthLayers> layers_;
    std::optional<LensRays> rays_;
    std::optional<WaveLayers> waveLayers_;
    std::optional<LayerSum> sum_;
    std::optional<SurfacePass> sky_;
    std::optional<std::uint32_t> peeled_;  // index of the pinhole image whose layers are in layers_
    std::uint32_t maxLayers_ = 0;
    mutable FrameClock clock_;
    RenderStats stats_;
};

}  // namespace

Method layeredMethod() {
    const std::vector<MethodSetting> settings = {
        {.name = "layers",
         .defaultValue = "8",
         .description = "Maximum number of depth layers",
         .choices = {},
         .min = 1,
         .max = 16},
        pinholesSetting(),
    };
    return {.name = "layered",
            .description = "lens rays through depth layers of pinhole images (Lee, Eisemann and Seidel 2010)",
            .showsThrough = false,
            .drawsMotion = false,
            .settings = settings,
            .best = {{"layers", "16"}, {"pinholes", "16"}},
            .make = [](const World& world, const RendererOptions& options) -> std::unique_ptr<Renderer> {
                return std::make_unique<LayeredRenderer>(world, options);
            }};
}

}  // namespace defocus::engine
