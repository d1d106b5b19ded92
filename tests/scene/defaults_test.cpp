// Compares the automatic camera with the projection of the scene's bounds, and the default lighting with an integral
// over a grey ball.

#include "scene/defaults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/error.h"

namespace defocus::engine {
namespace {

// Returns a scene whose bounds are the box from `minimum` to `maximum`.
Scene boxScene(const glm::vec3& minimum, const glm::vec3& maximum) {
    Scene scene;
    Mesh mesh;
    mesh.vertices.positions = {minimum, maximum, {minimum.x, maximum.y, minimum.z}};
    mesh.primitives = {{-1, {0, 1, 2}}};
    scene.meshes = {mesh};
    Node node;
    node.mesh = 0;
    scene.nodes = {node};
    scene.roots = {0};
    return scene;
}

class Framing : public testing::TestWithParam<double> {};

TEST_P(Framing, boxFitsCentredWithLittleToSpare) {
    const double aspect = GetParam();
    for (const glm::vec3 size :
         {glm::vec3(1, 1, 1), glm::vec3(20, 0.1f, 5), glm::vec3(0.01f, 0.5f, 0.01f), glm::vec3(0, 3000, 4000)}) {
        const Scene scene = boxScene({7, -2, 3}, glm::vec3(7, -2, 3) + size);
        const Pose pose = poseAt(scene, 0);
        const PlacedCamera placed = chooseCamera(scene, pose, {}, aspect);
        const glm::dmat4 cameraFromWorld = glm::inverse(placed.worldFromCamera);
        const double tanY = std::tan(placed.camera.yfov / 2);
        glm::dvec2 min(1e9), max(-1e9);
        for (const glm::dvec3& corner : pose.bounds.corners()) {
            const glm::dvec3 c(cameraFromWorld * glm::dvec4(corner, 1));
            ASSERT_GT(-c.z, placed.camera.znear);
            const glm::dvec2 ndc(c.x / (-c.z * tanY * aspect), c.y / (-c.z * tanY));
            min = glm::min(min, ndc);
            max = glm::max(max, ndc);
        }
        const double fill = std::max({-min.x, max.x, -min.y, max.y});
        EXPECT_LE(fill, 0.95);
        EXPECT_GE(fill, 0.85);
    }
}
INSTANTIATE_TEST_SUITE_P(Aspects, Framing, testing::Values(1.0, 4.0 / 3, 2.39, 0.5));

// The camera frames the box for every focal length, with the angle of view of that focal length.
TEST_P(Framing, boxFitsForTheAngleOfView) {
    const double aspect = GetParam();
    const Scene scene = boxScene({7, -2, 3}, {8, 0, 3.5});
    const Pose pose = poseAt(scene, 0);
    for (const double tanX : {18.0 / 200, 18.0 / 85, 18.0 / 24}) {
        const PlacedCamera placed = chooseCamera(scene, pose, FramingCamera{}, aspect, tanX);
        EXPECT_NEAR(std::tan(placed.camera.yfov / 2) * aspect, tanX, 1e-12);
        const glm::dmat4 cameraFromWorld = glm::inverse(placed.worldFromCamera);
        for (const glm::dvec3& corner : pose.bounds.corners()) {
            const glm::dvec3 c(cameraFromWorld * glm::dvec4(corner, 1));
            ASSERT_GT(-c.z, placed.camera.znear);
            EXPECT_LE(std::abs(c.x / (-c.z * tanX)), 0.95);
            EXPECT_LE(std::abs(c.y / (-c.z * tanX / aspect)), 0.95);
        }
    }
}

TEST(FramingCamera, copesWithNothingAndWithAPoint) {
    Scene empty;
    EXPECT_TRUE(std::isfinite(chooseCamera(empty, poseAt(empty, 0), {}, 1.5).worldFromCamera[3].z));
    const Scene point = boxScene({1, 1, 1}, {1, 1, 1});
    const PlacedCamera placed = chooseCamera(point, poseAt(point, 0), {}, 1.5);
    EXPECT_GT(placed.camera.znear, 0);
    EXPECT_TRUE(std::isfinite(placed.worldFromCamera[3].x));
}

Scene withCameras() {
    Scene scene = boxScene({0, 0, 0}, {1, 1, 1});
    scene.cameras.resize(3);
    scene.cameras[0].orthographic = "orthographic cameras are not supported";
    scene.cameras[0].name = "plan";
    scene.cameras[1].name = "shot";
    for (int i = 0; i < 3; ++i) {
        Node node;
        node.name = "node" + std::to_string(i);
        node.camera = i;
        node.translation = {i, 0, 0};
        node.scale = {-2, 3, 0.5};
        scene.nodes.push_back(node);
        scene.roots.push_back(i + 1);
    }
    return scene;
}

TEST(ChooseCamera, byCameraOrNodeNameElseTheFirstThatWorks) {
    const Scene scene = withCameras();
    const Pose pose = poseAt(scene, 0);
    EXPECT_EQ(chooseCamera(scene, pose, {}, 1).worldFromCamera[3].x, 1);
    EXPECT_EQ(chooseCamera(scene, pose, NamedCamera{"shot"}, 1).worldFromCamera[3].x, 1);
    EXPECT_EQ(chooseCamera(scene, pose, NamedCamera{"node2"}, 1).worldFromCamera[3].x, 2);
    EXPECT_EQ(chooseCamera(scene, pose, FramingCamera{}, 1).camera.name, "auto");
}

TEST(ChooseCamera, framesTheSceneIfAllCamerasAreOrthographic) {
    Scene scene = withCameras();
    for (Camera& camera : scene.cameras) camera.orthographic = "orthographic cameras are not supported";
    EXPECT_EQ(chooseCamera(scene, poseAt(scene, 0), {}, 1).camera.name, "auto");
}

TEST(ChooseCamera, matricesAreRigidWhateverTheNodesScale) {
    const Scene scene = withCameras();
    const glm::dmat4 m = chooseCamera(scene, poseAt(scene, 0), NamedCamera{"shot"}, 1).worldFromCamera;
    EXPECT_NEAR(glm::determinant(m), 1, 1e-12);
    EXPECT_NEAR(glm::dot(glm::dvec3(m[2]), glm::dvec3(0, 0, 1)), 1, 1e-12);
    EXPECT_NEAR(glm::dot(glm::dvec3(m[1]), glm::dvec3(0, 1, 0)), 1, 1e-12);
}

TEST(ChooseCamera, unknownAndOrthographicOnesSaySo) {
    const Scene scene = withCameras();
    const Pose pose = poseAt(scene, 0);
    const auto messageFor = [&](const char* name) {
        try {
            (void)chooseCamera(scene, pose, NamedCamera{name}, 1);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(messageFor("drone"),
              "there is no camera 'drone'; the scene has: plan, shot, node2, auto (frames the scene)");
    EXPECT_NE(messageFor("plan").find("orthographic cameras are not supported"), std::string::npos);
}

TEST(DefaultLights, giveWayToTheScenesOwn) {
    Scene scene = boxScene({0, 0, 0}, {1, 1, 1});
    const auto count = [&] {
        const Pose pose = poseAt(scene, 0);
        return lightsOrDefault(scene, pose, chooseCamera(scene, pose, {}, 1)).size();
    };
    EXPECT_EQ(count(), 3u);
    scene.materials.resize(1);
    scene.materials[0].unlit = true;
    scene.meshes[0].primitives[0].material = 0;
    EXPECT_EQ(count(), 0u) << "light changes nothing in an unlit scene";
    scene.materials[0] = {};
    scene.lights.resize(1);
    scene.nodes[0].light = 0;
    EXPECT_EQ(count(), 1u);
}

// Returns the irradiance / π of the default sky on a surface with the normal `normal`, by brute-force integration.
glm::dvec3 skyLight(const Environment& sky, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    double weight = 0;
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double y = -1 + (2 * i + 1.0) / steps;
            const double phi = (j + 0.5) * std::numbers::pi / steps;
            const double r = std::sqrt(1 - y * y);
            const glm::dvec3 d(r * std::cos(phi), y, r * std::sin(phi));
            const double cosine = std::max(0.0, glm::dot(d, normal));
            const glm::dvec3 end = y > 0 ? sky.zenith : sky.nadir;
            sum += cosine * glm::mix(glm::dvec3(sky.horizon), end, std::abs(y));
            weight += cosine;
        }
    return sum / weight * static_cast<double>(sky.lighting);
}

TEST(DefaultLights, greyBallLooksMidGrey) {
    const Scene scene = boxScene({-1, -1, -1}, {1, 1, 1});
    const Pose pose = poseAt(scene, 0);
    const PlacedCamera camera = chooseCamera(scene, pose, {}, 1);
    const std::vector<PlacedLight> lights = lightsOrDefault(scene, pose, camera);
    const Environment sky = environmentOrDefault(scene);
    glm::dvec3 sum(0);
    int count = 0;
    for (double x = -0.975; x < 1; x += 0.05)
        for (double y = -0.975; y < 1; y += 0.05) {
            if (x * x + y * y >= 1) continue;
            const glm::dvec3 normal(camera.worldFromCamera * glm::dvec4(x, y, std::sqrt(1 - x * x - y * y), 0));
            glm::dvec3 radiance = skyLight(sky, normal);
            for (const PlacedLight& light : lights)
                radiance += glm::dvec3(light.light.color) * static_cast<double>(light.light.intensity) *
                            std::max(0.0, -glm::dot(light.direction, normal)) / std::numbers::pi;
            sum += 0.18 * radiance;
            ++count;
        }
    const glm::dvec3 mean = sum / static_cast<double>(count);
    EXPECT_NEAR((mean.r + mean.g + mean.b) / 3, 0.18, 0.02);
    EXPECT_LT(std::abs(mean.r - mean.b), 0.02) << "neutral";
}

// A smooth metal shows only reflections of its surroundings. If the surroundings have no contrast, the metal looks like
// glass.
TEST(DefaultSky, hasContrastForMetalsToReflect) {
    const Environment sky = environmentOrDefault(Scene{});
    EXPECT_GT(sky.horizon.g, 4 * sky.zenith.g);
    EXPECT_GT(sky.horizon.g, 10 * sky.nadir.g);
}

// skyScale() balances the sky with a sun of any illuminance: the sky has a seventh of the sun's illuminance.
TEST(DefaultSky, givesASeventhOfTheSun) {
    Pose pose;
    PlacedLight sun;
    sun.light.type = LightType::directional;
    sun.light.intensity = 100'000;
    pose.lights = {sun};
    const glm::dvec3 up = skyLight(environmentOrDefault(Scene{}), {0, 1, 0});
    const double lux = std::numbers::pi * glm::dot(up, glm::dvec3(0.2126, 0.7152, 0.0722)) * skyScale(pose);
    EXPECT_NEAR(lux, 100'000 / 7.0, 100);
}

}  // namespace
}  // namespace defocus::engine
