#include "embree/embree_renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "embree/aperture_mask.h"
#include "embree/packet_rays.h"
#include "embree/packet_samples.h"
#include "embree/packet_shading.h"
#include "embree/traced_scene.h"
#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

// Lens samples per call of advance(). For each tile, a thread traces all of these samples in succession, because the
// geometry that the tile shows then stays in the CPU cache.
constexpr std::uint32_t samplesPerWave = 16;

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr float infinitelyFar = std::numeric_limits<float>::infinity();

// Seeds that scramble the sample points of each pixel of a tile.
struct TileSeeds {
    std::array<ReversedLanes, packetsPerTile> pixel;
    std::array<ReversedLanes, packetsPerTile> lens;
};

// The part of a lens sample's data that all tiles share.
struct WaveSample {
    std::uint32_t index = 0;  // index of the lens sample in the sequence
    // Sample points that all pixels share (unused with EmbreeSampling::perPixel): in the pixel ([0, 1)² px, right and
    // down), and on the lens (unit disk).
    glm::dvec2 pixel{0};
    glm::dvec2 lens{0};
    glm::vec2 light{0.5f};  // sample point on each light, in [0, 1)²
    // Unscrambled points for EmbreeSampling::perPixel; each pixel scrambles them differently.
    ReversedLanes ownPixel;
    ReversedLanes ownLens;
};

RTCRayHit16 emptyPacket(double nearest) {
    RTCRayHit16 packet{};
    std::fill(std::begin(packet.ray.tnear), std::end(packet.ray.tnear), static_cast<float>(nearest));
    std::fill(std::begin(packet.ray.mask), std::end(packet.ray.mask), ~0u);
    std::fill(std::begin(packet.hit.geomID), std::end(packet.hit.geomID), RTC_INVALID_GEOMETRY_ID);
    return packet;
}

void setRay(RTCRayHit16& packet, int lane, const LensRay& ray, double nearest) {
    packet.ray.org_x[lane] = ray.origin.x;
    packet.ray.org_y[lane] = ray.origin.y;
    packet.ray.org_z[lane] = ray.origin.z;
    packet.ray.dir_x[lane] = ray.direction.x;
    packet.ray.dir_y[lane] = ray.direction.y;
    packet.ray.dir_z[lane] = ray.direction.z;
    packet.ray.tnear[lane] = static_cast<float>(nearest);
}

PacketPoints samePoints(const glm::dvec2& pixel, const glm::dvec2& lens) {
    PacketPoints points;
    points.pixelX.values.fill(static_cast<float>(pixel.x));
    points.pixelY.values.fill(static_cast<float>(pixel.y));
    points.lensX.values.fill(static_cast<float>(lens.x));
    points.lensY.values.fill(static_cast<float>(lens.y));
    return points;
}

// Throws Error for artistic blur controls other than the foreground limit: no physical lens reproduces them.
void checkTraceable(const Lens& lens) {
    Lens plain = lens;
    plain.foregroundLimit = std::numeric_limits<double>::infinity();
    if (!clipCircleOfConfusion(plain, 1, 1).thinLens())
        fail("method embree: of the blur controls, only --foreground-limit is traced");
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
    // First pixel of a tile, and the accumulated colours of the tile's packets.
    struct Tile {
        int left = 0;
        int top = 0;
        PacketSum* sums = nullptr;
    };

    [[nodiscard]] std::uint32_t sampleCount() const;
    [[nodiscard]] int tileColumns() const { return (view_.width + tileSide - 1) / tileSide; }
    [[nodiscard]] int tileRows() const { return (view_.height + tileSide - 1) / tileSide; }
    [[nodiscard]] bool ownSamples() const { return sampling_ == EmbreeSampling::perPixel; }

    [[nodiscard]] WaveSample waveSample(std::uint32_t sample) const;
    [[nodiscard]] std::uint32_t firstStream(const Tile& tile, int place) const;
    [[nodiscard]] TileSeeds tileSeeds(const Tile& tile) const;
    [[nodiscard]] PacketPoints ownPoints(const Tile& tile, int place, const TileSeeds& seeds,
                                         const WaveSample& sample) const;
    [[nodiscard]] std::array<glm::vec2, packetSize> lightPointsOf(const Tile& tile, int place,
                                                                  const WaveSample& sample) const;
    [[nodiscard]] LaneMask lanesInside(const Tile& tile, int place) const;
    void traceLimited(const Tile& tile, int place, const PacketPoints& points, const LaneMask& mask,
                      RTCRayHit16& packet) const;
    void traceSample(const Tile& tile, const TileSeeds& seeds, const WaveSample& sample, RTCRayHit16& packet);
    void traceTile(int number, std::span<const WaveSample> wave);

    const World& world_;
    EmbreeSampling sampling_;
    View view_;
    RenderSettings settings_;
    bool castsShadows_ = false;
    std::vector<LensSample> planned_;  // lens samples of the plan; used only with EmbreeSampling::planned
    LensCamera camera_;
    std::optional<ApertureMask> mask_;  // aperture mask; nullopt if ApertureMask::isNeeded is false
    ApertureMap aperture_{Lens{}};      // maps sample points to the aperture; used if mask_ is empty
    std::unique_ptr<TracedScene> scene_;
    std::unique_ptr<PacketShading> shading_;
    glm::dmat4 tracedFrom_{0.0};   // camera matrix for which scene_ was built
    std::vector<PacketSum> sums_;  // accumulated colours of all packets; the packets of a tile are consecutive
    std::uint32_t samples_ = 0;
    double setupMilliseconds_ = 0;
    double renderMilliseconds_ = 0;
};

