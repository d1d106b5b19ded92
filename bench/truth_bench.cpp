// Compares the rasteriser's accumulation with the Embree ray tracer at full image size. Held constant: geometry at full
// detail, baked unlit colours, view, lens, image size and samples per pixel. Deliberately different: the code for
// sampling, projection and visibility. The rasteriser draws RGBA32F layers. Prints one line of JSON per scene.
//
// In a second comparison, the ray tracer also uses the rasteriser's lens samples, so that only geometry and visibility
// can differ. Its results are the PSNR ("psnrAtEqualLensPoints"), and the shift and growth of the rasteriser's image in
// px. The exit code is 1 if "psnr", from the first comparison, is below 45 dB for any scene.
//
// With --shadows ANGLE, diffuse surfaces are lit by a sun with this angular diameter in degrees, which casts shadows.
// The scene is also rendered without shadows, to measure how much time they take in each renderer and how much error
// they add. In this mode, no PSNR is required, because shadow maps have a finite resolution.
//
//   defocus_truth_bench [--samples 1024] [--size 1024x768] [--sequence sobol] [--foreground-limit 8] [--shadows 5]
//   [--output FOLDER] [SCENE.glb …]
//
// Without a scene, the school of fish is compared.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "render/methods.h"
#include "run_bench.h"
#include "truth_scene.h"

namespace defocus::engine {
namespace {

struct Options {
    std::uint32_t samples = 1024;
    std::string size = "1024x768";
    Sequence sequence = RenderSettings{}.sequence;                     // sequence of the rasteriser's lens samples
    double foregroundLimit = std::numeric_limits<double>::infinity();  // limit on the foreground blur, px
    std::optional<double> shadows;  // angular diameter of the sun, degrees; nullopt: no sun
    std::string output;
    std::vector<std::string> scenes;
    int width = 0;
    int height = 0;
};

struct Rendered {
    Image image;
    RenderStats stats;
};

Rendered rendered(const char* method, const TruthScene& subject, const Options& wanted,
                  Shadows shadows = Shadows::off) {
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const std::unique_ptr<Renderer> renderer = methodNamed(method).make(subject.world, options);
    RenderSettings settings = fullDetailSettings(wanted.samples);
    settings.sequence = wanted.sequence;
    settings.shadows = shadows;
    // Max error in px of the blur interpolated inside triangles. It is small, because a limit on the foreground blur
    // adds a kink to the blur over depth, which interpolation smooths.
    settings.cocTolerance = 0.05;
    Image image = imageOf(*renderer, planFrame(subject.world, subject.view, settings));
    return {std::move(image), renderer->stats()};
}

// Makes the scene's surfaces diffuse, and lights them only by a sun with an angular diameter of `degrees`, from the
// upper right behind the camera.
void lightByASun(TruthScene& subject, double degrees) {
    for (Material& material : subject.scene.materials) {
        material.unlit = false;
        material.metallicFactor = 0;
        material.specularFactor = 0;
    }
    PlacedLight sun;
    sun.light.intensity = 3;
    sun.light.angularDiameter = static_cast<float>(glm::radians(degrees));
    sun.direction = glm::normalize(glm::dmat3(subject.view.worldFromCamera) * glm::dvec3(-0.5, -1, -0.6));
    subject.world.lights = {sun};
    subject.world.environment.lighting = 0;
}

// Compares the rasterized shadows of a scene with ray-traced ones, and prints the differences.
void compareShadows(const std::string& name, const TruthScene& subject, const Options& options) {
    const Rendered openRaster = rendered("accumulation", subject, options);
    const Rendered openTraced = rendered("embree", subject, options);
    const Rendered raster = rendered("accumulation", subject, options, Shadows::on);
    const Rendered traced = rendered("embree", subject, options, Shadows::on);
    const Difference difference = compareImages(traced.image, raster.image);
    const BlockDifference blocks = blockDifference(traced.image, raster.image);
    const nlohmann::ordered_json line = {
        {"scene", name},
        {"width", options.width},
        {"height", options.height},
        {"samples", options.samples},
        {"sunDegrees", *options.shadows},
        {"psnr", difference.psnr},
        {"psnrWithoutShadows", compareImages(openTraced.image, openRaster.image).psnr},
        {"psnrIfLeftOut", compareImages(traced.image, openRaster.image).psnr},
        {"ssim", difference.ssim},
        {"flip", difference.flip},
        {"blockRms", blocks.rms},
        {"meanDifference", blocks.mean},
        {"embreeMilliseconds", traced.stats.renderMilliseconds},
        {"embreeMillisecondsWithoutShadows", openTraced.stats.renderMilliseconds},
        {"accumulationMilliseconds", raster.stats.renderMilliseconds},
        {"accumulationMillisecondsWithoutShadows", openRaster.stats.renderMilliseconds},
        {"device", raster.stats.device}};
    std::puts(line.dump().c_str());
    if (options.output.empty()) return;
    const std::filesystem::path folder(options.output);
    writeImage(folder / (name + "-embree.png"), traced.image);
    writeImage(folder / (name + "-accumulation.png"), raster.image);
    writeImage(folder / (name + "-difference.png"), differenceImage(traced.image, raster.image, 16));
}

// Compares the rasterized image of a scene with the ray-traced one, and prints the differences. Returns whether the
// PSNR is at least 45 dB; always true with shadows, whose maps have a finite resolution.
bool compareScene(const std::string& name, Scene scene, const Options& options) {
    const std::unique_ptr<TruthScene> subject = truthScene(std::move(scene), options.width, options.height);
    subject->view.lens.foregroundLimit = options.foregroundLimit;
    if (options.shadows) {
        lightByASun(*subject, *options.shadows);
        compareShadows(name, *subject, options);
        return true;
    }
    const Rendered traced = rendered("embree", *subject, options);
    const Rendered raster = rendered("accumulation", *subject, options);
    const Rendered planned = rendered("embree-planned", *subject, options);
    const Difference difference = compareImages(traced.image, raster.image);
    const BlockDifference blocks = blockDifference(traced.image, raster.image);
    const Misplacement moved = misplacement(planned.image, raster.image);
    const nlohmann::ordered_json line = {{"scene", name},
                                         {"width", options.width},
                                         {"height", options.height},
                                         {"samples", options.samples},
                                         {"psnr", difference.psnr},
                                         {"ssim", difference.ssim},
                                         {"flip", difference.flip},
                                         {"maxError", difference.maxError},
                                         {"nonFinite", difference.nonFinite},
                                         {"blockRms", blocks.rms},
                                         {"blockLargest", blocks.largest},
                                         {"meanDifference", blocks.mean},
                                         {"psnrAtEqualLensPoints", compareImages(planned.image, raster.image).psnr},
                                         {"movedRight", moved.right},
                                         {"movedDown", moved.down},
                                         {"grown", moved.growth * options.width},
                                         {"embreeMilliseconds", traced.stats.renderMilliseconds},
                                         {"accumulationMilliseconds", raster.stats.renderMilliseconds},
                                         {"device", raster.stats.device}};
    std::puts(line.dump().c_str());
    if (!options.output.empty()) {
        const std::filesystem::path folder(options.output);
        writeImage(folder / (name + "-embree.png"), traced.image);
        writeImage(folder / (name + "-accumulation.png"), raster.image);
        writeImage(folder / (name + "-difference.png"), differenceImage(traced.image, raster.image, 16));
    }
    return difference.psnr >= 45;
}

bool compareAll(const Options& options) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    registerEmbree();
    if (options.scenes.empty()) return compareScene("fish", fishSchool(), options);
    bool good = true;
    for (const std::filesystem::path path : options.scenes) {
        good = compareScene(path.stem().string(), loadGltf(path), options) && good;
    }
    return good;
}

}  // namespace
}  // namespace defocus::engine

