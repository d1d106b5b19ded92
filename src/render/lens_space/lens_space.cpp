#include "render/lens_space/lens_space.h"

#include <algorithm>
#include <optional>

#include "gl/read_back.h"
#include "render/lens_space/ray_sum.h"
#include "render/lens_space/record_buffer.h"
#include "render/lens_space/record_shading.h"
#include "render/lens_space/see_through.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

class LensSpaceRenderer final : public Renderer {
public:
    LensSpaceRenderer(const World& world, const RendererOptions& options, std::unique_ptr<VisibilityKernel> kernel)
        : options_(options), wave_(options.wave), kernel_(std::move(kernel)), scene_(world) {}

    void setWave(const WaveLimit& limit) override { wave_ = limit.withDefault(options_.wave); }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        plan_ = plan;
        if (!front_) {
            front_.emplace(scene_, LensFrontOptions{kernel_->tileSize(), kernel_->lightsVertices(),
                                                    options_.settings.at("coc-interpolation") == "divided",
                                                    options_.waveBytes, options_.shaderFolder});
            shading_.emplace(scene_, options_.shaderFolder);
            seeThrough_.emplace(options_.shaderFolder, kernel_->tileSize());
        }
        scene_.prepare(plan_);
        frame_.upload(scene_.world(), plan_, 1);
        front_->prepare(plan_, frame_, kernel_->name());
        const RaySets sets = kernel_->raySets(plan_, front_->parts());
        rays_ = Buffer::of(std::span<const GpuRay>(sets.table));
        ShaderDefines rayDefines = kernel_->rayDefines();
        rayDefines.emplace_back("rayVariants", std::to_string(sets.variants) + "u");
        prepareSum();
        ShaderDefines defines = front_->defines();
        defines.insert(defines.end(), rayDefines.begin(), rayDefines.end());
        kernel_->start(plan_, sets, defines);
        shading_->prepare(plan_, *front_, defines);
        seeThrough_->prepare(plan_, *front_, defines);
        searches_ = 0;
        records_ = 0;
        stats_ = {};
        part_.reset();
        clock_.beginFrame();
    }

    bool advance() override {
        const std::uint32_t first = sum_->rays();
        const std::uint32_t total = sampleTotal();
        if (first >= total) return false;
        RayWave wave = nextWave(first, total);
        clock_.beginWave();
        const std::uint32_t part = partOf(first, total);
        frame_.bind(first);
        if (part_ != part) {
            front_->pose(part);
            shading_->shadeVertices(*front_);
        }
        part_ = part;
        frame_.bind(first);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, rays_.name());
        const std::uint64_t records = kernel_->find(*front_, wave);
        kernel_->bindRecords();
        frame_.bind(first);
        searches_ += seeThrough_->resolve(*front_, *shading_, records, first);
        records_ += records;
        frame_.bind(first);
        shading_->shade(*front_, records, first);
        kernel_->bindRecords();
        sum_->add(wave.count);
        clock_.endWave();
        stats_.trianglesDrawn = front_->triangleCount();
        stats_.peakBytes = std::max<std::uint64_t>(stats_.peakBytes, scene_.bytes() + frame_.bytes() + front_->bytes() +
                                                                         shading_->bytes() + kernel_->bytes() +
                                                                         rays_.bytes() + sum_->bytes());
        if (first + wave.count == total) clock_.endFrame();
        return first + wave.count < total;
    }

    [[nodiscard]] std::uint32_t samples() const override { return sum_ ? sum_->rays() : 0; }
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] Image image() override { return readBack(sum_->mean(), 4); }
    [[nodiscard]] const GlTexture* imageTexture() override { return &sum_->mean(); }

    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = stats_;
        stats.samples = samples();
        clock_.fill(stats);
        stats.wave = wavesRays();
        stats.layerFormat = "rgba32f";
        if (front_) {
            const BinStatistics& bins = front_->statistics();
            stats.figures = {{"triangles in all tiles", static_cast<double>(bins.entries)},
                             {"triangles in the fullest tile", static_cast<double>(bins.largestTile)},
                             {"bytes of the tiles' lists of triangles", static_cast<double>(bins.bytes)},
                             {"bands of tiles", static_cast<double>(front_->bands().size())}};
            if (searches_ > 0)
                stats.figures.push_back({"see-through hits per shaded point",
                                         static_cast<double>(searches_) / static_cast<double>(records_)});
        }
        kernel_->addTo(stats);
        return stats;
    }

