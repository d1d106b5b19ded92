// Tests that the built-in school of fish is a fair benchmark: different fish, sharp and blurred, cover enough of the
// image. Also tests that the fish are valid input for a simplifier. The tests have their own implementation of the lens
// formulas.

#include "school/fish_school.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "core/error.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

constexpr int imageWidth = 1024;
constexpr int imageHeight = 768;

const Scene& school() {
    static const Scene scene = fishSchool();
    return scene;
}

struct View {
    glm::dmat4 cameraFromWorld{1.0};
    double tanHalfWidth = 0;
    double tanHalfHeight = 0;
};

View viewOf(const Scene& scene, const Pose& pose) {
    View view;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].camera >= 0) view.cameraFromWorld = glm::inverse(pose.worldFromNode[i]);
    }
    view.tanHalfHeight = std::tan(0.5 * scene.cameras.at(0).yfov);
    view.tanHalfWidth = view.tanHalfHeight * imageWidth / imageHeight;
    return view;
}

// Returns the vertices of the object's mesh in view space: x right, y up, z the depth.
std::vector<glm::dvec3> inView(const Scene& scene, const Object& object, const View& view) {
    const glm::dmat4 matrix = view.cameraFromWorld * object.worldFromObject;
    std::vector<glm::dvec3> points;
    for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(object.mesh)].vertices.positions) {
        const glm::dvec4 q = matrix * glm::dvec4(glm::dvec3(p), 1.0);
        points.emplace_back(q.x, q.y, -q.z);
    }
    return points;
}

// Marks the pixels whose centres the triangle covers.
void rasterise(const std::array<glm::dvec2, 3>& p, std::vector<bool>& covered) {
    const auto edge = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const int left = std::max(0, static_cast<int>(std::floor(std::min({p[0].x, p[1].x, p[2].x}))));
    const int right = std::min(imageWidth - 1, static_cast<int>(std::max({p[0].x, p[1].x, p[2].x})));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({p[0].y, p[1].y, p[2].y}))));
    const int bottom = std::min(imageHeight - 1, static_cast<int>(std::max({p[0].y, p[1].y, p[2].y})));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const glm::dvec2 c(x + 0.5, y + 0.5);
            const double a = edge(p[0], p[1], c);
            const double b = edge(p[1], p[2], c);
            const double d = edge(p[2], p[0], c);
            if ((a >= 0 && b >= 0 && d >= 0) || (a <= 0 && b <= 0 && d <= 0)) {
                covered[static_cast<std::size_t>(y) * imageWidth + static_cast<std::size_t>(x)] = true;
            }
        }
    }
}

// Returns the blur diameter c = A·|1/s − 1/z|·W / (2 tan(θx/2)) in px, with focus distance s and depth z in m, and W
// the width of the image in px. The aperture diameter is A = f / (1000·fStop), with the focal length f =
// horizontalAperture / (2 tan(θx/2)).
double blur(const Camera& camera, const View& view, double depth) {
    const double focalLength = *camera.lensValue("horizontalAperture") / (2.0 * view.tanHalfWidth);
    const double aperture = focalLength / (1000.0 * *camera.lensValue("fStop"));
    return aperture * std::abs(1.0 / *camera.lensValue("focusDistance") - 1.0 / depth) * imageWidth /
           (2.0 * view.tanHalfWidth);
}

