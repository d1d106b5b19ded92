// Repeats the measurements of Tzeng et al. 2012 with our lens-space methods. Compares line samples with stochastic
// points on the same scenes (their Table 1). Measures the time as a function of the number of lines, the aperture and
// the levels of detail (their Figure 7).
//
//   defocus_lens_space_bench [--size WIDTHxHEIGHT] [--figure7] MODEL...
//
// Held constant within a table: scene, camera, lights, image size and process. In Table 1, the blur of the most blurred
// object is a tenth of the image's width. In Figure 7, each row of the table states the blur, and the focal plane is in
// front of all objects. Times are medians of three frames. Each method first draws one frame that compiles its shaders;
// then the methods take turns. Errors are RMSE of display-encoded images. The reference of Table 1 is accumulation with
// 1,600 samples of another seed at full detail. The reference of Figure 7 is the same method at full detail. Errors "of
// 8 x 8 px" compare means over squares of this size, which suppresses noise and keeps structure. "As published" is the
// method of preset tzeng2012. It is drawn and compared with focus breathing, because the paper's circle of confusion is
// that of a thin lens whose sensor moves to focus. Levels of detail are selected by the paper's score, the ratio of
// blur to edge length. We select among the fractional levels of a pyramid; the paper has three levels with 100, 75 and
// 50 % of the vertices. The bench checks that every RMSE is below 0.1.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "core/parse.h"
#include "eval/spread.h"
#include "frame/settings/presets.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "image/metrics.h"
#include "image/tone_map.h"
#include "render/methods.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int timedFrames = 3;
constexpr std::uint32_t referenceSamples = 1600;
constexpr double tableBlur = 0.1;     // blur of the most blurred object in Table 1, as a fraction of the image's width
constexpr double largestError = 0.1;  // limit on the RMSE against the reference image

struct Measured {
    double milliseconds = 0;
    Image image;
    RenderStats stats;
};

// A method to compare, with its scene, view and settings.
struct Contestant {
    const PreparedFrame* frame;
    const View* view;
    std::string method;
    RenderSettings settings;
};

// Measures the contestants. Their frames are drawn alternately, so that other load on the machine affects all of them.
// With frames = 0, only renders the images.
std::vector<Measured> measured(const std::vector<Contestant>& contestants, int frames = timedFrames) {
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<FramePlan> plans;
    for (const Contestant& contestant : contestants) {
        const MethodUse use = parseMethodUse(contestant.method);
        const RendererOptions options{.settings = use.settings};
        renderers.push_back(use.method->make(contestant.frame->world, options));
        plans.push_back(planFrame(contestant.frame->world, *contestant.view, contestant.settings));
    }
    std::vector<std::vector<double>> times(contestants.size());
    for (int i = 0; i <= frames; ++i)
        for (std::size_t c = 0; c < contestants.size(); ++c) {
            drawAllSamples(*renderers[c], plans[c]);
            if (i > 0) times[c].push_back(renderers[c]->stats().renderMilliseconds);
        }
    std::vector<Measured> results;
    for (std::size_t c = 0; c < contestants.size(); ++c) {
        std::ranges::sort(times[c]);
        results.push_back(
            {times[c].empty() ? 0 : times[c][times[c].size() / 2], renderers[c]->image(), renderers[c]->stats()});
    }
    return results;
}

Image imageOf(const Contestant& contestant) {
    return std::move(measured({contestant}, 0).front().image);
}

// Returns the method of the preset tzeng2012 with its settings, as text.
std::string publishedMethod() {
    Request request;
    applyPreset(presetNamed("tzeng2012"), request);
    return chosenMethod(request).text();
}

RenderSettings settingsOf(std::uint32_t samples) {
    return {.sampleCount = samples, .lod = LodMode::off};
}

RenderSettings byScore(std::uint32_t samples) {
    RenderSettings settings = settingsOf(samples);
    settings.lod = LodMode::fractional;
    settings.metric = LodMetric::score;
    return settings;
}

