// Sources: Scheuermann 2004, Advanced Depth of Field (slides of the Game Developers Conference); Mitchell 1991,
// Spectrally Optimal Sampling for Distribution Ray Tracing.

#include "render/scheuermann/scheuermann.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/error.h"
#include "gl/fullscreen.h"
#include "gl/scissor.h"
#include "lens/aperture.h"
#include "render/post_process/post_process.h"

namespace defocus::engine {

namespace {

constexpr double publishedLargest = 10;  // max blur diameter in px
// Tap radius in the small image divided by the tap radius in the full-size image, each in pixels of its own image.
// Pixels of the small image are 4 times as wide.
constexpr float publishedSmallRadius = 0.4f;
constexpr float trueSmallRadius = 0.25f;  // the ratio at which the taps have the same positions in both images
constexpr int smallReduction = 4;         // width of a pixel of the small image in px of the full-size image
constexpr std::uint32_t maxTaps = 64;
constexpr std::uint32_t candidatesPerPoint = 32;

// Uniform block in shaders/scheuermann/gather.frag (std140).
struct GpuTaps {
    glm::vec4 taps[maxTaps];
};

double largestBlur(const FramePlan& plan) {
    double largest = largestCocAtInfinity(plan.coc, plan.view.width);
    for (const ObjectPlan& object : plan.objects)
        if (std::isfinite(object.coc.largest)) largest = std::max(largest, object.coc.largest);
    return std::min(largest, static_cast<double>(plan.view.width));
}

class Scheuermann final : public PostProcess {
public:
    explicit Scheuermann(const RendererOptions& options)
        : shaderFolder_(options.shaderFolder),
          taps_(static_cast<std::uint32_t>(numberOf(options.settings, "taps"))),
          thinLens_(options.settings.at("coc") == "thin-lens"),
          unlimited_(options.settings.at("max-coc") == "unlimited"),
          bytes_(options.settings.at("bits") == "8"),
          samples_(std::stoi(options.settings.at("multisampling"))),
          settings_(options.settings),
          points_(poissonDisk(taps_)) {
        if (samples_ > 1 && options.settings.at("transparency-buckets") != "0")
            fail("method scheuermann: multisampling has no effect on transparency-buckets; set only one of them");
    }

    void start(const FramePlan& plan, const FrameUniforms& frame) override {
        if (plan.usesCocControls && !thinLens_)
            fail(
                "method scheuermann: coc=published ignores blur controls, such as --foreground-limit or --node-blur; "
                "use coc=thin-lens or leave them out");
        const PlanesByHand byHand = planesByHand(plan.view);
        makeTextures(plan.view.width, plan.view.height);
        if (!blurriness_ || defines_ != frame.defines()) makePrograms(frame);
        placeTaps(plan.view.lens);
        const double largest = unlimited_ ? std::max(largestBlur(plan), publishedLargest) : publishedLargest;
        largestRadius_ = static_cast<float>(0.5 * largest);
        glProgramUniform1f(blurriness_.name(), 0, static_cast<float>(1 / largest));
        if (!thinLens_) {
            const BlurrinessPlanes planes = withPlanesByHand(
                blurrinessPlanes(plan.coc, plan.view.lens.focusDistance, largest, plan.view.width), byHand);
            // Blurriness is piecewise linear in depth, with one slope in front of and one behind the focus plane.
            const auto focus = static_cast<float>(planes.focus);
            glProgramUniform4f(blurriness_.name(), 1, focus, static_cast<float>(1 / (planes.focus - planes.near)),
                               static_cast<float>(1 / (planes.far - planes.focus)), static_cast<float>(planes.cutoff));
        }
        glProgramUniform1f(gather_.name(), 0, largestRadius_);
    }

    void draw(const PinholeImage& pinhole, const FrameUniforms& frame, const Target& output) override {
        frame.bind(0);
        // Draw the image with blurriness in alpha, and a small, pre-blurred copy of it.
        sharpTarget_.bind();
        const PinholeImage& drawn = samples_ > 1 ? *pinhole.multisampled : pinhole;
        drawn.color.attach(0);
        drawn.attachForBlur();
        fullscreen_.draw(blurriness_);
        reducedTarget_.bind();
        sharp_.attach(0);
        fullscreen_.draw(reduce_);
        smallTarget_.bind();
        reduced_.attach(0);
        fullscreen_.draw(preblur_);

        // Draw the result: each pixel is a weighted mean of taps in a disk.
        output.bind();
        sharp_.attach(0);
        small_.attach(1);
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, tapBuffer_.name());
        const Scissor scissor(pinhole.part);
        fullscreen_.draw(gather_);
    }

    [[nodiscard]] bool blursAsTheLens() const override { return thinLens_; }
    [[nodiscard]] int samplesPerPixel() const override { return samples_; }