private:
    void prepareSum() {
        const glm::ivec2 size(plan_.view.width, plan_.view.height);
        if (!sum_ || sumSize_ != size) {
            sum_.reset();  // free the old sum first: memory might not suffice for old and new sums
            sum_.emplace(size.x, size.y, kernel_->addShader(), options_.shaderFolder);
            sumSize_ = size;
        }
        sum_->reset();
    }

    // Returns the number of rays per pixel that are traced together (a wave): the requested number, or as many as fit
    // into RendererOptions::waveBytes, at most 64.
    [[nodiscard]] std::uint32_t wavesRays() const {
        const std::uint64_t pixels = pixelCount(plan_.view.width, plan_.view.height);
        const std::uint64_t bytes = std::min(options_.waveBytes, largestStorage());
        const std::uint64_t max = std::max<std::uint64_t>(bytes / (pixels * kernel_->rayBytes()), 1);
        return static_cast<std::uint32_t>(std::min<std::uint64_t>({wave_ > 0 ? wave_ : max, max, blockSamples}));
    }

    // Returns the index of the part of the exposure to which ray `ray` of each pixel belongs.
    [[nodiscard]] std::uint32_t partOf(std::uint32_t ray, std::uint32_t total) const {
        return static_cast<std::uint32_t>(std::uint64_t{ray} * front_->parts() / total);
    }

    // Returns the batch (wave) of rays that starts at ray `first`. A batch does not extend across the end of a block of
    // 64 samples or of a part of the exposure.
    [[nodiscard]] RayWave nextWave(std::uint32_t first, std::uint32_t total) const {
        RayWave wave{first, std::min({wavesRays(), total - first, blockSamples - first % blockSamples})};
        while (partOf(first + wave.count - 1, total) != partOf(first, total)) --wave.count;
        return wave;
    }

    RendererOptions options_;
    std::uint32_t wave_;  // requested rays per pixel that are traced together; 0: as many as fit into waveBytes
    std::unique_ptr<VisibilityKernel> kernel_;
    GpuScene scene_;
    FramePlan plan_;
    FrameUniforms frame_;
    std::optional<LensFront> front_;
    std::optional<RecordShading> shading_;
    std::optional<SeeThrough> seeThrough_;
    std::uint64_t searches_ = 0;  // number of rays that continued behind a hit, over all batches so far
    std::uint64_t records_ = 0;
    std::optional<RaySum> sum_;
    glm::ivec2 sumSize_{0};
    Buffer rays_;
    std::optional<std::uint32_t> part_;  // part of the exposure for which vertices are posed
    mutable FrameClock clock_;
    RenderStats stats_;
};

}  // namespace

MethodSetting shadingSetting() {
    return {
        .name = "shading",
        .defaultValue = "surfaces",
        .description =
            "Where surfaces are shaded. surfaces: at their visible points. vertices: at the vertices of the mesh, as "
            "in Tzeng et al. 2012",
        .choices = {"surfaces", "vertices"}};
}

MethodSetting cocInterpolationSetting() {
    return {.name = "coc-interpolation",
            .defaultValue = "divided",
            .description =
                "How the circle of confusion is computed inside a triangle. divided: triangles across which it is not "
                "linear are subdivided. linear: interpolated linearly between the corners, as in Munkberg et al. 2012",
            .choices = {"divided", "linear"}};
}

std::unique_ptr<Renderer> makeLensSpaceRenderer(const World& world, const RendererOptions& options,
                                                std::unique_ptr<VisibilityKernel> kernel) {
    return std::make_unique<LensSpaceRenderer>(world, options, std::move(kernel));
}

}  // namespace defocus::engine