// Expects a closed, consistently oriented surface without non-manifold edges: every directed edge occurs once, and its
// reverse once.
void expectClosed(const Mesh& mesh) {
    std::vector<std::uint64_t> edges;
    std::vector<std::uint64_t> opposites;
    for (const Primitive& primitive : mesh.primitives) {
        const auto& index = primitive.indices;
        ASSERT_EQ(index.size() % 3, 0u);
        for (std::size_t i = 0; i < index.size(); ++i) {
            ASSERT_LT(index[i], mesh.vertices.count());
            const std::uint64_t next = index[i % 3 == 2 ? i - 2 : i + 1];
            edges.push_back((std::uint64_t{index[i]} << 32u) | next);
            opposites.push_back((next << 32u) | index[i]);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::sort(opposites.begin(), opposites.end());
    EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end()) << mesh.name << ": an edge occurs twice";
    EXPECT_TRUE(edges == opposites) << mesh.name << ": an open edge";
}

double signedVolume(const Mesh& mesh, const Primitive& primitive) {
    double sum = 0;
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.vertices.positions[primitive.indices[i]]);
        const glm::dvec3 b(mesh.vertices.positions[primitive.indices[i + 1]]);
        const glm::dvec3 c(mesh.vertices.positions[primitive.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

struct Shape {
    std::size_t slivers = 0;  // number of triangles whose smallest angle is below 12°
    std::size_t degenerate = 0;
    std::size_t againstNormals = 0;
    std::vector<double> edges;
};

Shape triangleShapes(const Mesh& mesh) {
    Shape shape;
    for (const Primitive& primitive : mesh.primitives) {
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
            const std::array<std::uint32_t, 3> v{primitive.indices[i], primitive.indices[i + 1],
                                                 primitive.indices[i + 2]};
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices.positions[v[k]];
            const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area2 = glm::length(normal);
            std::array<double, 3> lengths;
            for (std::size_t k = 0; k < 3; ++k) lengths[k] = glm::distance(p[k], p[(k + 1) % 3]);
            std::sort(lengths.begin(), lengths.end());
            const double sine = area2 / (lengths[1] * lengths[2]);  // sine of the triangle's smallest angle
            if (!(area2 > 0)) ++shape.degenerate;
            if (!(sine > std::sin(0.2094))) ++shape.slivers;
            glm::dvec3 mean(0);
            for (std::size_t k = 0; k < 3; ++k) mean += glm::dvec3(mesh.vertices.normals[v[k]]);
            if (glm::dot(mean, normal) <= 0) ++shape.againstNormals;
            shape.edges.insert(shape.edges.end(), lengths.begin(), lengths.end());
        }
    }
    return shape;
}

TEST(FishSchool, twentyDifferentFishOfNinetyThousandTriangles) {
    ASSERT_EQ(school().meshes.size(), 20u);
    std::size_t total = 0;
    for (const Mesh& mesh : school().meshes) {
        EXPECT_NEAR(static_cast<double>(mesh.triangleCount()), 90'000.0, 1'800.0) << mesh.name;
        EXPECT_EQ(mesh.primitives.size(), 2u);
        total += mesh.triangleCount();
    }
    EXPECT_NEAR(static_cast<double>(total), 1.8e6, 1.8e4);
    for (std::size_t a = 0; a < 20; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_NE(school().meshes[a].vertices.positions, school().meshes[b].vertices.positions)
                << a << " and " << b;
        }
    }
    const Pose pose = poseAt(school(), 0, -1);
    ASSERT_EQ(pose.objects.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(pose.objects[i].name, "Fish " + std::to_string(i + 1));
}

TEST(FishSchool, surfacesAreClosedAndFaceOutwards) {
    for (const Mesh& mesh : school().meshes) {
        expectClosed(mesh);
        for (const Primitive& primitive : mesh.primitives) EXPECT_GT(signedVolume(mesh, primitive), 0.0) << mesh.name;
    }
}

TEST(FishSchool, trianglesAreEvenAndAgreeWithTheirNormals) {
    for (const Mesh& mesh : school().meshes) {
        ASSERT_EQ(mesh.vertices.normals.size(), mesh.vertices.count());
        ASSERT_EQ(mesh.vertices.colors.size(), mesh.vertices.count());
        for (const glm::vec3& normal : mesh.vertices.normals)
            ASSERT_NEAR(glm::length(normal), 1.0f, 1e-3f) << mesh.name;
        Shape shape = triangleShapes(mesh);
        const auto count = static_cast<double>(mesh.triangleCount());
        EXPECT_EQ(shape.degenerate, 0u) << mesh.name;
        EXPECT_LT(static_cast<double>(shape.slivers) / count, 0.02) << mesh.name;
        EXPECT_LT(static_cast<double>(shape.againstNormals) / count, 0.002) << mesh.name;
        // The lengths of 95 % of the edges lie within a factor of two of the median.
        std::sort(shape.edges.begin(), shape.edges.end());
        const auto at = [&](double share) {
            return shape.edges[static_cast<std::size_t>(share * (shape.edges.size() - 1.0))];
        };
        EXPECT_GT(at(0.025), 0.5 * at(0.5)) << mesh.name;
        EXPECT_LT(at(0.975), 2.0 * at(0.5)) << mesh.name;
    }
}

TEST(FishSchool, coversAtLeastThreeTenthsOfTheImage) {
    const Pose pose = poseAt(school(), 0, -1);
    const View view = viewOf(school(), pose);
    std::vector<bool> covered(static_cast<std::size_t>(imageWidth) * imageHeight);
    for (const Object& object : pose.objects) {
        std::vector<glm::dvec2> pixels;
        for (const glm::dvec3& p : inView(school(), object, view)) {
            ASSERT_GT(p.z, 0.5) << object.name;
            pixels.emplace_back((0.5 + 0.5 * p.x / (p.z * view.tanHalfWidth)) * imageWidth,
                                (0.5 - 0.5 * p.y / (p.z * view.tanHalfHeight)) * imageHeight);
        }
        for (const Primitive& primitive : school().meshes[static_cast<std::size_t>(object.mesh)].primitives) {
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                rasterise(
                    {pixels[primitive.indices[i]], pixels[primitive.indices[i + 1]], pixels[primitive.indices[i + 2]]},
                    covered);
            }
        }
    }
    const auto count = std::count(covered.begin(), covered.end(), true);
    RecordProperty("coveredPercent", static_cast<int>(100 * count / (imageWidth * imageHeight)));
    EXPECT_GT(static_cast<double>(count), 0.30 * imageWidth * imageHeight);
    EXPECT_LT(static_cast<double>(count), 0.60 * imageWidth * imageHeight) << "the water must remain visible";
}

TEST(FishSchool, someFishAreSharpAndNoneTooBlurred) {
    const Pose pose = poseAt(school(), 0, -1);
    const View view = viewOf(school(), pose);
    const Camera& camera = school().cameras.at(0);
    ASSERT_TRUE(camera.lensValue("fStop") && camera.lensValue("focusDistance") &&
                camera.lensValue("horizontalAperture"));
    std::vector<double> centres;
    double largest = 0;
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (const Object& object : pose.objects) {
        double near = std::numeric_limits<double>::infinity();
        double far = 0;
        for (const glm::dvec3& p : inView(school(), object, view)) {
            near = std::min(near, p.z);
            far = std::max(far, p.z);
        }
        const glm::dvec4 centre = view.cameraFromWorld * glm::dvec4(nodeCentre(school(), pose, object.node), 1.0);
        centres.push_back(blur(camera, view, -centre.z));
        largest = std::max({largest, blur(camera, view, near), blur(camera, view, far)});
        nearest = std::min(nearest, near);
        farthest = std::max(farthest, far);
    }
    std::sort(centres.begin(), centres.end());
    EXPECT_LT(centres[3], 2.0) << "fewer than four fish in focus";
    EXPECT_LE(0.5 * (centres[9] + centres[10]), 20.0);
    EXPECT_GE(0.5 * (centres[9] + centres[10]), 5.0) << "too little blur";
    EXPECT_LE(largest, 40.0);
    EXPECT_GE(largest, 20.0);
    EXPECT_LT(nearest, 1.3);
    EXPECT_GT(farthest, 6.0);
}

TEST(FishSchool, noTwoFishTouch) {
    const Pose pose = poseAt(school(), 0, -1);
    std::vector<std::vector<glm::dvec3>> points;
    std::vector<Bounds> bounds;
    for (const Object& object : pose.objects) {
        const auto& positions = school().meshes[static_cast<std::size_t>(object.mesh)].vertices.positions;
        points.emplace_back();
        bounds.emplace_back();
        for (std::size_t i = 0; i < positions.size(); i += 20) {
            const glm::dvec3 world(object.worldFromObject * glm::dvec4(glm::dvec3(positions[i]), 1.0));
            points.back().push_back(world);
            bounds.back().extend(world);
        }
    }
    for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            const glm::dvec3 gap =
                glm::max(bounds[a].minimum - bounds[b].maximum, bounds[b].minimum - bounds[a].maximum);
            if (std::max({gap.x, gap.y, gap.z}) > 0.02) continue;
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::dvec3& p : points[a]) {
                for (const glm::dvec3& q : points[b]) nearest = std::min(nearest, glm::dot(p - q, p - q));
            }
            EXPECT_GT(std::sqrt(nearest), 0.02) << "fish " << a + 1 << " and " << b + 1;
        }
    }
}

