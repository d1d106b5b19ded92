// Source: Garcia 2018, Circular Separable Convolution Depth of Field (slides of the Game Developers Conference).

#include "render/circular/circular.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "gl/scissor.h"
#include "render/circular/circular_kernel.h"
#include "render/circular/complex_blur.h"
#include "render/post_process/post_process.h"

namespace defocus::engine {

namespace {

// The near field and the far field are the images of the surfaces in front of and behind the focus plane. They may have
// a lower resolution than the full image. Sizes are in pixels of these fields.
constexpr int tileSize = 16;
// Max blur diameter in Garcia's slides, in pixels of the near or far field: eight taps on each side of the centre tap.
constexpr int publishedLargest = 17;

struct CircularOptions {
    int nearComponents = 2;
    int farComponents = 2;
    int reduction = 1;  // width of a pixel of the near and far fields, in pixels of the full image
    bool direct = false;
    double blendBias = 1;
    bool biasByLuminance = false;
    bool nearPremultiplied = true;
    bool limited = false;  // true: the blur diameter is limited to the published max, publishedLargest
    ComplexStorage storage = ComplexStorage::half;
    ComplexTaps taps = ComplexTaps::exact;
    KernelConstants constants = KernelConstants::fitted;
};

CircularOptions parsed(const MethodSettings& settings) {
    const std::string& storage = settings.at("storage");
    const std::string& resolution = settings.at("resolution");
    CircularOptions options;
    options.nearComponents = static_cast<int>(numberOf(settings, "near-components"));
    options.farComponents = static_cast<int>(numberOf(settings, "far-components"));
    options.reduction = resolution == "full" ? 1 : resolution == "half" ? 2 : 4;
    options.direct = settings.at("convolution") == "direct";
    options.blendBias = numberOf(settings, "blend-bias");
    options.biasByLuminance = settings.at("bias-by") == "luminance";
    options.nearPremultiplied = settings.at("near-field") == "premultiplied";
    options.storage = storage == "float"  ? ComplexStorage::float32
                      : storage == "half" ? ComplexStorage::half
                                          : ComplexStorage::rgb10A2;
    options.taps = settings.at("kernel-taps") == "exact" ? ComplexTaps::exact : ComplexTaps::eight;
    const std::string& kernel = settings.at("kernel");
    options.constants = kernel == "fitted"     ? KernelConstants::fitted
                        : kernel == "rescaled" ? KernelConstants::rescaled
                                               : KernelConstants::published;
    options.limited = settings.at("max-coc") == "published";
    if (options.constants != KernelConstants::fitted &&
        std::max(options.nearComponents, options.farComponents) > publishedKernelLimit)
        fail("method circular: kernel={} supports at most {} components; use kernel=fitted for more", kernel,
             publishedKernelLimit);
    if (options.direct && options.storage == ComplexStorage::rgb10A2)
        fail("method circular: storage has no effect with convolution=direct; leave it out");
    return options;
}

// Returns the largest blur diameter in px in front of the focus plane. For objects that extend to the near plane, it is
// the image width.
double largestNearDiameter(const FramePlan& plan) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects) {
        const bool reachesCamera = object.nearestDepth <= plan.view.nearPlane;
        largest = std::max(largest, reachesCamera ? plan.view.width : -object.coc.nearest);
    }
    return largest;
}

// Returns the largest blur diameter in px behind the focus plane, including the blur of the sky; at least 1 px.
double largestFarDiameter(const FramePlan& plan) {
    double largest = std::max(largestCocAtInfinity(plan.coc, plan.view.width), 1.0);
    for (const ObjectPlan& object : plan.objects) largest = std::max(largest, object.coc.farthest);
    return largest;
}

class Circular final : public PostProcess {
public:
    Circular(const RendererOptions& options, const CircularOptions& circular)
        : shaderFolder_(options.shaderFolder), options_(circular) {}

    void start(const FramePlan& plan, const FrameUniforms& frame) override {
        if (!split_ || defines_ != frame.defines()) makePrograms(frame);
        const View& view = plan.view;
        if (view.width != width_ || view.height != height_ || view.lens.anamorphicRatio != anamorphicRatio_)
            makeFields(view);
        double largest = 0.5 * view.width;  // max radius in px: a disk as wide as the image
        if (options_.limited) largest = std::min(largest, 0.5 * publishedLargest * options_.reduction);
        const double nearRadius = std::min(0.5 * largestNearDiameter(plan), largest) / options_.reduction;
        glProgramUniform1f(split_.name(), 0, static_cast<float>(largest));
        glProgramUniform1i(reach_.name(), 0, static_cast<GLint>(std::ceil(nearRadius / tileSize)) + 2);
        const double farDiameter = std::min(largestFarDiameter(plan), 2 * largest);
        for (const Program* program : {&split_, &composite_})
            glProgramUniform1f(program->name(), 1, static_cast<float>(1 / farDiameter));
        hasNear_ = nearRadius > 0;
        if (options_.nearPremultiplied) {
            const double nearDiameter = std::max(2 * nearRadius * options_.reduction, 1.0);
            for (const Program* program : {&split_, &composite_})
                glProgramUniform1f(program->name(), 2, static_cast<float>(1 / nearDiameter));
        }
        glProgramUniform1f(composite_.name(), 0, hasNear_ ? static_cast<float>(options_.blendBias) : 0.0f);
    }

