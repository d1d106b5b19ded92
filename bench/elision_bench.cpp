// Measures the time and memory that a plan saves by omitting unneeded work. Each scene is drawn twice: with all work,
// and without the unneeded work. There is one scene for each kind of unneeded work, and one scene without any.
//
// Held constant: size, samples, levels, renderer and process. The two variants run alternately; the fastest run of each
// variant counts. The PSNR between the two images is infinite if the omissions don't change the image.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "gl/context.h"
#include "image/metrics.h"
#include "render/methods.h"
#include "run_bench.h"
#include "scene/defaults.h"
#include "school/fish_school.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int runs = 3;

struct Fish {
    World world;
    View view;
    RenderSettings settings;
};

void prepare(Fish& fish) {
    fish.world.scene = std::make_shared<const Scene>(fishSchool({.fishCount = 20, .trianglesPerFish = 20'000}));
    const Scene& scene = *fish.world.scene;
    fish.world.pose = poseAt(scene, 0);
    fish.view.width = 512;
    fish.view.height = 384;
    const PlacedCamera placed = chooseCamera(scene, fish.world.pose, {}, 4.0 / 3.0);
    fish.world.lights = lightsOrDefault(scene, fish.world.pose, placed);
    fish.world.environment = environmentOrDefault(scene);
    fish.world.pyramids = buildPyramids(scene.meshes);
    fish.view.worldFromCamera = placed.worldFromCamera;
    fish.view.lens.fStop = placed.camera.lensValue("fStop").value();
    fish.view.lens.focusDistance = placed.camera.lensValue("focusDistance").value();
    fish.settings.sequence = Sequence::halton;  // lens sequence with which the committed results were made
}

struct Measured {
    double setup = std::numeric_limits<double>::infinity();   // set-up time of the renderer, ms
    double render = std::numeric_limits<double>::infinity();  // render time, ms
    double megabytes = 0;
    Image image;
};

Measured measure(const Fish& fish, bool keepAll, Measured best) {
    RenderSettings settings = fish.settings;
    settings.keepAll = keepAll;
    const auto renderer = methodNamed("accumulation").make(fish.world, {});
    drawAllSamples(*renderer, planFrame(fish.world, fish.view, settings));
    const RenderStats stats = renderer->stats();
    best.setup = std::min(best.setup, stats.setupMilliseconds);
    best.render = std::min(best.render, stats.renderMilliseconds);
    best.megabytes = static_cast<double>(stats.peakBytes) / 1e6;
    best.image = renderer->image();
    return best;
}

void compare(const char* name, const Fish& fish) {
    Measured kept;
    Measured lean;
    for (int i = 0; i < runs; ++i) {
        kept = measure(fish, true, std::move(kept));
        lean = measure(fish, false, std::move(lean));
    }
    const Difference difference = compareImages(kept.image, lean.image);
    fmt::print("{:<44} {:>8.0f} {:>8.0f} {:>7.2f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f}\n", name, kept.render,
               lean.render, kept.render / lean.render, kept.setup, lean.setup, kept.megabytes, lean.megabytes,
               difference.psnr);
}

int run() {
    const auto context = createHeadlessContext();
    fmt::print("{}, {}\n20 fish of 20,000 triangles, 512 x 384, 64 samples, fastest of {} runs; kept | left out\n\n",
               context->device(), context->driver(), runs);
    fmt::print("{:<44} {:>17} {:>7} {:>17} {:>17} {:>8}\n", "", "render ms", "ratio", "set-up ms", "GPU MB", "PSNR");
    Fish fish;
    prepare(fish);
    compare("all in view, blurred (nothing but levels)", fish);
    const glm::dmat4 camera = fish.view.worldFromCamera;
    fish.view.worldFromCamera = camera * glm::rotate(glm::dmat4(1), 0.55, glm::dvec3(0, 1, 0));
    compare("most fish out of view (culling)", fish);
    fish.view.worldFromCamera = camera;
    fish.view.lens.fStop = 64;
    compare("f/64: nothing blurred (lens samples)", fish);
    return 0;
}

}  // namespace

int main() {
    return defocus::engine::runBench("defocus_elision_bench", run);
}