TEST(FishSchool, equalOptionsGiveEqualFish) {
    const FishSchoolOptions options{.fishCount = 23, .trianglesPerFish = 900, .seed = 7};
    const Scene a = fishSchool(options);
    const Scene b = fishSchool(options);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].vertices.positions, b.meshes[i].vertices.positions);
        EXPECT_EQ(a.meshes[i].vertices.colors, b.meshes[i].vertices.colors);
        EXPECT_EQ(a.meshes[i].primitives[0].indices, b.meshes[i].primitives[0].indices);
        EXPECT_EQ(a.nodes[i].translation, b.nodes[i].translation);
    }
    const Scene c = fishSchool({.fishCount = 23, .trianglesPerFish = 900, .seed = 8});
    EXPECT_NE(a.meshes[0].vertices.positions, c.meshes[0].vertices.positions);
    EXPECT_EQ(a.nodes[19].translation, c.nodes[19].translation) << "the composition doesn't depend on the seed";
    EXPECT_NE(a.nodes[22].translation, c.nodes[22].translation);
}

TEST(FishSchool, moreFishKeepTheComposition) {
    const Scene few = fishSchool({.fishCount = 3, .trianglesPerFish = 300});
    const Scene many = fishSchool({.fishCount = 60, .trianglesPerFish = 300});
    ASSERT_EQ(few.meshes.size(), 3u);
    ASSERT_EQ(many.meshes.size(), 60u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(few.nodes[i].translation, many.nodes[i].translation);
        EXPECT_EQ(few.meshes[i].vertices.positions, many.meshes[i].vertices.positions);
    }
    for (std::size_t a = 20; a < 60; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_GT(glm::distance(many.nodes[a].translation, many.nodes[b].translation), 0.7);
        }
    }
}

TEST(FishSchool, anyTriangleCountGivesClosedFish) {
    for (const int triangles : {200, 350, 1'000, 8'000, 120'000}) {
        const Scene scene = fishSchool({.fishCount = 9, .trianglesPerFish = triangles});
        for (const Mesh& mesh : scene.meshes) {
            expectClosed(mesh);
            const double tolerance = triangles < 500 ? 0.6 : triangles < 5'000 ? 0.15 : 0.03;
            EXPECT_NEAR(static_cast<double>(mesh.triangleCount()), triangles, tolerance * triangles) << mesh.name;
        }
    }
}

TEST(FishSchool, optionsOutOfRangeAreErrors) {
    for (const int count : {0, -1, 10'001}) EXPECT_THROW(fishSchool({.fishCount = count}), Error) << count;
    for (const int triangles : {0, 199, 10'000'001, -5}) {
        EXPECT_THROW(fishSchool({.fishCount = 1, .trianglesPerFish = triangles}), Error) << triangles;
    }
    EXPECT_THROW(fishSchool({.fishCount = 10'000, .trianglesPerFish = 10'000'000}), Error);
}

}  // namespace
}  // namespace defocus::engine