RenderSettings ofThreeLevels(std::uint32_t samples) {
    RenderSettings settings = byScore(samples);
    settings.lod = LodMode::nearest;
    settings.thresholds.blur = 0.25;  // value from the preset tzeng2012
    return settings;
}

// Returns the view with a blur scale that gives the most blurred object a blur of `share` times the image's width. With
// `before`, the focal plane is at half the depth of the nearest object, so that all objects are blurred.
View blurredView(const PreparedFrame& frame, double share, bool before = false) {
    View view = frame.view;
    view.lens.blurScale = 1;
    RenderSettings settings = settingsOf(1);
    settings.keepAll = true;
    if (before) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const ObjectPlan& object : planFrame(frame.world, view, settings).objects)
            if (object.nearestDepth > view.nearPlane) nearest = std::min(nearest, object.nearestDepth);
        if (!std::isfinite(nearest)) fail("{}: nothing in it lies before the camera", frame.sceneName);
        view.lens.focusDistance = 0.5 * nearest;
    }
    double largest = 0;
    for (const ObjectPlan& object : planFrame(frame.world, view, settings).objects)
        if (std::isfinite(object.coc.largest)) largest = std::max(largest, object.coc.largest);
    if (!(largest > 0)) fail("{}: nothing in it is blurred", frame.sceneName);
    view.lens.blurScale = share * view.width / largest;
    return view;
}

double errorOf(const Image& reference, const Image& image, const std::string& name) {
    const double error = compareImages(reference, image, CompareOptions{}).rmse;
    if (!(error < largestError)) fail("{}: RMSE {}", name, error);
    return error;
}

// Returns the RMSE between two display-encoded images after averaging over squares of `side` × `side` px.
double errorOfSquares(const Image& reference, const Image& image, int side) {
    const Image a = displayEncoded(reference);
    const Image b = displayEncoded(image);
    double sum = 0;
    std::size_t count = 0;
    for (int y = 0; y + side <= a.height; y += side)
        for (int x = 0; x + side <= a.width; x += side)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double error = 0;
                for (int j = 0; j < side; ++j)
                    for (int i = 0; i < side; ++i)
                        error += static_cast<double>(b.at(x + i, y + j)[channel] - a.at(x + i, y + j)[channel]);
                sum += error * error / std::pow(side, 4);
                ++count;
            }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

Request requestOf(const std::string& model, int width, int height) {
    Request request;
    request.scene = model;
    request.size.width = width;
    request.size.height = height;
    request.lod = LodMode::off;
    return request;
}

void printTable1(const std::vector<std::string>& models, int width, int height) {
    const std::string published = publishedMethod();
    fmt::print(
        "| model | triangles | stochastic 256, ms | line 16, ms | times as fast | as published, ms | times as fast | "
        "RMSE stochastic | RMSE line | RMSE as published | RMSE, buffer alone | RMSE stochastic 64 | RMSE line, one "
        "wheel | 8 x 8 px, line "
        "| "
        "8 x 8 px, one wheel |\n"
        "| --- {}|\n",
        "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: ");
    for (const std::string& model : models) {
        const PreparedFrame frame = prepareFrame(requestOf(model, width, height));
        const View view = blurredView(frame, tableBlur);
        RenderSettings referenceSettings = settingsOf(referenceSamples);
        referenceSettings.seed = 9;
        const Image reference = imageOf({&frame, &view, "accumulation", referenceSettings});
        View breathing = view;
        breathing.lens.focusBreathing = true;
        const Image breathingReference = imageOf({&frame, &breathing, "accumulation", referenceSettings});
        const std::vector<Measured> all =
            measured({{&frame, &view, "stochastic", settingsOf(256)},
                      {&frame, &view, "line", settingsOf(16)},
                      {&frame, &breathing, published, settingsOf(16)},
                      {&frame, &view, "line:resolve=published,shading-step=0,wheel=shared", settingsOf(16)}});
        const auto& [points, lines, buffered, visibility] = std::tie(all[0], all[1], all[2], all[3]);
        const Image fewPoints = imageOf({&frame, &view, "stochastic", settingsOf(64)});
        const Image oneWheel = imageOf({&frame, &view, "line:wheel=shared", settingsOf(16)});
        fmt::print(
            "| {} | {} | {:.0f} | {:.0f} | {:.2f} | {:.0f} | {:.2f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | "
            "{:.4f} | {:.4f} | {:.4f} |\n",
            frame.sceneName, points.stats.trianglesDrawn, points.milliseconds, lines.milliseconds,
            points.milliseconds / lines.milliseconds, buffered.milliseconds,
            points.milliseconds / buffered.milliseconds, errorOf(reference, points.image, model),
            errorOf(reference, lines.image, model), errorOf(breathingReference, buffered.image, model),
            errorOf(reference, visibility.image, model), errorOf(reference, fewPoints, model),
            errorOf(reference, oneWheel, model), errorOfSquares(reference, lines.image, 8),
            errorOfSquares(reference, oneWheel, 8));
        std::fflush(stdout);
    }
}

