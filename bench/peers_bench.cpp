// Renders one scene with several methods and numbers of lens samples, for `scripts/figures peers`.
//
// Writes FOLDER/scene.glb, the scene with lighting baked into vertex colours (unlit_file.h), and renders this file.
// Writes one image for each method and number of samples, FOLDER/METHOD-SAMPLES.exr, and METHOD-reference.exr with
// another seed at full detail. Prints a line of JSON for scene.glb, and one for each image with its render time. The
// time ends when the image is in main memory. Each method first draws an untimed frame. CPU time is the time of all
// threads. METHOD can be auto-4: method auto with four pixel positions per lens sample.
//
//   defocus_peers_bench FOLDER [SCENE] [--fstop 16] [--size 512x384]
//       [--methods auto,auto-4,accumulation,embree-shared,embree]
//       [--counts 2,4,8,16,32,64,128,256] [--reference-samples 1024]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/stopwatch.h"
#include "embree/embree_renderer.h"
#include "frame/driver/scene_driver.h"
#include "frame/program_facts.h"
#include "image/image_io.h"
#include "run_bench.h"
#include "unlit_file.h"

namespace {

using namespace defocus;
using namespace defocus::engine;
using Json = nlohmann::json;

// Images with at most this number of lens samples are drawn three times; the fastest run counts.
constexpr std::uint32_t maxRepeated = 32;
constexpr std::uint32_t referenceSeed = 1'000'000;
constexpr Color background = {0.02f, 0.08f, 0.15f};  // background, linear RGB

struct Options {
    std::filesystem::path folder;
    std::filesystem::path scene;
    std::optional<double> fStop;
    std::vector<std::string> methods = {"auto", "auto-4", "accumulation", "embree-shared", "embree"};
    std::vector<std::uint32_t> counts = {2, 4, 8, 16, 32, 64, 128, 256};
    std::uint32_t referenceSamples = 1024;
    int width = 512;
    int height = 384;
};

void print(const Json& line) {
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
}

// Writes the scene file FOLDER/scene.glb, and returns the request to render it.
Request sceneFile(const Options& options) {
    Request request;
    request.scene = options.scene;
    request.size = {.width = options.width, .height = options.height};
    request.units = 1;
    request.lens.fStop = options.fStop;
    request.lod = LodMode::off;
    const PreparedFrame frame = placeFrame(request);
    Request written;
    written.scene = options.folder / "scene.glb";
    written.size = request.size;
    written.units = 1;
    written.background = background;
    writeUnlitFile(written.scene, frame);
    const Lens& lens = frame.view.lens;
    std::uint64_t triangles = 0;
    for (const Object& object : frame.world.pose.objects)
        triangles += frame.scene->meshes[static_cast<std::size_t>(object.mesh)].triangleCount();
    print({{"file", "scene.glb"},
           {"commit", programCommit()},
           {"triangles", triangles},
           {"background", background},
           {"fStop", lens.fStop},
           {"focalLength", lens.focalLength},
           {"focusDistance", lens.focusDistance},
           {"sensorWidth", lens.horizontalAperture},
           {"nearPlane", frame.view.nearPlane}});
    return written;
}

void drawFrame(SceneDriver& driver) {
    while (driver.advance()) {
    }
}

// Sets the method, and the number of pixel positions per lens sample.
void useMethod(Request& request, const std::string& name) {
    const bool four = name == "auto-4";
    request.method = four ? automaticMethod : name;
    request.positions = four ? 4 : 1;
}

void render(SceneDriver& driver, const std::string& method, const Request& request, const std::filesystem::path& file) {
    double cpu = std::numeric_limits<double>::infinity();
    double seconds = cpu;
    const int runs = *request.samples <= maxRepeated ? 3 : 1;
    Image image;
    for (int i = 0; i < runs; ++i) {
        driver.start(request);
        const Clock::time_point begin = Clock::now();
        const std::clock_t before = std::clock();
        drawFrame(driver);
        image = driver.image();
        cpu = std::min(cpu, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
        seconds = std::min(seconds, millisecondsSince(begin) / 1000);
    }
    writeImage(file, image);
    print({{"method", method},
           {"drawnBy", driver.driver().method().text()},
           {"samples", *request.samples},
           {"seconds", seconds},
           {"cpuSeconds", cpu},
           {"device", driver.statistics().device}});
}

int run(const Options& options) {
    registerEmbree();
    Request request = sceneFile(options);
    SceneDriver driver(nullptr, request, {}, {});
    for (const std::string& method : options.methods) {
        useMethod(request, method);
        request.samples = options.counts.front();
        driver.start(request);
        drawFrame(driver);
        for (const std::uint32_t count : options.counts) {
            request.samples = count;
            render(driver, method, request, options.folder / fmt::format("{}-{}.exr", method, count));
        }
    }
    request.samples = options.referenceSamples;
    request.seed = referenceSeed;
    request.lod = LodMode::off;
    for (const char* method : {"accumulation", "embree"}) {
        useMethod(request, method);
        driver.start(request);
        drawFrame(driver);
        writeImage(options.folder / fmt::format("{}-reference.exr", method), driver.image());
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    std::string size = "512x384";
    CLI::App app("Time and image of methods and numbers of lens samples, for scripts/figures peers");
    app.add_option("folder", options.folder, "existing folder for the scene's file and the images")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("scene", options.scene, "glTF file; default: the built-in school of fish");
    app.add_option("--fstop", options.fStop, "f-number; default: from the camera")->check(CLI::Range(0.1, 1000.0));
    app.add_option("--size", size, "WxH in px");
    app.add_option("--methods", options.methods, "names of methods; auto-4: auto with four positions")->delimiter(',');
    app.add_option("--counts", options.counts, "numbers of lens samples")
        ->delimiter(',')
        ->check(CLI::Range(1u, maxSamples));
    app.add_option("--reference-samples", options.referenceSamples, "lens samples of the references")
        ->check(CLI::Range(1u, maxSamples));
    CLI11_PARSE(app, argc, argv);
    if (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 || options.width < 1 ||
        options.height < 1 || options.width > 16384 || options.height > 16384) {
        fmt::print(stderr, "--size {}: expected WxH, 1x1 to 16384x16384\n", size);
        return 2;
    }
    return runBench("defocus_peers_bench", [&] { return run(options); });
}
