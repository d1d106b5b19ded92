#include "embree/embree_renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <optional>
#include <thread>

#include "core/error.h"
#include "core/parallel.h"
#include "embree/aperture_mask.h"
#include "embree/lens_rays.h"
#include "embree/traced_scene.h"
#include "embree/traced_shading.h"
#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus {

namespace {

constexpr int tileSize = 16;  // px; a tile's rays go to Embree as one stream

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

RTCRayHit rayOf(const LensRay& ray, double nearest, double farthest) {
    RTCRayHit traced{};
    traced.ray.org_x = ray.origin.x;
    traced.ray.org_y = ray.origin.y;
    traced.ray.org_z = ray.origin.z;
    traced.ray.dir_x = ray.direction.x;
    traced.ray.dir_y = ray.direction.y;
    traced.ray.dir_z = ray.direction.z;
    traced.ray.tnear = static_cast<float>(nearest);
    traced.ray.tfar = static_cast<float>(farthest);
    traced.ray.mask = ~0u;
    traced.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return traced;
}

// Of what bends the blur to an artist's will, only the limit of the foreground has a lens that does the same.
void checkTraceable(const Lens& lens) {
    Lens plain = lens;
    plain.foregroundLimit = std::numeric_limits<double>::infinity();
    if (!clipCircleOfConfusion(plain, 1, 1).thinLens())
        fail("method embree: of the controls of the blur, only --foreground-limit is traced");
    if (lens.foregroundLimit == 0)
        fail("method embree: a foreground limit of 0 px would put the lens into the focus plane; trace a small one");
}

class EmbreeRenderer final : public Renderer {
public:
    EmbreeRenderer(const World& world, EmbreeSampling sampling) : world_(world), sampling_(sampling) {}

    void start(const FramePlan& plan) override;
    bool advance() override;
    [[nodiscard]] std::uint32_t samples() const override { return samples_; }
    [[nodiscard]] std::uint32_t sampleTotal() const override { return sampleCount(); }
    [[nodiscard]] Image image() override;
    [[nodiscard]] RenderStats stats() const override;

private:
    // The image point ([-1, 1]², right and up) and the lens point of a pixel's sample.
    struct SamplePoints {
        glm::dvec2 image{0};
        glm::dvec2 lens{0};
    };

    [[nodiscard]] std::uint32_t sampleCount() const;
    // Where the sample lies in its pixel (px, right and down) and on the lens.
    struct SampleOffset {
        glm::dvec2 pixel{0};
        glm::dvec2 lens{0};
    };

    [[nodiscard]] SampleOffset sampleOffset(std::uint32_t stream, std::uint32_t sample) const;
    [[nodiscard]] SamplePoints samplePoints(int x, int y, const SampleOffset& offset) const;
    [[nodiscard]] RTCRayHit cameraRay(const SamplePoints& points) const;
    [[nodiscard]] RTCRayHit rayBehindLens(const SamplePoints& points) const;
    void traceBehindLens(std::span<const SamplePoints> points, std::span<RTCRayHit> rays) const;
    [[nodiscard]] glm::vec4 radiance(const RTCRayHit& ray) const;
    void traceTile(int tile, std::uint32_t sample);

