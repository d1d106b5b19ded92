// Measures how much a tiny change of λ, the fractional level of detail, changes an image whose samples draw an object
// with two levels. At most one sample may switch levels if λ passes an integer or a value at which a sample switches.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "lod/pyramid/build_all.h"
#include "lod/pyramid/level_selection.h"
#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double nudge = 1e-6;          // tiny change of λ, the fractional level of detail
constexpr double oneSample = 1 + 1e-4;  // limit on movedSamples: one sample, and a margin for the rounding of floats
constexpr std::uint32_t renderedSamples = 60;  // not a multiple of the number of samples drawn together

// Returns a unit sphere made of rings of quads. Its levels have different silhouettes.
Mesh ballMesh() {
    constexpr std::uint32_t rings = 20;
    constexpr std::uint32_t sides = 40;
    Mesh mesh;
    for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double polar = std::numbers::pi * ring / rings;
            const double azimuth = 2 * std::numbers::pi * side / sides;
            mesh.vertices.positions.emplace_back(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                 -std::sin(polar) * std::sin(azimuth));
        }
    mesh.vertices.normals = mesh.vertices.positions;
    Primitive primitive{.material = 0, .indices = {}};
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = ring * sides + side;
            const std::uint32_t b = ring * sides + (side + 1) % sides;
            primitive.indices.insert(primitive.indices.end(), {a, a + sides, b + sides, a, b + sides, b});
        }
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

// A scene with a white ball on black. The image of a single lens sample is not antialiased: each pixel is 0 or 1.
struct Ball : BoardScene {
    Ball() : BoardScene(boardView(), {{5, {0, 0}, {1, 1}, glm::vec3(1)}}) {
        scene->meshes[0] = ballMesh();
        world.pyramids = buildPyramids(scene->meshes);
        world.pose.objects[0].worldFromObject[2][2] = 1;
        settings.sampleCount = renderedSamples;
        setBlur(view, 5, 6);
    }
};

// Renders the ball with the size threshold that selects the fractional level `lambda`. Returns an empty image if the
// plan selects another level.
Image imageAt(Ball& ball, double lambda, LodMode mode) {
    const std::vector<PyramidLevel>& levels = ball.world.pyramids[0].levels;
    const auto level = static_cast<std::size_t>(lambda);
    const double fraction = lambda - static_cast<double>(level);
    const double edge = std::pow(levels[level].meanEdge, 1 - fraction) * std::pow(levels[level + 1].meanEdge, fraction);
    ball.settings.lod = mode;
    const ObjectPlan object = planFrame(ball.world, ball.view, ball.settings).objects[0];
    ball.settings.thresholds = {0, object.projectedEdge * edge / levels[0].meanEdge};
    if (std::abs(planFrame(ball.world, ball.view, ball.settings).objects[0].lambda - lambda) > 0.01 * nudge) return {};
    return rendered(ball, "accumulation",
                    {.layerFormat = LayerFormat::rgba32f, .wave = 8, .shaderFolder = {}, .settings = {}});
}

// Returns the max change of a pixel when the fractional level changes from `from` to `to`, times the number of samples.
// One sample that switches its level changes a pixel by at most 1 in this unit.
double movedSamples(double from, double to, LodMode mode) {
    Ball ball;
    const Image before = imageAt(ball, from, mode);
    const Image after = imageAt(ball, to, mode);
    return before.empty() || after.empty() ? infinite : largestError(before, after) * renderedSamples;
}

}  // namespace

void addSplitCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, double limit, double from, double to, LodMode mode) {
        cases.push_back({"levels", std::move(name), "change, in samples that switch", "at most one", limit,
                         [=] { return movedSamples(from, to, mode); }});
    };
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous}) {
        const char* name = lodModeName(mode);
        // Fractional level at which the 21st sample switches to the coarser level (LodMode::fractional) or begins to
        // switch (LodMode::continuous).
        const double boundary = 1 + (mode == LodMode::fractional ? 20.5 : 20) / renderedSamples;
        for (const double level : {1.0, 2.0})
            add(fmt::format("rendered: level {:g} ± 1e-6, {}", level, name), oneSample, level - nudge, level + nudge,
                mode);
        add(fmt::format("rendered: level where a sample switches ± 1e-6, {}", name), oneSample, boundary - nudge,
            boundary + nudge, mode);
    }
    add("rendered: from level 1 to 2 in one step", infinite, 1, 2, LodMode::fractional);
}

}  // namespace defocus::engine