void EmbreeRenderer::start(const FramePlan& plan) {
    if (world_.environment.type == EnvironmentType::map) fail("method embree: environment maps are not traced");
    checkTraceable(plan.view.lens);
    if (plan.usesOwnBlur) fail("method embree: blur that objects or vertices have themselves is not traced");
    view_ = plan.view;
    settings_ = plan.settings;
    castsShadows_ = !plan.shadows.maps.empty();
    if (sampling_ == EmbreeSampling::planned) planned_ = plan.samples;
    camera_ = lensCamera(view_);
    mask_.reset();
    if (ApertureMask::isNeeded(view_.lens) && sampling_ != EmbreeSampling::planned) mask_.emplace(view_.lens);
    aperture_ = ApertureMap(view_.lens);
    if (!scene_ || tracedFrom_ != view_.worldFromCamera) {
        const Clock::time_point begin = Clock::now();
        shading_.reset();
        scene_.reset();
        const TraceOptions options{.watertight = sampling_ == EmbreeSampling::planned, .coherent = !ownSamples()};
        scene_ = std::make_unique<TracedScene>(world_, view_.worldFromCamera, options);
        shading_ = std::make_unique<PacketShading>(world_, *scene_, glm::dmat3(view_.worldFromCamera));
        tracedFrom_ = view_.worldFromCamera;
        setupMilliseconds_ += millisecondsSince(begin);
    }
    sums_.assign(static_cast<std::size_t>(tileColumns()) * static_cast<std::size_t>(tileRows()) * packetsPerTile, {});
    samples_ = 0;
    renderMilliseconds_ = 0;
}

std::uint32_t EmbreeRenderer::sampleCount() const {
    return sampling_ == EmbreeSampling::planned ? static_cast<std::uint32_t>(planned_.size()) : settings_.sampleCount;
}

// ---- sample points of the pixels ------------------------------------------------------------------------------------

WaveSample EmbreeRenderer::waveSample(std::uint32_t number) const {
    WaveSample sample;
    sample.index = settings_.firstSample + number;
    sample.light = sampling_ == EmbreeSampling::planned
                       ? planned_[number].light
                       : glm::vec2(sequencePoint(Sequence::sobol, sample.index, settings_.seed).light);
    if (sampling_ == EmbreeSampling::planned) {
        const LensSample& planned = planned_[number];
        sample.pixel = {0.5 + planned.pixel.x, 0.5 - planned.pixel.y};
        sample.lens = glm::dvec2(planned.lens);
    } else if (sampling_ == EmbreeSampling::shared) {
        sample.pixel = scrambledPoint(sample.index, 0, SamplePair::pixel, settings_.seed);
        sample.lens =
            mask_ ? mask_->lensPoint(sample.index, 0, settings_.seed)
                  : aperturePoint(view_.lens, scrambledPoint(sample.index, 0, SamplePair::lens, settings_.seed));
    } else {
        sample.ownPixel = unscrambledPoints(sample.index, SamplePair::pixel, settings_.seed);
        sample.ownLens = unscrambledPoints(sample.index, SamplePair::lens, settings_.seed);
    }
    return sample;
}