    const World& world_;
    EmbreeSampling sampling_;
    View view_;
    RenderSettings settings_;
    std::vector<LensSample> planned_;  // EmbreeSampling::planned only
    LensCamera camera_;
    std::optional<ApertureMask> mask_;  // of apertures that need one
    glm::dmat3 worldFromCamera_{1.0};
    std::unique_ptr<TracedScene> scene_;
    glm::dmat4 tracedFrom_{0.0};  // the camera that scene_ was built for
    std::vector<glm::dvec4> sum_;
    std::uint32_t samples_ = 0;
    double setupMilliseconds_ = 0;
    double renderMilliseconds_ = 0;
};

void EmbreeRenderer::start(const FramePlan& plan) {
    if (world_.environment.type == EnvironmentType::map) fail("method embree: environment maps are not traced");
    checkTraceable(plan.view.lens);
    view_ = plan.view;
    settings_ = plan.settings;
    if (sampling_ == EmbreeSampling::planned) planned_ = plan.samples;
    camera_ = lensCamera(view_);
    mask_.reset();
    if (ApertureMask::isNeeded(view_.lens) && sampling_ != EmbreeSampling::planned) mask_.emplace(view_.lens);
    worldFromCamera_ = glm::dmat3(view_.worldFromCamera);
    if (!scene_ || tracedFrom_ != view_.worldFromCamera) {
        const Clock::time_point begin = Clock::now();
        scene_.reset();
        scene_ = std::make_unique<TracedScene>(world_, view_.worldFromCamera);
        tracedFrom_ = view_.worldFromCamera;
        setupMilliseconds_ += millisecondsSince(begin);
    }
    sum_.assign(static_cast<std::size_t>(view_.width) * static_cast<std::size_t>(view_.height), glm::dvec4(0));
    samples_ = 0;
    renderMilliseconds_ = 0;
}

std::uint32_t EmbreeRenderer::sampleCount() const {
    return sampling_ == EmbreeSampling::planned ? static_cast<std::uint32_t>(planned_.size()) : settings_.sampleCount;
}

EmbreeRenderer::SampleOffset EmbreeRenderer::sampleOffset(std::uint32_t stream, std::uint32_t sample) const {
    if (sampling_ == EmbreeSampling::planned) {
        const LensSample& planned = planned_[sample];
        return {{0.5 + planned.pixel.x, 0.5 - planned.pixel.y}, glm::dvec2(planned.lens)};
    }
    const std::uint32_t index = settings_.firstSample + sample;
    return {scrambledPoint(index, stream, SamplePair::pixel, settings_.seed),
            mask_ ? mask_->lensPoint(index, stream, settings_.seed)
                  : aperturePoint(view_.lens, scrambledPoint(index, stream, SamplePair::lens, settings_.seed))};
}

EmbreeRenderer::SamplePoints EmbreeRenderer::samplePoints(int x, int y, const SampleOffset& offset) const {
    const glm::dvec2 place = glm::dvec2(x, y) + offset.pixel;  // px from the image's top left corner
    return {{2 * place.x / view_.width - 1, 1 - 2 * place.y / view_.height}, offset.lens};
}

RTCRayHit EmbreeRenderer::cameraRay(const SamplePoints& points) const {
    if (camera_.lensDepth == 0)
        return rayOf(lensRay(camera_, points.image, points.lens), view_.nearPlane,
                     std::numeric_limits<double>::infinity());
    return rayOf(eyeRay(camera_, points.image, points.lens), view_.nearPlane, camera_.lensDepth);
}

RTCRayHit EmbreeRenderer::rayBehindLens(const SamplePoints& points) const {
    const LensRay eye = eyeRay(camera_, points.image, points.lens);
    return rayOf(refractedRay(camera_, points.image, eye), std::max(0.0, view_.nearPlane - camera_.lensDepth),
                 std::numeric_limits<double>::infinity());
}

glm::vec4 EmbreeRenderer::radiance(const RTCRayHit& ray) const {
    if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) return {surfaceRadiance(world_, *scene_, ray), 1};
    if (world_.environment.type == EnvironmentType::none || !world_.environment.visible) return glm::vec4(0);
    const glm::dvec3 direction(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
    return {backgroundRadiance(world_.environment, worldFromCamera_ * direction), 1};
}

// Goes on with those rays that met nothing before the lens.
void EmbreeRenderer::traceBehindLens(std::span<const SamplePoints> points, std::span<RTCRayHit> rays) const {
    std::array<RTCRayHit, tileSize * tileSize> behind;
    std::array<std::size_t, tileSize * tileSize> places{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (rays[i].hit.geomID != RTC_INVALID_GEOMETRY_ID) continue;
        places[count] = i;
        behind[count++] = rayBehindLens(points[i]);
    }
    if (count > 0) scene_->trace(std::span(behind).first(count));
    for (std::size_t i = 0; i < count; ++i) rays[places[i]] = behind[i];
}

void EmbreeRenderer::traceTile(int tile, std::uint32_t sample) {
    const int columns = (view_.width + tileSize - 1) / tileSize;
    const int left = tile % columns * tileSize;
    const int top = tile / columns * tileSize;
    const int right = std::min(left + tileSize, view_.width);
    const int bottom = std::min(top + tileSize, view_.height);

    std::array<SamplePoints, tileSize * tileSize> points;
    std::array<RTCRayHit, tileSize * tileSize> rays;
    std::size_t count = 0;
    const SampleOffset shared = sampleOffset(0, sample);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const bool own = sampling_ == EmbreeSampling::perPixel;
            const auto stream = static_cast<std::uint32_t>(y * view_.width + x);
            points[count] = samplePoints(x, y, own ? sampleOffset(stream, sample) : shared);
            rays[count] = cameraRay(points[count]);
            ++count;
        }
    }
    scene_->trace(std::span(rays).first(count));
    if (camera_.lensDepth > 0) traceBehindLens(std::span(points).first(count), std::span(rays).first(count));
    const RTCRayHit* ray = rays.data();
    for (int y = top; y < bottom; ++y) {
        glm::dvec4* row = sum_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width);
        for (int x = left; x < right; ++x) row[x] += glm::dvec4(radiance(*ray++));
    }
}

