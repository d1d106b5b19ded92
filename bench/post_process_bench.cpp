// Measures the method "circular" (Garcia 2018):
// - the time of the separable blur as a function of the radius, compared with a direct gather of the same kernel over
//   its complete square;
// - the times of the variants that the performance slide of Garcia 2018 compares.
//
// All rows of a table are measured on the same image, in one run of the program. Variants run alternately; the tables
// have median times. The bench also checks that the separable and the direct blur agree.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "eval/spread.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "gl/read_back.h"
#include "image/metrics.h"
#include "render/circular/complex_blur.h"
#include "render/methods.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int runs = 5;

GlTexture textureOf(const Image& image, TextureFormat format) {
    GlTexture texture({.format = format, .width = image.width, .height = image.height});
    texture.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    texture.upload(0, image.width, image.height, image.pixels.data());
    return texture;
}

Image filled(int width, int height, int channels, float value) {
    Image image(width, height, channels);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

double milliseconds(ComplexBlur& blur, const GlTexture& field, const GlTexture& radius) {
    const auto begin = std::chrono::steady_clock::now();
    blur.blur(field, radius);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

// Returns the exponent p of the power law y ∝ x^p, by a least-squares fit to the logarithms of x and y.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const auto n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double lx = std::log(x[i]);
        const double ly = std::log(y[i]);
        sx += lx;
        sy += ly;
        sxx += lx * lx;
        sxy += lx * ly;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void costOverRadius() {
    constexpr int width = 128;
    constexpr int height = 96;
    Image checks(width, height, 4);
    for (std::size_t i = 0; i < checks.pixels.size(); ++i)
        checks.pixels[i] = i % 4 == 3 || (i / 4 % 16 < 8) != (i / 4 / width % 16 < 8) ? 1.0f : 0.1f;
    const GlTexture field = textureOf(checks, TextureFormat::rgba16f);
    fmt::print("Cost over the radius, {} x {} px, ms (median of {})\n{:>10} {:>12} {:>12}\n", width, height, runs,
               "radius px", "separable", "direct");
    ComplexBlurInfo info{.width = width, .height = height, .components = 2, .shaderFolder = {}};
    ComplexBlur separable(info);
    info.direct = true;
    ComplexBlur direct(info);
    std::vector<double> radii, separableTimes, directTimes;
    for (const float r : {0.0f, 8.0f, 16.0f, 32.0f, 64.0f}) {
        const GlTexture radius = textureOf(filled(width, height, 1, r), TextureFormat::r32f);
        std::vector<double> a, b;
        for (int i = 0; i <= runs; ++i) {
            const double first = milliseconds(separable, field, radius);
            const double second = milliseconds(direct, field, radius);
            if (i == 0) continue;  // don't count the run that compiles the shaders
            a.push_back(first);
            b.push_back(second);
        }
        const Difference difference = compareImages(readBack(separable.result(), 4), readBack(direct.result(), 4));
        if (!(difference.maxError < 2e-3)) fail("radius {}: the two blurs differ by {}", r, difference.maxError);
        const double ofSeparable = spreadOf(a).median;
        const double ofDirect = spreadOf(b).median;
        fmt::print("{:>10} {:>12.2f} {:>12.2f}\n", r, ofSeparable, ofDirect);
        if (r == 0) continue;  // leave radius 0 out of the fit, because it has no taps
        radii.push_back(r);
        separableTimes.push_back(ofSeparable);
        directTimes.push_back(ofDirect);
    }
    fmt::print("{:>10} {:>12.2f} {:>12.2f}\n\n", "exponent", exponent(radii, separableTimes),
               exponent(radii, directTimes));
}

struct Measured {
    std::string method;
    Image image;
    double milliseconds = 0;  // median time of a frame
    double megabytes = 0;     // peak use of graphics memory
};

// Draws `frame` `repeats` times with each method. The methods run alternately.
std::vector<Measured> measured(const PreparedFrame& frame, const std::vector<std::string>& methods,
                               int repeats = runs) {
    const FramePlan plan = planFrame(frame.world, frame.view, frame.settings);
    std::vector<Measured> all;
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (const std::string& method : methods) {
        const MethodUse use = parseMethodUse(method);
        const RendererOptions options{.settings = use.settings};
        renderers.push_back(use.method->make(frame.world, options));
        all.emplace_back().method = use.text();
    }
    std::vector<std::vector<double>> times(methods.size());
    for (int i = 0; i < repeats; ++i)
        for (std::size_t k = 0; k < renderers.size(); ++k) {
            drawAllSamples(*renderers[k], plan);
            times[k].push_back(renderers[k]->stats().renderMilliseconds);
        }
    for (std::size_t k = 0; k < renderers.size(); ++k) {
        all[k].image = renderers[k]->image();
        all[k].milliseconds = spreadOf(times[k]).median;
        all[k].megabytes = static_cast<double>(renderers[k]->stats().peakBytes) * 1e-6;
    }
    return all;
}

void printDifferences(const Image& reference, const std::vector<Measured>& all) {
    for (const Measured& one : all) {
        const Difference difference = compareImages(reference, one.image);
        fmt::print("{:<132} {:>9.2f} {:>9.5f} {:>9.5f} {:>8.1f} {:>9.1f}\n", one.method, difference.psnr,
                   difference.flip, difference.maxError, one.megabytes, one.milliseconds);
    }
}

// Repeats the comparison on the performance slide of Garcia 2018: blur at half the width and height with one kernel
// component, and at a quarter with two. The baselines are direct gathers over the kernel's square: one at each of these
// sizes, and one at full size without a limit on the blur.
void slideOfPerformance() {
    Request scene;
    scene.size.width = 512;
    scene.size.height = 384;
    PreparedFrame frame = prepareFrame(scene);
    constexpr std::uint32_t samples = 1024;
    fmt::print(
        "As on the slide on performance, school of fish at {} x {} px, f/{}, against accumulation with {} samples\n",
        frame.view.width, frame.view.height, frame.view.lens.fStop, samples);
    fmt::print("{:<132} {:>9} {:>9} {:>9} {:>8} {:>9}\n", "method", "PSNR dB", "FLIP", "largest", "GPU MB", "frame ms");
    const std::string common =
        "circular:near-components=1,far-components={},resolution={},kernel=published,max-coc=published,"
        "transparency-buckets=0,pinholes=1,{}";
    const std::string published = "kernel-taps=eight,storage=r10g10b10a2";
    const std::vector<Measured> all = measured(
        frame, {fmt::format(fmt::runtime(common), 1, "half", published),
                fmt::format(fmt::runtime(common), 2, "quarter", published),
                fmt::format(fmt::runtime(common), 1, "half", "convolution=direct"),
                fmt::format(fmt::runtime(common), 2, "quarter", "convolution=direct"),
                "circular:near-components=1,kernel=published,transparency-buckets=0,pinholes=1,convolution=direct"});
    frame.settings.sampleCount = samples;
    printDifferences(measured(frame, {"accumulation"}, 1).front().image, all);
}

int run() {
    const auto context = createHeadlessContext();
    fmt::print("{}, {}\n\n", context->device(), context->driver());
    costOverRadius();
    slideOfPerformance();
    return 0;
}

}  // namespace

int main() {
    return defocus::engine::runBench("defocus_post_process_bench", run);
}