// Returns the scramble index (stream) of a packet's first pixel. Every pixel has a different stream. Pixels are
// numbered packet by packet; `place` is the packet's index in the tile.
std::uint32_t EmbreeRenderer::firstStream(const Tile& tile, int place) const {
    const int column = tile.left / packetSide + place % packetsPerTileRow;
    const int row = tile.top / packetSide + place / packetsPerTileRow;
    return static_cast<std::uint32_t>((row * tileColumns() * packetsPerTileRow + column) * packetSize);
}

TileSeeds EmbreeRenderer::tileSeeds(const Tile& tile) const {
    TileSeeds seeds;
    if (!ownSamples()) return seeds;
    for (int place = 0; place < packetsPerTile; ++place) {
        const auto at = static_cast<std::size_t>(place);
        const std::uint32_t stream = firstStream(tile, place);
        seeds.pixel[at] = packetSeeds(stream, SamplePair::pixel, settings_.seed);
        seeds.lens[at] = packetSeeds(stream, SamplePair::lens, settings_.seed);
    }
    return seeds;
}

PacketPoints EmbreeRenderer::ownPoints(const Tile& tile, int place, const TileSeeds& seeds,
                                       const WaveSample& sample) const {
    const auto at = static_cast<std::size_t>(place);
    PacketPoints points;
    scramblePoints(sample.ownPixel, seeds.pixel[at], points.pixelX, points.pixelY);
    if (!mask_) {
        scramblePoints(sample.ownLens, seeds.lens[at], points.lensX, points.lensY);
        mapToAperture(aperture_, points.lensX, points.lensY);
        return points;
    }
    for (int i = 0; i < packetSize; ++i) {
        const std::uint32_t stream = firstStream(tile, place) + static_cast<std::uint32_t>(i);
        const glm::vec2 lens(mask_->lensPoint(sample.index, stream, settings_.seed));
        points.lensX[i] = lens.x;
        points.lensY[i] = lens.y;
    }
    return points;
}

// Returns the light sample point of each pixel of the packet, in [0, 1)². All pixels use the light point of the lens
// sample; with EmbreeSampling::perPixel, each pixel shifts this point by its own offset, modulo 1 (Cranley and
// Patterson 1976).
std::array<glm::vec2, packetSize> EmbreeRenderer::lightPointsOf(const Tile& tile, int place,
                                                                const WaveSample& sample) const {
    std::array<glm::vec2, packetSize> points;
    points.fill(sample.light);
    if (!ownSamples()) return points;
    for (int i = 0; i < packetSize; ++i) {
        const std::uint32_t stream = firstStream(tile, place) + static_cast<std::uint32_t>(i);
        const glm::vec2 shift(glm::dvec2(radicalInverse(2, stream), radicalInverse(3, stream)));
        points[static_cast<std::size_t>(i)] = glm::fract(sample.light + shift);
    }
    return points;
}

// ---- ray tracing ----------------------------------------------------------------------------------------------------

LaneMask EmbreeRenderer::lanesInside(const Tile& tile, int place) const {
    const int left = tile.left + place % packetsPerTileRow * packetSide;
    const int top = tile.top + place / packetsPerTileRow * packetSide;
    LaneMask mask;
    for (int i = 0; i < packetSize; ++i)
        mask[i] = left + i % packetSide < view_.width && top + i / packetSide < view_.height ? -1 : 0;
    return mask;
}

// Traces a packet for a camera that limits the blur in the foreground. The limit is modelled by a separate lens for
// each pixel, at depth LensCamera::lensDepth (lens_rays.h). Rays first go from the eye to their pixel's lens. Rays that
// hit nothing on the way are refracted by this lens and continue behind it.
void EmbreeRenderer::traceLimited(const Tile& tile, int place, const PacketPoints& points, const LaneMask& mask,
                                  RTCRayHit16& packet) const {
    const int left = tile.left + place % packetsPerTileRow * packetSide;
    const int top = tile.top + place / packetsPerTileRow * packetSide;
    std::array<LensRay, packetSize> behind;
    for (int i = 0; i < packetSize; ++i) {
        const glm::ivec2 pixel(left + i % packetSide, top + i / packetSide);
        const glm::dvec2 at(pixel.x + static_cast<double>(points.pixelX[i]),
                            pixel.y + static_cast<double>(points.pixelY[i]));
        const glm::dvec2 image(2 * at.x / view_.width - 1, 1 - 2 * at.y / view_.height);
        const LensRay eye = eyeRay(camera_, image, {points.lensX[i], points.lensY[i]});
        behind[static_cast<std::size_t>(i)] = refractedRay(camera_, image, eye);
        setRay(packet, i, eye, view_.nearPlane);
    }
    scene_->trace(mask, static_cast<float>(camera_.lensDepth), packet);

    LaneMask missed;
    for (int i = 0; i < packetSize; ++i) {
        if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID || mask[i] == 0) continue;
        missed[i] = -1;
        setRay(packet, i, behind[static_cast<std::size_t>(i)], std::max(0.0, view_.nearPlane - camera_.lensDepth));
    }
    scene_->trace(missed, infinitelyFar, packet);
}

