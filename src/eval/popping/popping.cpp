// Measures popping: visible jumps between levels of detail, discussed by Jeong, Kim and Lee 2011, Multi-Resolution
// Depth-of-Field Rendering.

#include "eval/popping/popping.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "image/metrics.h"
#include "image/tone_map.h"
#include "render/accumulation/accumulation.h"
#include "render/aov/aov.h"
#include "render/pops/level_change.h"

namespace defocus::engine {

namespace {

LodMode levelsOf(PoppingMode mode) {
    switch (mode) {
        case PoppingMode::nearest:
            return LodMode::nearest;
        case PoppingMode::continuous:
            return LodMode::continuous;
        default:
            return LodMode::fractional;
    }
}

// The renderers of all level-of-detail modes. Their layers (textures with the images of single samples) are precise
// enough that rounding doesn't affect the results.
struct Renderers {
    std::unique_ptr<Renderer> accumulation;
    std::unique_ptr<Renderer> multirate;
    [[nodiscard]] Renderer& of(PoppingMode mode) const {
        return mode == PoppingMode::multirate ? *multirate : *accumulation;
    }
};

RenderSettings settingsOf(const PoppingOptions& options, std::uint32_t samples, LodMode mode) {
    RenderSettings settings = options.plan;
    settings.sampleCount = samples;
    settings.lod = mode;
    return settings;
}

FramePlan planOf(const World& world, const View& view, const PoppingOptions& options, std::uint32_t samples,
                 LodMode mode) {
    return planFrame(world, view, settingsOf(options, samples, mode));
}

double largestSpeed(const FramePlan& plan, const FramePlan& before) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects)
        if (const ObjectPlan* earlier = objectOf(before, object.object))
            largest = std::max(largest, std::abs(object.lambda - earlier->lambda));
    return largest;
}

// ---- differences between images -------------------------------------------------------------------------------------

double mean(const Image& map, const Image* mask) {
    double sum = 0;
    std::uint64_t values = 0;
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        if (mask != nullptr && !(mask->pixels[i] > 0)) continue;
        sum += static_cast<double>(map.pixels[i]);
        ++values;
    }
    return values > 0 ? sum / static_cast<double>(values) : 0;
}

// Returns the difference between two display-encoded images, over the complete image and over the pixels of `objects`.
Pop popBetween(const Image& expected, const Image& image, const Image& objects) {
    Image difference = image;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= expected.pixels[i];
    Image linear[2] = {expected, image};
    for (Image& side : linear)
        for (float& value : side.pixels) value = srgbDecode(value);
    const Image flip = flipErrorMap(linear[0], linear[1]);
    return {{rootMeanSquare(difference, nullptr), mean(flip, nullptr)},
            {rootMeanSquare(difference, &objects), mean(flip, &objects)}};
}

// Returns I_{t−1} + (R_t − R_{t−1}): the previous frame I plus the change in the full-detail frames R.
Image carriedOn(const Image& before, const Image& reference, const Image& referenceBefore) {
    Image result = before;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] += reference.pixels[i] - referenceBefore.pixels[i];
    return result;
}

// ---- measurement of the popping during a movement -------------------------------------------------------------------

std::vector<Image> masksOf(World& world, const std::vector<MovementFrame>& movement, const PoppingOptions& options) {
    std::vector<Image> masks;
    for (const MovementFrame& frame : movement) {
        poseWorld(world, frame);
        const AovImages aovs =
            renderAovs(world, planOf(world, frame.view, options, 64, LodMode::off), options.renderer.shaderFolder);
        masks.push_back(objectPixels(aovs.level, aovs.coc));
    }
    for (std::size_t i = masks.size() - 1; i > 0; --i)
        for (std::size_t p = 0; p < masks[i].pixels.size(); ++p)
            masks[i].pixels[p] = std::max(masks[i].pixels[p], masks[i - 1].pixels[p]);
    return masks;
}

struct ModeState {
    FramePlan plan;
    Image image;      // image drawn with the level mode, display-encoded
    Image reference;  // image at full detail with the same lens samples, display-encoded
};

PoppingFrame frameOf(const Renderers& renderers, PoppingMode mode, const ModeState& before, const ModeState& now,
                     const Image& expected, const Image& objects) {
    PoppingFrame frame;
    frame.mode = mode;
    frame.speed = largestSpeed(now.plan, before.plan);
    frame.change = popBetween(expected, now.image, objects);
    if (const std::optional<HeldPlan> held = asBefore(now.plan, before.plan))
        frame.step = popBetween(displayColours(imageOf(renderers.of(mode), held->plan)), now.image,
                                pixelsOf(held->changed, now.plan, objects));
    return frame;
}

// Measures one movement. Calls `step` after each frame with the results of all frames so far.
std::vector<PoppingFrame> measureMovement(World& world, const Renderers& renderers, Movement name,
                                          const std::vector<MovementFrame>& movement, const std::vector<Image>& masks,
                                          const PoppingOptions& options, std::uint32_t samples,
                                          const std::function<void(std::span<const PoppingFrame>)>& step) {
    std::vector<PoppingFrame> frames;
    std::array<ModeState, poppingModes.size()> before;
    for (std::size_t t = 0; t < movement.size(); ++t) {
        const View& view = movement[t].view;
        poseWorld(world, movement[t]);
        const FramePlan fullDetail = planOf(world, view, options, samples, LodMode::off);
        const Image accumulated = displayColours(imageOf(*renderers.accumulation, fullDetail));
        for (std::size_t m = 0; m < poppingModes.size(); ++m) {
            const PoppingMode mode = poppingModes[m];
            ModeState now;
            now.plan = planOf(world, view, options, samples, levelsOf(mode));
            now.image = displayColours(imageOf(renderers.of(mode), now.plan));
            now.reference = mode == PoppingMode::multirate ? displayColours(imageOf(*renderers.multirate, fullDetail))
                                                           : accumulated;
            if (t > 0) {
                const Image expected = carriedOn(before[m].image, now.reference, before[m].reference);
                PoppingFrame frame = frameOf(renderers, mode, before[m], now, expected, masks[t]);
                frame.movement = name;
                frame.samples = samples;
                frame.frame = static_cast<int>(t);
                frames.push_back(frame);
            }
            before[m] = std::move(now);
        }
        step(frames);
    }
    return frames;
}