int main(int argc, char** argv) {
    defocus::engine::Options options;
    CLI::App app("The accumulation method against an independent thin-lens ray tracer");
    app.add_option("--samples", options.samples, "samples a pixel, of both")
        ->check(CLI::Range(1u, defocus::maxSamples));
    using defocus::Sequence;
    std::map<std::string, Sequence> sequences;
    for (const Sequence sequence : defocus::engine::allSequences)
        sequences.emplace(defocus::engine::sequenceName(sequence), sequence);
    app.add_option("--sequence", options.sequence, "the rasteriser's lens samples: sobol, halton, scrambled-halton, r2")
        ->transform(CLI::CheckedTransformer(sequences));
    app.add_option("--size", options.size, "WxH in px");
    app.add_option("--foreground-limit", options.foregroundLimit,
                   "Largest blur in front of the focus, px: a lens of its own before every pixel (Munkberg, Toth and "
                   "Akenine-Möller 2012, Figure 9)")
        ->check(CLI::Range(1e-3, 1e6));
    app.add_option("--shadows", options.shadows, "Light by one sun of so many degrees instead, and compare its shadows")
        ->check(CLI::Range(0.0, 90.0));
    app.add_option("--output", options.output, "folder for images and differences")->check(CLI::ExistingDirectory);
    app.add_option("SCENE", options.scenes, "glTF files; none: the fish school");
    CLI11_PARSE(app, argc, argv);
    if (std::sscanf(options.size.c_str(), "%dx%d", &options.width, &options.height) != 2 || options.width < 1 ||
        options.height < 1 || options.width > 16384 || options.height > 16384) {
        std::fprintf(stderr, "--size %s: expected WxH, up to 16384x16384\n", options.size.c_str());
        return 2;
    }
    return defocus::engine::runBench("defocus_truth_bench",
                                     [&] { return defocus::engine::compareAll(options) ? 0 : 1; });
}
