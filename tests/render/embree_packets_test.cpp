// Tests ray packets of the ray tracer against its single rays in double precision, and against closed forms (no GPU).

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "bokeh.h"
#include "embree/embree_renderer.h"
#include "embree/packet_rays.h"
#include "embree/packet_samples.h"
#include "render/renderer.h"

namespace defocus::engine {
namespace {

Image tracedImage(const Scene& scene, const View& view, std::uint32_t samples) {
    const World world = flatWorld(scene, blackBackground());
    FramePlan plan;
    plan.view = view;
    plan.settings.sampleCount = samples;
    return imageOf(*makeEmbreeRenderer(world), plan);
}

TEST(EmbreePacketSamples, areThePointsOfTheirStreams) {
    constexpr std::uint32_t seed = 7;
    for (const SamplePair pair : {SamplePair::lens, SamplePair::pixel}) {
        for (const std::uint32_t firstStream : {0u, 16u, 16u * 12345}) {
            const ReversedLanes seeds = packetSeeds(firstStream, pair, seed);
            for (const std::uint32_t index : {0u, 1u, 63u, 1000u}) {
                FloatLanes x;
                FloatLanes y;
                scramblePoints(unscrambledPoints(index, pair, seed), seeds, x, y);
                for (int i = 0; i < packetSize; ++i) {
                    const glm::dvec2 one =
                        scrambledPoint(index, firstStream + static_cast<std::uint32_t>(i), pair, seed);
                    EXPECT_NEAR(static_cast<double>(x[i]), one.x, 0x1p-24);
                    EXPECT_NEAR(static_cast<double>(y[i]), one.y, 0x1p-24);
                    EXPECT_LT(std::max(x[i], y[i]), 1);
                }
            }
        }
    }
}

TEST(EmbreePacketSamples, apertureIsThatOfSinglePoints) {
    for (const int blades : {0, 3, 6, 64}) {
        for (const double ratio : {0.5, 1.0, 2.0}) {
            const Lens lens{.bladeCount = blades, .bladeRotation = 0.4, .anamorphicRatio = ratio};
            const ApertureMap map(lens);
            for (int step = 0; step <= 64; ++step) {
                FloatLanes x;
                FloatLanes y;
                const float largest = 1 - 0x1p-24f;
                for (int i = 0; i < packetSize; ++i) {
                    x[i] = std::min(static_cast<float>(i) / (packetSize - 1), largest);
                    y[i] = std::min(static_cast<float>(step) / 64, largest);
                }
                const FloatLanes r = x;
                const FloatLanes s = y;
                mapToAperture(map, x, y);
                for (int i = 0; i < packetSize; ++i) {
                    const glm::dvec2 one = aperturePoint(lens, {r[i], s[i]});
                    EXPECT_NEAR(static_cast<double>(x[i]), one.x, 1e-6)
                        << blades << " blades, " << r[i] << ", " << s[i];
                    EXPECT_NEAR(static_cast<double>(y[i]), one.y, 1e-6)
                        << blades << " blades, " << r[i] << ", " << s[i];
                }
            }
        }
    }
}

TEST(EmbreePacketRays, areTheRaysOfTheirPixels) {
    for (const double focus : {1.5, std::numeric_limits<double>::infinity()}) {
        View view = bokehView(200, 120);
        view.lens.focusDistance = focus;
        const LensCamera camera = lensCamera(view);
        const TileRays tile = tileRays(camera, view, 32, 16, {0, 0}, {0, 0});
        PacketPoints points;
        for (int i = 0; i < packetSize; ++i) {
            points.pixelX[i] = static_cast<float>(i) / packetSize;
            points.pixelY[i] = 1 - points.pixelX[i];
            points.lensX[i] = 0.6f - 0.05f * static_cast<float>(i);
            points.lensY[i] = 0.03f * static_cast<float>(i);
        }
        for (int place = 0; place < packetsPerTile; ++place) {
            RTCRayHit16 packet{};
            makeRays(tile, place, camera, view, points, packet);
            for (int i = 0; i < packetSize; ++i) {
                const double x = 32 + 4 * (place % 4) + i % 4 + static_cast<double>(points.pixelX[i]);
                const double y = 16 + 4 * (place / 4) + i / 4 + static_cast<double>(points.pixelY[i]);
                const LensRay one =
                    lensRay(camera, {2 * x / 200 - 1, 1 - 2 * y / 120}, {points.lensX[i], points.lensY[i]});
                EXPECT_NEAR(packet.ray.org_x[i], one.origin.x, 1e-8);
                EXPECT_NEAR(packet.ray.org_y[i], one.origin.y, 1e-8);
                EXPECT_EQ(packet.ray.org_z[i], 0);
                EXPECT_NEAR(packet.ray.dir_x[i], one.direction.x, 1e-7);
                EXPECT_NEAR(packet.ray.dir_y[i], one.direction.y, 1e-7);
                EXPECT_EQ(packet.ray.dir_z[i], -1);
            }
        }
    }
}

TEST(EmbreePacketTiles, imagesThatCutPacketsAreWhole) {
    for (const auto& [width, height] : {std::pair(13, 7), std::pair(1, 1), std::pair(34, 18)}) {
        const View view = bokehView(width, height);
        const Scene scene = rectangleScene(view, {{-50, -50, 150, 150, 3}}, glm::vec3(0.25f, 0.5f, 2));
        const Image image = tracedImage(scene, view, 17);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) EXPECT_EQ(image.at(x, y)[2], 2) << x << ", " << y;
    }
}

// A ray that meets the back of a single-sided surface continues to the surface behind it.
TEST(EmbreePacketCulling, raysGoOnBehindBacks) {
    View view = bokehView(32, 32);
    view.lens.dofEnabled = false;
    Scene scene = rectangleScene(view, {{0, 0, 20, 32, 2}, {8, 0, 32, 32, 3}}, glm::vec3(1));
    std::vector<std::uint32_t>& indices = scene.meshes[0].primitives[0].indices;
    ASSERT_EQ(indices.size(), 6u);
    std::swap(indices[1], indices[2]);  // reverses the winding of the nearer rectangle's triangles
    std::swap(indices[4], indices[5]);
    const Image image = tracedImage(scene, view, 4);
    for (int x = 0; x < 32; ++x) EXPECT_EQ(*image.at(x, 16), x < 8 ? 0 : 1) << x;
}

}  // namespace
}  // namespace defocus::engine