bool EmbreeRenderer::advance() {
    if (samples_ >= sampleCount()) return false;
    const Clock::time_point begin = Clock::now();
    const int columns = (view_.width + tileSize - 1) / tileSize;
    const int rows = (view_.height + tileSize - 1) / tileSize;
    parallelFor(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                [&](std::size_t tile) { traceTile(static_cast<int>(tile), samples_); });
    ++samples_;
    renderMilliseconds_ += millisecondsSince(begin);
    return samples_ < sampleCount();
}

Image EmbreeRenderer::image() {
    if (samples_ == 0) fail("method embree: no sample has been traced yet");
    Image result(view_.width, view_.height, 4);
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const glm::vec4 mean(sum_[i] / static_cast<double>(samples_));
        for (glm::length_t c = 0; c < 4; ++c) result.pixels[4 * i + static_cast<std::size_t>(c)] = mean[c];
    }
    return result;
}

RenderStats EmbreeRenderer::stats() const {
    RenderStats stats;
    stats.samples = samples_;
    stats.setupMilliseconds = setupMilliseconds_;
    stats.renderMilliseconds = renderMilliseconds_;
    stats.peakBytes = (scene_ ? scene_->peakBytes() : 0) + sum_.size() * sizeof(glm::dvec4);
    stats.wave = 1;
    stats.layerFormat = "double";
    stats.device = fmt::format("CPU, {} threads", std::max(1u, std::thread::hardware_concurrency()));
    stats.driver = "Embree " RTC_VERSION_STRING;
    return stats;
}

}  // namespace

std::unique_ptr<Renderer> makeEmbreeRenderer(const World& world, EmbreeSampling sampling) {
    return std::make_unique<EmbreeRenderer>(world, sampling);
}

void registerEmbree() {
    static const bool registered = [] {
        const auto add = [](const char* name, const char* description, EmbreeSampling sampling) {
            registerMethod({.name = name,
                            .description = description,
                            .needsGl = false,
                            .settings = {},
                            .make = [sampling](const World& world, const RendererOptions&) {
                                return makeEmbreeRenderer(world, sampling);
                            }});
        };
        add("embree", "Embree thin-lens ray tracer, own lens samples in every pixel", EmbreeSampling::perPixel);
        add("embree-shared", "Embree thin-lens ray tracer, one lens sample for all pixels at a time",
            EmbreeSampling::shared);
        add("embree-planned", "Embree thin-lens ray tracer, at the lens samples of the plan", EmbreeSampling::planned);
        return true;
    }();
    static_cast<void>(registered);
}

}  // namespace defocus
