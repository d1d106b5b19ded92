// Measures the method "circular" (Garcia 2018):
// - the time of the separable blur as a function of the radius, compared with a direct gather of the same kernel over
//   its complete square;
// - the time that a single pass for near and far field could save;
// - the flatness of the disks as a function of the number of components;
// - the error of storage formats;
// - the times of the variants that the performance slide of Garcia 2018 compares.
//
// Held constant within a table: image, process, kernel. Variants run alternately; the median time counts. Checks that
// the separable and the direct blur agree.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "eval/spread.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "gl/read_back.h"
#include "image/metrics.h"
#include "render/circular/circular_kernel.h"
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

// Prints an upper bound on the time that passes would save by blurring near and far field together. Such passes would
// still read, weight and write both fields, so they could save at most the time of one field's passes without taps.
void savedByOnePass() {
    fmt::print(
        "A field's passes, two components, ms (median of {}), and the share that one pass for both fields could save "
        "at "
        "most\n{:>12} {:>10} {:>12} {:>12} {:>10}\n",
        runs, "size px", "radius px", "with taps", "without", "share");
    for (const auto& [width, height] : {std::pair(512, 384), std::pair(1024, 768)}) {
        const GlTexture field = textureOf(filled(width, height, 4, 1), TextureFormat::rgba16f);
        const GlTexture none = textureOf(filled(width, height, 1, 0), TextureFormat::r32f);
        ComplexBlur blur({.width = width, .height = height, .components = 2, .shaderFolder = {}});
        for (const float r : {2.0f, 8.0f, 32.0f}) {
            const GlTexture radius = textureOf(filled(width, height, 1, r), TextureFormat::r32f);
            std::vector<double> with, without;
            for (int i = 0; i <= runs; ++i) {
                const double first = milliseconds(blur, field, radius);
                const double second = milliseconds(blur, field, none);
                if (i == 0) continue;  // don't count the run that compiles the shaders
                with.push_back(first);
                without.push_back(second);
            }
            const double taps = spreadOf(with).median;
            const double noTaps = spreadOf(without).median;
            fmt::print("{:>12} {:>10} {:>12.2f} {:>12.2f} {:>8.0f} %\n", fmt::format("{} x {}", width, height), r, taps,
                       noTaps, 100 * noTaps / (2 * taps));
        }
    }
    fmt::print("\n");
}

void disks() {
    constexpr int size = 128;
    constexpr double radiusAsked = 32;
    fmt::print(
        "A point of light by components: disk of {} px asked; level 1 is the ideal disk's. The passes' time is of {} x "
        "{} "
        "px\n{:>10} {:>10} {:>10} {:>12} {:>12} {:>12} {:>10} {:>10}\n",
        radiusAsked, size, size, "components", "radius px", "energy", "ripple rms", "ripple most", "edge px", "below 0",
        "ms");
    Image point(size, size, 4);
    constexpr int centre = size / 2;
    for (int c = 0; c < 4; ++c) point.at(centre, centre)[c] = 1;
    const double level = 1 / (std::numbers::pi * radiusAsked * radiusAsked);
    for (int components = 1; components <= circularKernelLimit; ++components) {
        ComplexBlur blur({.width = size,
                          .height = size,
                          .components = components,
                          .storage = ComplexStorage::float32,
                          .shaderFolder = {}});
        const GlTexture field = textureOf(point, TextureFormat::rgba32f);
        const GlTexture radius = textureOf(filled(size, size, 1, static_cast<float>(radiusAsked)), TextureFormat::r32f);
        std::vector<double> times;
        for (int i = 0; i < runs; ++i) times.push_back(milliseconds(blur, field, radius));
        const Image image = readBack(blur.result(), 4);
        double energy = 0, moment = 0, ripple = 0, max = 0, inside = 0, below = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double value = *image.at(x, y);
                const double r = std::hypot(x - centre, y - centre);
                energy += value;
                moment += value * r * r;
                below += std::min(value, 0.0);
                if (r > 0.9 * radiusAsked) continue;
                const double deviation = value / level - 1;
                ripple += deviation * deviation;
                max = std::max(max, std::abs(deviation));
                inside += 1;
            }
        // Measure the width of the disk's edge, from 90 % to 10 % of the value inside the disk, along the row through
        // its centre.
        double high = 0, low = size;
        for (int x = centre; x < size; ++x) {
            const double value = *image.at(x, centre) / level;
            if (value > 0.9) high = x - centre;
            if (value < 0.1 && low == size) low = x - centre;
        }
        fmt::print("{:>10} {:>10.2f} {:>10.4f} {:>12.4f} {:>12.4f} {:>12.1f} {:>10.4f} {:>10.2f}\n", components,
                   std::sqrt(2 * moment / energy), energy, std::sqrt(ripple / inside), max, low - high, below,
                   spreadOf(times).median);
    }
    fmt::print("\n");
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

void printHead() {
    fmt::print("{:<132} {:>9} {:>9} {:>9} {:>8} {:>9}\n", "method", "PSNR dB", "FLIP", "largest", "GPU MB", "frame ms");
}

PreparedFrame school(std::optional<double> fStop) {
    Request scene;
    scene.size.width = 512;
    scene.size.height = 384;
    scene.lens.fStop = fStop;
    return prepareFrame(scene);
}

// Prints the error of the image for each storage format, relative to storage in 32-bit floats.
void storages() {
    const PreparedFrame frame = school(0.95);
    fmt::print("Storage, school of fish at {} x {} px, f/{}, against 32-bit floats\n", frame.view.width,
               frame.view.height, frame.view.lens.fStop);
    printHead();
    for (const char* components : {"near-components=1,far-components=2", "near-components=5,far-components=5"}) {
        std::vector<std::string> methods;
        for (const char* storage : {"float", "half", "r10g10b10a2"})
            methods.push_back(fmt::format("circular:{},storage={}", components, storage));
        const std::vector<Measured> all = measured(frame, methods);
        printDifferences(all.front().image, all);
    }
    fmt::print("\n");
}

// Repeats the comparison on the performance slide of Garcia 2018: blur at half the width with one kernel component, and
// at a quarter of the width with two. The baseline is a gather over the square at both sizes, and at full size without
// a limit on the blur.
void slideOfPerformance() {
    PreparedFrame frame = school({});
    constexpr std::uint32_t samples = 1024;
    fmt::print(
        "As on the slide on performance, school of fish at {} x {} px, f/{}, against accumulation with {} samples\n",
        frame.view.width, frame.view.height, frame.view.lens.fStop, samples);
    printHead();
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
    savedByOnePass();
    disks();
    storages();
    slideOfPerformance();
    return 0;
}

}  // namespace

int main() {
    return defocus::engine::runBench("defocus_post_process_bench", run);
}
