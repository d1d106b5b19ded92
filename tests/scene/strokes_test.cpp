// Tests that points and lines become quads that are one pixel wide when they are projected to the image.

#include "scene/strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

constexpr int pointsMode = 0, linesMode = 1, loopMode = 2, stripMode = 3;

// Positions of four points at different depths, off the view's axis.
const std::vector<float> places = {0.5f, 0.4f, 0, 1.5f, -0.3f, -2, -1, -1, 1, -1.2f, 0.8f, -0.5f};

StrokeView viewFromSide() {
    StrokeView view;
    view.worldFromCamera = glm::inverse(glm::lookAt(glm::dvec3(1, 0.5, 4), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0)));
    view.pixelTangent = 0.01;
    view.nearPlane = 0.1;
    return view;
}

Scene drawn(const Scene& scene, const StrokeView& view) {
    return withStrokes(scene, poseAt(scene, 0), view);
}

// Returns the image position, in pixels from the centre, of a vertex of the pose's first object.
glm::dvec2 pixelOf(const Scene& scene, const StrokeView& view, std::uint32_t vertex) {
    const Object object = poseAt(scene, 0).objects.at(0);
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
    const glm::dvec4 world = object.worldFromObject * glm::dvec4(mesh.vertices.positions[vertex], 1);
    const glm::dvec3 seen(glm::inverse(view.worldFromCamera) * world);
    return glm::dvec2(seen) / (-seen.z * view.pixelTangent);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

GltfBuilder strokesOf(int mode, const nlohmann::json& node = nlohmann::json::object()) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(places)}}}, {"mode", mode}}}, node);
    return builder;
}

TEST(Strokes, areReadFromEachMode) {
    const auto indicesOf = [](int mode) { return strokesOf(mode).load().meshes.at(0).strokes.at(0).indices; };
    EXPECT_EQ(indicesOf(pointsMode), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(indicesOf(linesMode), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(indicesOf(stripMode), (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3}));
    EXPECT_EQ(indicesOf(loopMode), (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 3, 0}));
}

TEST(Strokes, linesAreOnePixelWideAndFaceTheCamera) {
    const StrokeView view = viewFromSide();
    const Scene scene =
        drawn(strokesOf(stripMode, {{"scale", {2, 0.5, 1}}, {"rotation", {0, 0.6, 0, 0.8}}}).load(), view);
    ASSERT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 18u);
    for (std::uint32_t segment = 0; segment < 3; ++segment) {
        std::array<glm::dvec2, 4> quad;
        for (std::uint32_t c = 0; c < 4; ++c) quad[c] = pixelOf(scene, view, 4 * segment + c);
        const glm::dvec2 along = glm::normalize(quad[1] + quad[2] - quad[0] - quad[3]);
        for (const glm::dvec2& across : {quad[3] - quad[0], quad[2] - quad[1]}) {
            EXPECT_NEAR(glm::length(across), 1, 1e-4);
            EXPECT_NEAR(cross(along, across), 1, 1e-4) << "counter-clockwise";
        }
    }
}

TEST(Strokes, pointsAreSquarePixels) {
    const StrokeView view = viewFromSide();
    const Scene scene = drawn(strokesOf(pointsMode).load(), view);
    ASSERT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 24u);
    for (std::uint32_t point = 0; point < 4; ++point) {
        EXPECT_LT(glm::length(pixelOf(scene, view, 4 * point + 1) - pixelOf(scene, view, 4 * point) - glm::dvec2(1, 0)),
                  1e-4);
        EXPECT_LT(glm::length(pixelOf(scene, view, 4 * point + 3) - pixelOf(scene, view, 4 * point) - glm::dvec2(0, 1)),
                  1e-4);
    }
}

TEST(Strokes, areUnlitWithoutNormals) {
    GltfBuilder builder = strokesOf(linesMode);
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0, 1}}}}, {"emissiveFactor", {0, 0.5, 1}}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene unlit = drawn(builder.load(), viewFromSide());
    const Material& material = unlit.materials.at(static_cast<std::size_t>(unlit.meshes[0].primitives[0].material));
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material.baseColorFactor, glm::vec4(0.5f, 0.75f, 1, 1));
    EXPECT_FALSE(unlit.materials.at(0).unlit);

    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        builder.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const Scene lit = drawn(builder.load(), viewFromSide());
    EXPECT_FALSE(lit.materials.at(static_cast<std::size_t>(lit.meshes[0].primitives[0].material)).unlit);
}

// Each node is at a different distance, so its lines need a different width in object space.
TEST(Strokes, eachNodeHasItsOwnMesh) {
    GltfBuilder builder = strokesOf(linesMode);
    builder.add("nodes", {{"mesh", 0}, {"translation", {0, 0, -10}}});
    const Scene loaded = builder.load();
    EXPECT_TRUE(hasStrokes(loaded));
    EXPECT_NEAR(poseAt(loaded, 0).bounds.size().x, 2.7, 1e-6) << "bounds include lines that are not yet drawn";
    const Scene scene = drawn(loaded, viewFromSide());
    EXPECT_FALSE(hasStrokes(scene));
    ASSERT_EQ(scene.meshes.size(), 2u);
    const auto width = [&](std::size_t node) {
        const std::vector<glm::vec3>& p =
            scene.meshes[static_cast<std::size_t>(scene.nodes[node].mesh)].vertices.positions;
        return glm::distance(p[3], p[0]);
    };
    EXPECT_GT(width(1), 3 * width(0));
}

TEST(Strokes, damagedPositionsAndIndicesAreFound) {
    GltfBuilder builder;
    std::vector<float> damaged = places;
    damaged[4] = std::numeric_limits<float>::infinity();
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(damaged)}}}, {"mode", linesMode}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.meshes.at(0).strokes.at(0).indices, (std::vector<std::uint32_t>{2, 3}));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what, "lines");
    EXPECT_TRUE(scene.ignored[0].damage);

    builder = strokesOf(pointsMode);
    builder.json["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 4});
    EXPECT_THROW(builder.load(), Error);
}

}  // namespace
}  // namespace defocus::engine