// ---- change in the image when one sample switches its level ---------------------------------------------------------

// Returns the most blurred of the objects that have a coarser level; null if there is none.
ObjectPlan* maxBlurred(FramePlan& plan, const World& world) {
    ObjectPlan* found = nullptr;
    for (ObjectPlan& object : plan.objects) {
        const std::size_t levels = world.pyramids[static_cast<std::size_t>(object.mesh)].levels.size();
        if (object.lambda + 1 >= static_cast<double>(levels) || object.nearestDepth <= plan.view.nearPlane) continue;
        if (found == nullptr || object.coc.smallest > found->coc.smallest) found = &object;
    }
    return found;
}

Image withSplit(Renderer& renderer, FramePlan& plan, ObjectPlan& object, const Pyramid& pyramid, std::uint32_t level,
                std::uint32_t coarseCount) {
    const auto samples = static_cast<std::uint32_t>(plan.samples.size());
    object.coarse = {level + 1, 0, coarseCount, pyramid.levels[level + 1].triangleCount};
    object.fine = {level, coarseCount, samples - coarseCount, pyramid.levels[level].triangleCount};
    object.boundaryShare = 0;
    markUsed(plan);
    return imageOf(renderer, plan);
}

double squaredDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double difference = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        sum += difference * difference;
    }
    return sum;
}

std::optional<SampleStep> measureSampleStep(const World& world, Renderer& renderer, const View& view,
                                            const PoppingOptions& options, std::uint32_t samples) {
    FramePlan plan = planOf(world, view, options, samples, LodMode::fractional);
    ObjectPlan* object = plan.usesLens ? maxBlurred(plan, world) : nullptr;
    if (object == nullptr) return {};
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object->mesh)];
    SampleStep step;
    step.samples = samples;
    step.object = object->name;
    step.level = static_cast<std::uint32_t>(object->lambda);
    const double depth = 0.5 * (object->nearestDepth + object->farthestDepth);
    step.coc = std::abs(circleOfConfusion(plan.coc, depth, view.width));
    // `projectedEdge` is the mean edge length of level 0, projected at the object's nearest depth, in px.
    step.edgeError = pyramid.levels[step.level + 1].error / pyramid.levels[0].meanEdge * object->projectedEdge *
                     object->nearestDepth / depth;
    step.expected = std::sqrt(std::max(step.coc / step.edgeError, 1.0)) / samples;

    const Image fine = withSplit(renderer, plan, *object, pyramid, step.level, 0);
    Image last = fine;
    double sum = 0;
    for (std::uint32_t n = 1; n <= samples; ++n) {
        Image next = withSplit(renderer, plan, *object, pyramid, step.level, n);
        sum += squaredDifference(next, last);
        last = std::move(next);
    }
    const double pop = squaredDifference(last, fine);
    if (!(pop > 0)) return {};
    step.measured = std::sqrt(sum / samples / pop);
    return step;
}

}  // namespace

std::string_view poppingModeName(PoppingMode mode) {
    return mode == PoppingMode::multirate ? "multirate" : lodModeName(levelsOf(mode));
}

void measurePopping(World& world, const View& view, const PoppingOptions& options, const PoppingVisitor& visitor,
                    const Progress& progress) {
    RendererOptions precise = options.renderer;
    if (precise.layerFormat == LayerFormat::automatic) precise.layerFormat = LayerFormat::rgba32f;
    const Renderers renderers{makeAccumulationRenderer(world, precise), methodNamed("multirate").make(world, precise)};
    const MovementFrame own{view, world.pose};
    // Compute all movements first, so that an invalid movement throws before any image is rendered.
    std::vector<std::vector<MovementFrame>> movements;
    for (const Movement movement : options.movements) {
        movements.push_back(busiestStretch(
            framesAlong(movement, world, view, options.pathFrames, options.clip), world,
            settingsOf(options, std::ranges::max(options.sampleCounts), LodMode::nearest), options.frames));
        poseWorld(world, own);
    }
    const std::uint64_t total =
        options.movements.size() * options.sampleCounts.size() * static_cast<std::size_t>(options.frames);
    const std::uint64_t early = std::max<std::uint64_t>(static_cast<std::uint64_t>(options.frames) / 4, 2);
    std::uint64_t done = 0;
    const auto step = [&](std::span<const PoppingFrame> frames) {
        report(progress, "frames", ++done, total);
        if (done == early && visitor.firstFrames) visitor.firstFrames(frames);
    };
    for (std::size_t m = 0; m < movements.size(); ++m) {
        const std::vector<Image> masks = masksOf(world, movements[m], options);
        for (const std::uint32_t samples : options.sampleCounts)
            visitor.frames(
                measureMovement(world, renderers, options.movements[m], movements[m], masks, options, samples, step));
    }

    // Measure the change from one sample last, because the popping during movements is the main result and is reported
    // first.
    poseWorld(world, own);
    for (const std::uint32_t samples : options.sampleCounts)
        if (const auto sampleStep = measureSampleStep(world, *renderers.accumulation, view, options, samples))
            visitor.sampleStep(*sampleStep);
}

}  // namespace defocus::engine