void EmbreeRenderer::traceSample(const Tile& tile, const TileSeeds& seeds, const WaveSample& sample,
                                 RTCRayHit16& packet) {
    const TileRays rays = tileRays(camera_, view_, tile.left, tile.top, sample.pixel, sample.lens);
    for (int place = 0; place < packetsPerTile; ++place) {
        const LaneMask mask = lanesInside(tile, place);
        if (mask[0] == 0) continue;
        PacketPoints points;
        if (ownSamples())
            points = ownPoints(tile, place, seeds, sample);
        else if (camera_.lensDepth > 0)
            points = samePoints(sample.pixel, sample.lens);

        if (camera_.lensDepth > 0) {
            traceLimited(tile, place, points, mask, packet);
        } else {
            if (ownSamples())
                makeRays(rays, place, camera_, view_, points, packet);
            else
                makeRays(rays, place, packet);
            scene_->trace(mask, infinitelyFar, packet);
        }
        if (castsShadows_) {
            const std::array<glm::vec2, packetSize> lightPoints = lightPointsOf(tile, place, sample);
            addTo(tile.sums[place], shading_->radiance(packet, &lightPoints));
        } else {
            addTo(tile.sums[place], shading_->radiance(packet));
        }
    }
}

void EmbreeRenderer::traceTile(int number, std::span<const WaveSample> wave) {
    const Tile tile{.left = number % tileColumns() * tileSide,
                    .top = number / tileColumns() * tileSide,
                    .sums = sums_.data() + static_cast<std::size_t>(number) * packetsPerTile};
    const TileSeeds seeds = tileSeeds(tile);
    RTCRayHit16 packet = emptyPacket(view_.nearPlane);
    for (const WaveSample& sample : wave) traceSample(tile, seeds, sample, packet);
}

bool EmbreeRenderer::advance() {
    if (samples_ >= sampleCount()) return false;
    const Clock::time_point begin = Clock::now();
    const std::uint32_t count = std::min(samplesPerWave, sampleCount() - samples_);
    std::vector<WaveSample> wave;
    for (std::uint32_t i = 0; i < count; ++i) wave.push_back(waveSample(samples_ + i));
    parallelFor(static_cast<std::size_t>(tileColumns()) * static_cast<std::size_t>(tileRows()),
                [&](std::size_t tile) { traceTile(static_cast<int>(tile), wave); });
    samples_ += count;
    renderMilliseconds_ += millisecondsSince(begin);
    return samples_ < sampleCount();
}

Image EmbreeRenderer::image() {
    if (samples_ == 0) fail("method embree: no sample has been traced yet");
    Image result(view_.width, view_.height, 4);
    for (int y = 0; y < view_.height; ++y)
        for (int x = 0; x < view_.width; ++x) {
            const int tile = y / tileSide * tileColumns() + x / tileSide;
            const int place = y % tileSide / packetSide * packetsPerTileRow + x % tileSide / packetSide;
            const PacketSum& sum =
                sums_[static_cast<std::size_t>(tile) * packetsPerTile + static_cast<std::size_t>(place)];
            const int lane = y % packetSide * packetSide + x % packetSide;
            for (std::size_t c = 0; c < 4; ++c)
                result.at(x, y)[c] = static_cast<float>(sum.channels[c][lane] / static_cast<double>(samples_));
        }
    return result;
}

RenderStats EmbreeRenderer::stats() const {
    RenderStats stats;
    stats.samples = samples_;
    stats.setupMilliseconds = setupMilliseconds_;
    stats.renderMilliseconds = renderMilliseconds_;
    stats.peakBytes = (scene_ ? scene_->peakBytes() + shading_->bytes() : 0) + sums_.size() * sizeof(PacketSum);
    stats.wave = samplesPerWave;
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
                            .shadesAsLit = false,
                            .showsThrough = false,
                            .drawsMotion = false,
                            .aperture = ApertureShown::shape,
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

}  // namespace defocus::engine