void printFigure7(const std::string& model, int width, int height) {
    Request request = requestOf(model, width, height);
    request.lod = LodMode::fractional;
    const PreparedFrame frame = prepareFrame(request);
    request.levelVertices = LevelVertices::quarters;
    const PreparedFrame quarters = prepareFrame(request);
    fmt::print(
        "\n{}: milliseconds of line samples; RMSE from full detail with as many lines\n\n"
        "| lines | blur, share of the width | full detail | fractional levels | times as fast | RMSE | as published, "
        "three levels | "
        "times as fast | RMSE |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        frame.sceneName);
    for (const std::uint32_t lines : {4u, 8u, 16u, 32u})
        for (const double share : {0.02, 0.05, 0.1, 0.2}) {
            if (lines != 16 && share != tableBlur) continue;  // vary either the number of lines or the blur, not both
            const View view = blurredView(frame, share, true);
            const std::vector<Measured> all = measured({{&frame, &view, "line", settingsOf(lines)},
                                                        {&frame, &view, "line", byScore(lines)},
                                                        {&quarters, &view, publishedMethod(), settingsOf(lines)},
                                                        {&quarters, &view, publishedMethod(), ofThreeLevels(lines)}});
            const auto& [full, levels, fullPublished, three] = std::tie(all[0], all[1], all[2], all[3]);
            fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.2f} | {:.4f} | {:.0f} | {:.2f} | {:.4f} |\n", lines, share,
                       full.milliseconds, levels.milliseconds, full.milliseconds / levels.milliseconds,
                       errorOf(full.image, levels.image, model), three.milliseconds,
                       fullPublished.milliseconds / three.milliseconds,
                       errorOf(fullPublished.image, three.image, model));
            std::fflush(stdout);
        }
}

int run(const std::vector<std::string>& arguments) {
    int width = 800;
    int height = 800;
    bool figure7 = false;
    std::vector<std::string> models;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == "--figure7") {
            figure7 = true;
        } else if (arguments[i] == "--size" && i + 1 < arguments.size()) {
            const std::string& size = arguments[++i];
            const std::size_t times = std::min(size.find('x'), size.size() - 1);
            width = static_cast<int>(parseInteger(size.substr(0, times), 1, maxImageSide));
            height = static_cast<int>(parseInteger(size.substr(times + 1), 1, maxImageSide));
        } else {
            models.push_back(arguments[i]);
        }
    }
    if (models.empty()) fail("usage: defocus_lens_space_bench [--size WIDTHxHEIGHT] [--figure7] MODEL...");
    const auto context = createHeadlessContext();
    fmt::print("{}, {} x {} px\n\n", currentDevice(), width, height);
    if (!figure7) printTable1(models, width, height);
    if (figure7)
        for (const std::string& model : models) printFigure7(model, width, height);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return defocus::engine::runBench("defocus_lens_space_bench",
                                     [&] { return run(std::vector<std::string>(argv + 1, argv + argc)); });
}