    [[nodiscard]] std::size_t bytes() const override { return sharp_.bytes() + reduced_.bytes() + small_.bytes(); }

private:
    [[nodiscard]] PlanesByHand planesByHand(const View& view) const {
        const PlanesByHand planes = {
            valueAt(view, settings_, "near-blur-depth"), valueAt(view, settings_, "focal-plane-depth"),
            valueAt(view, settings_, "far-blur-depth"), valueAt(view, settings_, "blurriness-cutoff")};
        if (thinLens_ && (planes.near > 0 || planes.focus > 0 || planes.far > 0 || planes.cutoff > 0))
            fail(
                "method scheuermann: coc=thin-lens takes the blur from the lens; leave out near-blur-depth, "
                "focal-plane-depth, far-blur-depth and blurriness-cutoff");
        return planes;
    }

    void makeTextures(int width, int height) {
        if (sharp_ && sharp_.info().width == width && sharp_.info().height == height) return;
        const auto linear = [&](int w, int h) {
            const TextureFormat format = bytes_ ? TextureFormat::rgba8 : TextureFormat::rgba16f;
            return GlTexture({.format = format, .width = w, .height = h, .linear = true});
        };
        const int smallWidth = (width + smallReduction - 1) / smallReduction;
        const int smallHeight = (height + smallReduction - 1) / smallReduction;
        sharp_ = linear(width, height);
        reduced_ = linear(smallWidth, smallHeight);
        small_ = linear(smallWidth, smallHeight);
        sharpTarget_ = Target({&sharp_});
        reducedTarget_ = Target({&reduced_});
        smallTarget_ = Target({&small_});
    }

    void makePrograms(const FrameUniforms& frame) {
        defines_ = frame.defines();
        const auto pass = [&](const char* shader, ShaderDefines defines) {
            return Program({{fullscreenShader, shader}, std::move(defines), shaderFolder_});
        };
        ShaderDefines blurriness = frame.defines();
        if (thinLens_) blurriness.emplace_back("thinLens", "true");
        if (bytes_) blurriness.emplace_back("encodedColor", "true");
        blurriness.emplace_back("pinholeSamples", std::to_string(samples_));
        blurriness_ = pass("scheuermann/blurriness.frag", std::move(blurriness));
        reduce_ = pass("scheuermann/reduce.frag", {{"reduction", std::to_string(smallReduction)}});
        preblur_ = pass("scheuermann/preblur.frag", {});
        ShaderDefines gather = {
            {"diskTaps", std::to_string(taps_)},
            {"maxDiskTaps", std::to_string(maxTaps)},
            {"smallPixel", fmt::format("{:.1f}", static_cast<double>(smallReduction))},
            {"smallRadiusScale", fmt::format("{}", thinLens_ ? trueSmallRadius : publishedSmallRadius)}};
        if (bytes_) gather.emplace_back("encodedColor", "true");
        gather_ = pass("scheuermann/gather.frag", std::move(gather));
    }

    // Computes the taps: the points of the disk, mapped to the aperture's shape if the aperture is not a disk. The blur
    // of a point behind the focus plane has the shape of the aperture, so its pixels must gather from the aperture
    // rotated by 180°. In front of the focus plane, taps are not rotated.
    void placeTaps(const Lens& lens) {
        const Aperture aperture = makeAperture(lens);
        shaped_ = !isUniformDisk(aperture);
        GpuTaps block{};
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const glm::vec2 place =
                shaped_ ? glm::vec2(apertureSample(aperture, squareOfConcentricDisk(points_[i]))) : points_[i];
            block.taps[i] = glm::vec4(place, 0, 0);
        }
        tapBuffer_ = Buffer(sizeof block, &block);
        glProgramUniform1i(gather_.name(), 1, shaped_ ? 1 : 0);
    }

    std::filesystem::path shaderFolder_;
    std::uint32_t taps_;
    bool thinLens_;
    bool unlimited_;
    bool bytes_;   // true: 8-bit encoded colour, as published; false: half floats
    int samples_;  // samples per pixel of the pinhole image
    MethodSettings settings_;
    std::vector<glm::vec2> points_;  // taps in the unit disk
    bool shaped_ = false;            // true if the aperture is not a disk
    float largestRadius_ = 0;        // max blur radius, px
    GlTexture sharp_, reduced_, small_;
    Target sharpTarget_, reducedTarget_, smallTarget_;
    ShaderDefines defines_;  // defines of the compiled programs
    Program blurriness_, reduce_, preblur_, gather_;
    Buffer tapBuffer_;
    Fullscreen fullscreen_;
};

}  // namespace

BlurrinessPlanes blurrinessPlanes(const ClipCircleOfConfusion& coc, double focusDistance, double largest, int width) {
    // In normalised device coordinates, the blur radius at depth w is |C/w|, where C is the clip-space circle of
    // confusion. `radius` is the max blur radius.
    const double radius = largest / width;
    BlurrinessPlanes planes;
    // At depth w, C/w = a/w + b with a = coc.a < 0; b is coc.front in front of the focus plane and coc.behind behind
    // it. C/w is −radius at the near plane and +radius at the far plane.
    planes.near = -coc.a / (coc.front + radius);
    if (std::isinf(focusDistance)) {  // nothing is behind the focus plane
        planes.focus = 2 * planes.near;
        planes.far = std::numeric_limits<double>::infinity();
        planes.cutoff = 0;
        return planes;
    }
    planes.focus = focusDistance;
    if (coc.behind > radius) {
        planes.far = coc.a / (radius - coc.behind);
        return planes;
    }
    planes.cutoff = coc.behind / radius;
    // At depth w behind the focus plane, the lens has the blurriness cutoff · (1 − focusDistance/w): half the cutoff at
    // twice the focus distance. Choose the far plane so that the blurriness, linear in depth, is also half the cutoff
    // there.
    planes.far = focusDistance + focusDistance / (0.5 * planes.cutoff);
    return planes;
}