    void draw(const PinholeImage& pinhole, const FrameUniforms& frame, const Target& output) override {
        frame.bind(0);
        splitTarget_.bind();
        pinhole.color.attach(0);
        pinhole.attachForBlur();
        fullscreen_.draw(split_);
        if (hasNear_) spreadNearRadius();
        const std::optional<TexelRectangle> part = inField(pinhole.part);
        far_->blur(farField_, farRadius_, part);
        if (hasNear_) near_->blur(nearField_, nearRadius_, part);

        output.bind();
        pinhole.color.attach(0);
        pinhole.attachForBlur();
        far_->result().attach(2);
        near_->result().attach(3);
        nearRadius_.attach(4);
        const Scissor scissor(pinhole.part);
        fullscreen_.draw(composite_);
    }

    [[nodiscard]] std::size_t bytes() const override {
        std::size_t total = (far_ ? far_->bytes() : 0) + (near_ ? near_->bytes() : 0);
        for (const GlTexture* texture :
             {&farField_, &nearField_, &farRadius_, &ownNearRadius_, &nearRadius_, &tiles_, &reaching_})
            total += texture->bytes();
        return total;
    }

private:
    void makePrograms(const FrameUniforms& frame) {
        defines_ = frame.defines();
        const auto pass = [&](const char* shader) {
            ShaderDefines defines = frame.defines();
            defines.emplace_back("reduction", std::to_string(options_.reduction));
            defines.emplace_back("tileSize", std::to_string(tileSize));
            if (options_.storage == ComplexStorage::rgb10A2) defines.emplace_back("bracketed", "true");
            if (options_.nearPremultiplied) defines.emplace_back("nearPremultiplied", "true");
            if (options_.biasByLuminance) defines.emplace_back("biasByLuminance", "true");
            return Program({{fullscreenShader, shader}, std::move(defines), shaderFolder_});
        };
        split_ = pass("circular/split.frag");
        tile_ = pass("circular/tile.frag");
        reach_ = pass("circular/reach.frag");
        widen_ = pass("circular/near_radius.frag");
        composite_ = pass("circular/composite.frag");
    }

    void makeFields(const View& view) {
        const int width = width_ = view.width;
        const int height = height_ = view.height;
        anamorphicRatio_ = view.lens.anamorphicRatio;
        const int fieldWidth = (width + options_.reduction - 1) / options_.reduction;
        const int fieldHeight = (height + options_.reduction - 1) / options_.reduction;
        const auto texture = [](TextureFormat format, int w, int h) {
            return GlTexture({.format = format, .width = w, .height = h, .linear = true});
        };
        const TextureFormat colors =
            options_.storage == ComplexStorage::half ? TextureFormat::rgba16f : TextureFormat::rgba32f;
        farField_ = texture(colors, fieldWidth, fieldHeight);
        nearField_ = texture(colors, fieldWidth, fieldHeight);
        farRadius_ = texture(TextureFormat::r32f, fieldWidth, fieldHeight);
        ownNearRadius_ = texture(TextureFormat::r32f, fieldWidth, fieldHeight);
        nearRadius_ = texture(TextureFormat::r32f, fieldWidth, fieldHeight);
        const int columns = (fieldWidth + tileSize - 1) / tileSize;
        const int rows = (fieldHeight + tileSize - 1) / tileSize;
        tiles_ = texture(TextureFormat::r32f, columns, rows);
        reaching_ = texture(TextureFormat::r32f, columns, rows);
        ComplexBlurInfo info{.width = fieldWidth,
                             .height = fieldHeight,
                             .across = std::min(1 / anamorphicRatio_, 1.0),
                             .upwards = std::min(anamorphicRatio_, 1.0),
                             .components = options_.farComponents,
                             .constants = options_.constants,
                             .storage = options_.storage,
                             .taps = options_.taps,
                             .direct = options_.direct,
                             .shaderFolder = shaderFolder_};
        far_.emplace(info);
        info.components = options_.nearComponents;
        near_.emplace(info);
        splitTarget_ = Target({&farField_, &farRadius_, &ownNearRadius_, &nearField_});
        tileTarget_ = Target({&tiles_});
        reachTarget_ = Target({&reaching_});
        nearRadiusTarget_ = Target({&nearRadius_});
    }

    // Returns the rectangle of the near and far fields, in their pixels, from which the rectangle `part` of the image
    // is interpolated. nullopt stands for all pixels.
    [[nodiscard]] std::optional<TexelRectangle> inField(const std::optional<TexelRectangle>& part) const {
        if (!part) return {};
        const TextureInfo& field = farField_.info();
        const int left = std::max(part->x / options_.reduction - 1, 0);
        const int bottom = std::max(part->y / options_.reduction - 1, 0);
        const int right = std::min((part->x + part->width) / options_.reduction + 2, field.width);
        const int top = std::min((part->y + part->height) / options_.reduction + 2, field.height);
        return TexelRectangle{left, bottom, std::max(right - left, 0), std::max(top - bottom, 0)};
    }

