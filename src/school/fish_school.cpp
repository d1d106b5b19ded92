// Places the fish of the school, its camera and its lights. The school is modelled on the test scene of Jeong, Kim and
// Lee, Multi-Resolution Depth-of-Field Rendering (2011): twenty fish at depths of about one to eight metres. The first
// twenty fish are placed by hand; further fish are scattered behind and among them.

#include "school/fish_school.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <mutex>

#include "core/error.h"
#include "core/parallel.h"
#include "school/random.h"
#include "school/species.h"

namespace defocus::engine {
namespace {

constexpr int maximumFish = 10'000;
constexpr int minimumTriangles = 200;
constexpr int maximumTriangles = 10'000'000;
// Max number of triangles of a school; they take about 10 GB of memory.
constexpr std::int64_t maximumTotal = 400'000'000;

// Camera: 50 mm lens at f/0.95 on a 36 mm wide sensor, focused at 2 m. The CoC diameter in an image 1024 px wide is
// 74.9 px · |1/2 − 1/z| for a depth of z m. It is 37 px at 1 m, under 2 px from 1.90 to 2.11 m, and at most 37 px
// behind the focus plane.
constexpr double horizontalAperture = 36.0;
constexpr double fStop = 0.95;
constexpr double focusDistance = 2.0;
constexpr double tanHalfWidth = 0.36;   // sensor width 36 mm / (2 · focal length 50 mm)
constexpr double tanHalfHeight = 0.27;  // at an aspect ratio of 4:3
constexpr double cameraTilt = 0.28;     // upward tilt in radians, so that the bright water surface is the background

struct Placement {
    FishSpecies species;
    int variant;
    double x, y;        // image position in [−1, 1]; +x right, +y up
    double depth;       // distance from the camera along its axis, m
    float length;       // body length in m, without the tail fin
    double yaw, pitch;  // degrees; yaw 0: swims to the right, yaw > 0: towards the camera, pitch > 0: upwards
};

using enum FishSpecies;
constexpr std::array<Placement, 20> composition{{
    // Fish in focus.
    {angelfish, 0, 0.18, 0.06, 2.00, 0.27f, 22, 4},
    {butterflyfish, 0, 0.71, -0.28, 2.02, 0.25f, 16, -6},
    {anthias, 0, -0.48, 0.46, 2.03, 0.26f, 24, 6},
    {tang, 0, 0.62, 0.62, 2.03, 0.26f, 18, -2},
    // Fish in front of the focus plane.
    {clownfish, 0, -0.42, -0.38, 1.62, 0.22f, 26, 8},
    {goldfish, 0, -0.82, -0.84, 1.10, 0.175f, 22, 12},
    {tang, 1, 0.72, -0.86, 1.16, 0.17f, 26, 8},
    {anthias, 2, -0.90, 0.84, 1.26, 0.19f, 14, 0},
    // Fish behind the focus plane.
    {anthias, 1, 0.06, -0.66, 2.45, 0.30f, 30, 8},
    {parrotfish, 0, -0.86, 0.06, 2.90, 0.42f, 18, 5},
    {butterflyfish, 1, -0.06, 0.66, 3.00, 0.36f, 24, 2},
    {goldfish, 1, 0.36, 0.42, 3.40, 0.40f, 18, 4},
    {idol, 0, -0.33, 0.03, 3.50, 0.42f, 16, 2},
    {fusilier, 0, 0.74, 0.17, 3.60, 0.50f, 20, 2},
    {angelfish, 1, 0.40, -0.70, 3.30, 0.38f, 26, 6},
    {fusilier, 1, -0.44, -0.76, 4.20, 0.56f, 20, 8},
    {fusilier, 0, -0.13, -0.36, 5.20, 0.66f, 18, 6},
    {clownfish, 1, 0.28, 0.86, 4.80, 0.60f, 14, 0},
    {parrotfish, 1, 0.40, -0.30, 5.20, 0.66f, 20, 2},
    {tang, 0, -0.68, 0.80, 6.60, 0.78f, 12, 6},
}};

glm::dquat cameraRotation() {
    return glm::angleAxis(cameraTilt, glm::dvec3(1, 0, 0));
}

glm::dvec3 worldPosition(const Placement& fish) {
    return cameraRotation() *
           glm::dvec3(fish.x * tanHalfWidth * fish.depth, fish.y * tanHalfHeight * fish.depth, -fish.depth);
}

// Adds fish at random positions behind the focus plane until the school has `count` fish. Fish do not overlap; the
// depth range grows with each position that is rejected.
void scatter(std::size_t count, std::uint32_t seed, std::vector<Placement>& school) {
    std::vector<glm::dvec3> centres;
    centres.reserve(count);
    for (const Placement& fish : school) centres.push_back(worldPosition(fish));
    double deepest = 8.0;
    FishRandom random(seed, 0xf15cu);
    while (school.size() < count) {
        const auto palette = static_cast<int>(random.next() & 0xffu);
        const auto species = static_cast<FishSpecies>(random.next() % fishSpeciesCount);
        const double share = random.uniform();
        Placement fish{.species = species,
                       .variant = palette,
                       .x = random.uniform(-1.05f, 1.05f),
                       .y = random.uniform(-1.05f, 1.05f),
                       .depth = std::cbrt(27.0 + share * (deepest * deepest * deepest - 27.0)),
                       .length = random.uniform(0.3f, 0.45f),
                       .yaw = random.uniform(-5.0f, 25.0f),
                       .pitch = random.uniform(-6.0f, 9.0f)};
        const glm::dvec3 centre = worldPosition(fish);
        const bool clear = std::none_of(centres.begin(), centres.end(),
                                        [&](const glm::dvec3& other) { return glm::distance(centre, other) < 0.75; });
        if (clear) {
            school.push_back(fish);
            centres.push_back(centre);
        } else {
            deepest += 0.02;
        }
    }
}

int addNode(Node node, Scene& scene) {
    const auto index = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
    scene.roots.push_back(index);
    return index;
}

void addCamera(Scene& scene) {
    Camera camera;
    camera.name = "Camera";
    camera.yfov = 2.0 * std::atan(tanHalfHeight);
    camera.aspectRatio = tanHalfWidth / tanHalfHeight;
    camera.lens = {{"fStop", fStop}, {"focusDistance", focusDistance}, {"horizontalAperture", horizontalAperture}};
    scene.cameras.push_back(camera);
    Node node;
    node.name = "Camera";
    node.rotation = cameraRotation();
    node.camera = 0;
    addNode(std::move(node), scene);
}

// Adds a directional light along `direction` in camera coordinates. In glTF, a directional light shines along its
// node's −z axis.
void addSun(const std::string& name, const glm::vec3& color, float lux, const glm::dvec3& direction, Scene& scene) {
    Light light;
    light.name = name;
    light.type = LightType::directional;
    light.color = color;
    light.intensity = lux;
    Node node;
    node.name = name;
    node.rotation = cameraRotation() * glm::quatLookAt(glm::normalize(direction), glm::dvec3(0, 1, 0));
    node.light = static_cast<int>(scene.lights.size());
    scene.lights.push_back(light);
    addNode(std::move(node), scene);
}

void addSurroundings(Scene& scene) {
    addSun("Sunlight", {1.0f, 0.93f, 0.78f}, 3.0f, {0.3, -1.0, -0.8}, scene);
    addSun("Fill", {0.75f, 0.9f, 1.0f}, 0.55f, {-0.5, 0.05, -1.0}, scene);
    Environment water;
    water.type = EnvironmentType::gradient;
    water.zenith = {0.40f, 1.18f, 1.34f};
    water.horizon = {0.002f, 0.040f, 0.130f};
    water.nadir = {0.001f, 0.010f, 0.040f};
    water.lighting = 0.65f;
    scene.environment = water;
}

void addMaterials(Scene& scene) {
    Material skin;
    skin.name = "Fish skin";
    skin.metallicFactor = 0.0f;
    skin.roughnessFactor = 0.37f;
    Material eye = skin;
    eye.name = "Fish eye";
    eye.roughnessFactor = 0.28f;
    scene.materials = {skin, eye};
}

void checkOptions(const FishSchoolOptions& options) {
    if (options.fishCount < 1 || options.fishCount > maximumFish) {
        fail("fish school: {} fish requested; choose 1 to {}", options.fishCount, maximumFish);
    }
    if (options.trianglesPerFish < minimumTriangles || options.trianglesPerFish > maximumTriangles) {
        fail("fish school: {} triangles per fish requested; choose {} to {}", options.trianglesPerFish,
             minimumTriangles, maximumTriangles);
    }
    const std::int64_t total = std::int64_t{options.fishCount} * options.trianglesPerFish;
    if (total > maximumTotal) {
        fail("fish school: {} fish of {} triangles have {} triangles in total; the maximum is {}", options.fishCount,
             options.trianglesPerFish, total, maximumTotal);
    }
}

}  // namespace

Scene fishSchool(const FishSchoolOptions& options, const Progress& progress) {
    checkOptions(options);
    const auto count = static_cast<std::size_t>(options.fishCount);

    std::vector<Placement> school(
        composition.begin(), composition.begin() + static_cast<std::ptrdiff_t>(std::min(count, composition.size())));
    if (count > school.size()) scatter(count, options.seed, school);

    Scene scene;
    scene.name = "Fish school";
    scene.school = true;
    addMaterials(scene);
    scene.meshes.resize(count);
    std::mutex reporting;
    std::uint64_t done = 0;
    parallelFor(count, [&](std::size_t i) {
        const Fish fish = makeFish(school[i].species, school[i].variant, school[i].length, options.seed,
                                   static_cast<std::uint32_t>(i));
        scene.meshes[i] = fishMesh(fish, options.trianglesPerFish, 0, 1);
        const std::lock_guard lock(reporting);
        report(progress, "fish", ++done, count);
    });

    // Add the nodes of the fish, the camera and the lights.
    for (std::size_t i = 0; i < count; ++i) {
        constexpr double radians = 3.14159265358979323846 / 180.0;
        Node node;
        node.name = fmt::format("Fish {}", i + 1);
        node.mesh = static_cast<int>(i);
        node.translation = worldPosition(school[i]);
        node.rotation = cameraRotation() * glm::angleAxis(-school[i].yaw * radians, glm::dvec3(0, 1, 0)) *
                        glm::angleAxis(school[i].pitch * radians, glm::dvec3(0, 0, 1));
        addNode(std::move(node), scene);
    }
    addCamera(scene);
    addSurroundings(scene);
    return scene;
}

}  // namespace defocus::engine