BlurrinessPlanes withPlanesByHand(const BlurrinessPlanes& planes, const PlanesByHand& byHand) {
    BlurrinessPlanes result = planes;
    if (byHand.focus > 0) {
        result.focus = byHand.focus;
        result.near = byHand.focus * (planes.near / planes.focus);
        result.far = byHand.focus * (planes.far / planes.focus);
    }
    if (byHand.near > 0) result.near = byHand.near;
    if (byHand.far > 0) result.far = byHand.far;
    if (byHand.cutoff > 0) result.cutoff = byHand.cutoff;
    if (!(result.near < result.focus && result.focus < result.far))
        fail(
            "method scheuermann: the distances must increase from full blur in front ({:g} m) to focus ({:g} m) to "
            "full blur behind ({:g} m)",
            result.near, result.focus, result.far);
    return result;
}

std::vector<glm::vec2> poissonDisk(std::uint32_t count) {
    std::vector<glm::vec2> points = {glm::vec2(0)};  // the centre is not a tap, but taps keep their distance from it
    std::uint64_t next = 0;
    while (points.size() <= count) {
        glm::vec2 best(0);
        float bestDistance = -1;
        for (std::uint32_t c = 0; c < candidatesPerPoint * count; ++c, ++next) {
            const glm::vec2 candidate(concentricDisk({radicalInverse(2, next), radicalInverse(3, next)}));
            float distance = std::numeric_limits<float>::infinity();
            for (const glm::vec2& point : points) distance = std::min(distance, glm::distance(point, candidate));
            if (distance > bestDistance) {
                bestDistance = distance;
                best = candidate;
            }
        }
        points.push_back(best);
    }
    points.erase(points.begin());
    return points;
}

Method scheuermannMethod() {
    const auto byHand = [](const char* name, const char* description, double max) {
        return MethodSetting{.name = name,
                             .defaultValue = "0",
                             .description = description,
                             .choices = {},
                             .min = 0,
                             .max = max,
                             .integer = false,
                             .ofTheScene = true,
                             .keyed = true};
    };
    const std::vector<MethodSetting> settings = {
        {.name = "coc",
         .defaultValue = "published",
         .description = "Blur as a function of depth. published: linear between three planes, as in Scheuermann's "
                        "slides. thin-lens: the blur of a thin lens",
         .choices = {"published", "thin-lens"}},
        {.name = "taps",
         .defaultValue = "8",
         .description = "Number of samples around each pixel (a Poisson disk); 8 in Scheuermann's slides",
         .choices = {},
         .min = 8,
         .max = maxTaps},
        maxCocSetting("published"),
        {.name = "bits",
         .defaultValue = "16",
         .description = "Bits per channel of the stored images. 16: half floats. 8: display-encoded bytes, as in "
                        "Scheuermann's slides",
         .choices = {"16", "8"}},
        {.name = "multisampling",
         .defaultValue = "1",
         .description = "Samples per pixel of the sharp image. Within each pixel, the colours and blur sizes of the "
                        "samples are averaged before the blur is applied. Scheuermann's slides use a multisampled "
                        "image. 1: no multisampling",
         .choices = {"1", "4"}},
        byHand("near-blur-depth", "Depth in m; anything nearer has the maximum blur; 0: computed from the lens", 1e9),
        byHand("focal-plane-depth", "Depth in m that is in focus; 0: the focus distance", 1e9),
        byHand("far-blur-depth", "Depth in m beyond which everything has the maximum blur. 0: computed from the lens",
               1e9),
        byHand("blurriness-cutoff",
               "Maximum blur behind the focus plane, as a fraction of the overall maximum; 0: computed from the lens",
               1),
        transparencyBucketsSetting("0"),
        pinholesSetting(),
    };
    return {.name = "scheuermann",
            .description = "post-process: Poisson disk over one pinhole image (Scheuermann 2004)",
            .usesLensSamples = false,
            .drawsMotion = false,
            .aperture = ApertureShown::shape,
            .settings = settings,
            .best = {{"coc", "thin-lens"},
                     {"taps", "64"},
                     {"max-coc", "unlimited"},
                     {"transparency-buckets", "8"},
                     {"pinholes", "16"}},
            .make = [](const World& world, const RendererOptions& options) {
                return makePostProcessRenderer(world, options, std::make_unique<Scheuermann>(options));
            }};
}

}  // namespace defocus::engine