    // Sets each pixel's radius in the near field to the largest radius of all blur disks of the near field that may
    // reach this pixel.
    void spreadNearRadius() {
        tileTarget_.bind();
        ownNearRadius_.attach(0);
        fullscreen_.draw(tile_);
        reachTarget_.bind();
        tiles_.attach(0);
        fullscreen_.draw(reach_);
        nearRadiusTarget_.bind();
        ownNearRadius_.attach(0);
        reaching_.attach(1);
        fullscreen_.draw(widen_);
    }

    std::filesystem::path shaderFolder_;
    CircularOptions options_;
    int width_ = 0;
    int height_ = 0;
    double anamorphicRatio_ = 1;
    bool hasNear_ = true;
    ShaderDefines defines_;  // defines of the compiled programs
    Program split_, tile_, reach_, widen_, composite_;
    GlTexture farField_, nearField_, farRadius_, ownNearRadius_, nearRadius_, tiles_, reaching_;
    Target splitTarget_, tileTarget_, reachTarget_, nearRadiusTarget_;
    std::optional<ComplexBlur> far_, near_;
    Fullscreen fullscreen_;
};

std::vector<MethodSetting> circularSettings() {
    return {
        {.name = "near-components",
         .defaultValue = "2",
         .description = "Number of components of the kernel for the foreground; more components give a rounder, more "
                        "even disk but take longer",
         .choices = {},
         .min = 1,
         .max = 5},
        {.name = "far-components",
         .defaultValue = "2",
         .description = "Number of components of the kernel for the background; more components give a rounder, more "
                        "even disk but take longer",
         .choices = {},
         .min = 1,
         .max = circularKernelLimit},
        {.name = "resolution",
         .defaultValue = "full",
         .description = "Resolution of the blurred foreground and background. Garcia's slides combine half with "
                        "--far-components 1, and quarter with --far-components 2",
         .choices = {"full", "half", "quarter"}},
        {.name = "kernel",
         .defaultValue = "fitted",
         .description = "Constants of the kernel. fitted: fitted to a disk. published: as printed in Garcia's slides. "
                        "rescaled: the published constants, scaled so that the kernel is as large as the blur disk. "
                        "published and rescaled exist for 1 to 5 components only",
         .choices = {"fitted", "rescaled", "published"}},
        maxCocSetting("unlimited"),
        {.name = "kernel-taps",
         .defaultValue = "exact",
         .description = "Number of kernel samples on each side of the centre. exact: one per pixel. eight: 8, as in "
                        "Garcia's slides",
         .choices = {"exact", "eight"}},
        {.name = "storage",
         .defaultValue = "half",
         .description =
             "Pixel format of the intermediate images between the horizontal and the vertical pass. With r10g10b10a2, "
             "as in Garcia's slides, the sharp and the blurred images also have ten bits per channel, and radiance "
             "above 1 is clipped",
         .choices = {"float", "half", "r10g10b10a2"}},
        {.name = "near-field",
         .defaultValue = "premultiplied",
         .description = "Weight of a foreground pixel in the blur: its coverage times its blur size (premultiplied, "
                        "as in Garcia's slides), or its coverage alone (coverage)",
         .choices = {"premultiplied", "coverage"}},
        {.name = "blend-bias",
         .defaultValue = "1",
         .description = "Multiplier for the opacity of the blurred foreground. Above 1, the sharp foreground shows "
                        "less through its own blur, but blurred edges become wider",
         .choices = {},
         .min = 1,
         .max = 4,
         .integer = false},
        {.name = "bias-by",
         .defaultValue = "constant",
         .description = "Where --blend-bias applies: everywhere (constant), or mainly where the foreground covers most "
                        "of the pixel and is brighter than the background (luminance), which keeps edges narrower",
         .choices = {"constant", "luminance"}},
        {.name = "convolution",
         .defaultValue = "separable",
         .description = "How the image is convolved with the kernel. separable: in two fast one-dimensional passes. "
                        "direct: in one slow two-dimensional pass, to check the result of separable",
         .choices = {"separable", "direct"}},
        transparencyBucketsSetting("1"),
        pinholesSetting(),
    };
}

}  // namespace

Method circularMethod() {
    return {.name = "circular",
            .description = "post-process: circular separable convolution of one pinhole image (Garcia 2018)",
            .usesLensSamples = false,
            .drawsMotion = false,
            .aperture = ApertureShown::oval,
            .settings = circularSettings(),
            .best = {{"transparency-buckets", "8"}, {"pinholes", "16"}},
            .make = [](const World& world, const RendererOptions& options) {
                return makePostProcessRenderer(world, options,
                                               std::make_unique<Circular>(options, parsed(options.settings)));
            }};
}

}  // namespace defocus::engine
