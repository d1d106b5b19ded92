// Tests culling of clusters (groups of triangles) against brute force over lens points and times. In Appendix A of
// Munkberg, Toth and Akenine-Möller 2012, Eq. 6 treats the thin lens, and Eq. 5 any circle of confusion C. Signs are
// inverted (see plan/visible/visibility.h).

#include "plan/visible/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

#include "small_world.h"

namespace defocus::engine {
namespace {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double operator()(double min, double max) { return std::uniform_real_distribution<double>(min, max)(engine_); }
    glm::dvec3 inBall() {
        for (;;) {
            const glm::dvec3 p((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (glm::length(p) < 1) return p;
        }
    }
    glm::dmat4 rotation() {
        return glm::mat4_cast(glm::angleAxis((*this)(0, 2 * std::numbers::pi), glm::normalize(inBall())));
    }

private:
    std::mt19937 engine_;
};

RenderSettings settingsFor(std::uint32_t samples) {
    return {.sampleCount = samples, .lod = LodMode::off};
}

// Returns objects of one triangle each, within balls of radius `size` m at random positions. Most are in front of the
// camera, a few beside or behind it. Every third transform is a reflection, and every fourth has a non-uniform scale.
std::unique_ptr<SmallWorld> looseTriangles(Random& random, int count, double size) {
    auto small = std::make_unique<SmallWorld>();
    small->view.width = 400;
    small->view.height = 300;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2.5;
    for (int i = 0; i < count; ++i) {
        Mesh mesh;
        for (int k = 0; k < 3; ++k) mesh.vertices.positions.emplace_back(random.inBall());
        mesh.vertices.normals.assign(3, {0, 0, 1});
        mesh.primitives.push_back({-1, {0, 1, 2}});
        small->scene.meshes.push_back(mesh);
        const double depth = std::pow(10.0, random(-0.8, 1.2));
        const glm::dvec3 centre(random(-0.5, 0.5) * depth, random(-0.4, 0.4) * depth, -depth);
        glm::dmat4 matrix = glm::translate(glm::dmat4(1), centre) * random.rotation();
        matrix = glm::scale(matrix, glm::dvec3(size, size, i % 3 == 0 ? -size : size));
        if (i % 4 == 0) matrix = glm::scale(matrix, glm::dvec3(random(0.3, 2), random(0.3, 2), random(0.3, 2)));
        place(*small, i, matrix);
    }
    finish(*small);
    return small;
}

// A triangle at one time of the exposure: clip positions (x, y, w) and circles of confusion of its corners.
struct ClipTriangle {
    glm::dvec3 p[3];
    double c[3] = {};
};

ClipTriangle clipTriangle(const FramePlan& plan, const World& world, const ObjectPlan& object, std::uint32_t first,
                          double time) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    ClipTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec4 vertex(glm::dvec3(pyramid.levels[0].positions[pyramid.indices[first + k]]), 1);
        glm::dvec3 p(object.viewFromObject * vertex);
        if (!object.motion.empty())
            p = glm::mix(glm::dvec3(object.motion.front().viewFromJoint.front() * vertex),
                         glm::dvec3(object.motion.back().viewFromJoint.front() * vertex), time);
        const double w = -p.z;
        triangle.p[k] = {p.x / plan.tanHalfHorizontal, p.y * plan.coc.aspect / plan.tanHalfHorizontal, w};
        const glm::dvec2 ndc = glm::dvec2(triangle.p[k]) / w;
        triangle.c[k] = w * circleOfConfusion(plan.coc, w, 1, ndc, object.cocScale);
    }
    return triangle;
}

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(a, glm::cross(b, c));
}

// Returns the max of the triangle's determinant over the lens (Munkberg et al. 2012, Eq. 5). If it is at most 0, the
// triangle faces away from the entire lens.
double largestDeterminant(const ClipTriangle& t, double aspect, double sign) {
    glm::dvec3 n(0);
    for (std::size_t i = 0; i < 3; ++i) n += t.c[i] * glm::cross(t.p[(i + 1) % 3], t.p[(i + 2) % 3]);
    return sign * determinant(t.p[0], t.p[1], t.p[2]) + std::hypot(n.x, aspect * n.y);
}

// Returns the determinant of the triangle after its corners are sheared for the lens point (u, v).
double shearedDeterminant(const ClipTriangle& t, double aspect, double u, double v, double sign) {
    glm::dvec3 q[3];
    for (std::size_t i = 0; i < 3; ++i) q[i] = t.p[i] + t.c[i] * glm::dvec3(u, aspect * v, 0);
    return sign * determinant(q[0], q[1], q[2]);
}

// Returns whether all three corners, seen from lens point (u, v), lie beyond the same frustum plane by at least half a
// pixel.
bool outside(const ClipTriangle& t, const View& view, double aspect, double u, double v) {
    bool beyond[5] = {true, true, true, true, true};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 q = t.p[i] + t.c[i] * glm::dvec3(u, aspect * v, 0);
        const double marginX = q.z / view.width;
        const double marginY = q.z / view.height;
        beyond[0] &= q.x < -q.z - marginX;
        beyond[1] &= q.x > q.z + marginX;
        beyond[2] &= q.y < -q.z - marginY;
        beyond[3] &= q.y > q.z + marginY;
        beyond[4] &= q.z < view.nearPlane;
    }
    return std::any_of(std::begin(beyond), std::end(beyond), [](bool value) { return value; });
}

struct Counts {
    int away = 0;         // triangles culled as facing away
    int outside = 0;      // triangles culled as outside the frustum
    int couldBeAway = 0;  // triangles inside the image that face away over the entire lens and exposure
};

constexpr int lensPoints = 16;  // number of lens points on the rim; the lens centre is also tested

// Fails if a culled triangle shows its front inside the image at some lens point and time.
Counts checkTriangles(const SmallWorld& small, const FramePlan& plan) {
    Counts counts;
    for (const ObjectPlan& object : plan.objects) {
        const VisibleLevel* visible = visibleLevel(object, 0);
        const double sign = object.mirrored ? -1 : 1;
        const bool moves = !object.motion.empty();
        bool away = true;
        bool unseen = true;
        for (int step = 0; step <= (moves ? 24 : 0); ++step) {
            const ClipTriangle t = clipTriangle(plan, small.world, object, 0, step / 24.0);
            const double scale = glm::length(t.p[0]) * glm::length(t.p[1]) * glm::length(t.p[2]);
            away &= largestDeterminant(t, plan.coc.aspect, sign) <= 1e-12 * scale;
            for (int i = 0; i <= lensPoints; ++i) {
                const double angle = 2 * std::numbers::pi * i / lensPoints;
                const double u = i == lensPoints ? 0 : std::cos(angle);
                const double v = i == lensPoints ? 0 : std::sin(angle);
                const bool back = shearedDeterminant(t, plan.coc.aspect, u, v, sign) <= 1e-12 * scale;
                if (visible != nullptr && visible->facingAway > 0) {
                    EXPECT_TRUE(back) << object.name << " at lens point " << i << ", time step " << step;
                }
                const bool out = outside(t, plan.view, plan.coc.aspect, u, v);
                if (visible != nullptr && visible->outside > 0) {
                    EXPECT_TRUE(out) << object.name;
                }
                unseen &= out;
            }
        }
        if (visible != nullptr && visible->facingAway > 0) {
            EXPECT_TRUE(away) << object.name << ": Eq. 5";
        }
        counts.away += visible != nullptr && visible->facingAway > 0 ? 1 : 0;
        counts.outside += visible != nullptr && visible->outside > 0 ? 1 : 0;
        counts.couldBeAway += away && !unseen && object.nearestDepth > plan.view.nearPlane ? 1 : 0;
    }
    return counts;
}

TEST(Visibility, randomTrianglesThroughAThinLens) {
    Random random(1);
    // Triangle sizes in m, and the min fraction of the triangles facing away that culling must detect. Culling detects
    // fewer large triangles, because more of them are clipped.
    const std::pair<double, double> sizesAndShares[] = {{0.02, 0.9}, {0.1, 0.7}, {0.4, 0.5}};
    for (const auto& [size, share] : sizesAndShares) {
        const auto small = looseTriangles(random, 3000, size);
        const Counts counts = checkTriangles(*small, planFrame(small->world, small->view, settingsFor(64)));
        EXPECT_GT(counts.couldBeAway, 400);
        EXPECT_GT(counts.away, share * counts.couldBeAway) << "size " << size;
    }
}

// A triangle faces away from the entire lens if its determinant, maximized over the lens, is at most 0. For a thin
// lens, this max equals the one for an eye that moves over a disk with the lens's radius in metres (Munkberg et al.
// 2012, Eq. 6).
TEST(Visibility, thinLensMovesTheEyeOverADisk) {
    Random random(2);
    const auto small = looseTriangles(random, 500, 0.3);
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    for (const ObjectPlan& object : plan.objects) {
        const ClipTriangle t = clipTriangle(plan, small->world, object, 0, 0);
        const glm::dvec3 n = glm::cross(t.p[0], t.p[1]) + glm::cross(t.p[1], t.p[2]) + glm::cross(t.p[2], t.p[0]);
        const double det = determinant(t.p[0], t.p[1], t.p[2]);
        const double eq6 = det + std::abs(plan.coc.a) * std::hypot(n.x, plan.coc.aspect * n.y);
        EXPECT_NEAR(largestDeterminant(t, plan.coc.aspect, 1), eq6, 1e-9 * (std::abs(eq6) + std::abs(det)));
    }
}

// No visible triangle is culled if lens controls, one or several at once, make the circle of confusion a nonlinear
// function of depth.
TEST(Visibility, randomTrianglesUnderControlsOfTheBlur) {
    Random random(3);
    int away = 0;
    int could = 0;
    for (int variant = 0; variant < 10; ++variant) {
        const auto small = looseTriangles(random, 1200, variant % 2 == 0 ? 0.05 : 0.2);
        Lens& lens = small->view.lens;
        if (variant == 0 || variant > 6) lens.foregroundLimit = random(0, 12);
        if (variant == 1 || variant > 6) lens.backgroundLimit = random(0, 12);
        if (variant == 2 || variant > 7) lens.focusRangeFront = random(0, 1);
        if (variant == 2 || variant > 7) lens.focusRangeBehind = random(0, 2);
        if (variant == 3 || variant > 8) lens.focusTilt = random(-0.6, 0.6);
        if (variant == 4 || variant > 8) lens.focusSwing = random(-0.6, 0.6);
        if (variant == 5) lens.fieldCurvature = 0.4;
        if (variant == 6) lens.axialChromaticAberration = 0.2;
        for (std::size_t i = 0; i < small->world.pose.objects.size(); i += 3)
            small->world.pose.objects[i].cocScale = random(0, 1.5);
        SCOPED_TRACE(variant);
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
        const Counts counts = checkTriangles(*small, plan);
        if (variant == 5) continue;  // with a curved focus surface, clusters are culled only outside the frustum
        away += counts.away;
        could += counts.couldBeAway;
    }
    EXPECT_GT(away, 0.5 * could) << "some boxes of clusters contain a kink of C";
}

TEST(Visibility, randomTrianglesThatMoveDuringTheExposure) {
    Random random(4);
    for (const double speed : {0.02, 0.3, 1.0}) {
        const auto small = looseTriangles(random, 2000, 0.1);
        small->world.shutter.poses.assign(2, small->world.pose);
        for (std::size_t i = 0; i < small->world.pose.objects.size(); ++i)
            for (int end = 0; end < 2; ++end) {
                glm::dmat4& matrix =
                    small->world.shutter.poses[static_cast<std::size_t>(end)].objects[i].worldFromObject;
                const double sign = end == 0 ? -0.5 : 0.5;
                matrix = glm::translate(glm::dmat4(1), sign * speed * glm::dvec3(random(0, 1), 0.3, 0.2)) * matrix *
                         glm::rotate(glm::dmat4(1), sign * speed * random(0, 1), glm::dvec3(0, 1, 0));
            }
        const Counts counts = checkTriangles(*small, planFrame(small->world, small->view, settingsFor(64)));
        EXPECT_GT(counts.couldBeAway, 200);
        EXPECT_GT(counts.away, (speed < 0.1 ? 0.6 : 0.4) * counts.couldBeAway) << "speed " << speed;
    }
}

// The frustum for culling is widened by the object's own blur, which may exceed the blur of the lens.
TEST(Visibility, anObjectBlurredMoreThanTheLensBlursIsSeenFromFarther) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(quad(0));
    small->view.width = 400;
    small->view.height = 300;
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2;
    // The square is 0.4 px wide and 10 px outside the image. Its blur disk of 7 px does not reach the image.
    const double pixel = 2 * tanHalfHorizontalFov(small->view.lens) * 4 / 400;
    place(*small, 0,
          glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(210 * pixel, 0, -4)), glm::dvec3(0.2 * pixel)));
    finish(*small);
    EXPECT_TRUE(planFrame(small->world, small->view, settingsFor(16)).objects.empty());
    small->world.pose.objects[0].cocScale = 4;
    EXPECT_EQ(planFrame(small->world, small->view, settingsFor(16)).objects.size(), 1u);
    small->world.pose.objects[0].cocScale = 1;
    Mesh& mesh = small->scene.meshes[0];
    mesh.vertices.blurs.assign(4, {0, 2, 2});
    mesh.blurBounds = boundsOf(mesh.vertices.blurs);
    finish(*small);
    EXPECT_EQ(planFrame(small->world, small->view, settingsFor(16)).objects.size(), 1u);
}

std::unique_ptr<SmallWorld> oneSphere(const glm::dmat4& worldFromObject, bool doubleSided = false) {
    auto small = std::make_unique<SmallWorld>();
    const Material material{.doubleSided = doubleSided};
    small->scene.materials.push_back(material);
    small->scene.meshes.push_back(bumpySphere(160, 120, 0));
    place(*small, 0, worldFromObject);
    small->view.lens.fStop = 1.4;
    small->view.lens.focusDistance = 4;
    finish(*small);
    return small;
}

glm::dmat4 at(double x, double z, double scale = 1) {
    return glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z)), glm::dvec3(scale));
}

double share(std::uint64_t part, const FramePlan& plan) {
    return static_cast<double>(part) / static_cast<double>(plan.trianglesAtFullDetail);
}

TEST(Visibility, farSideOfASphereIsLeftOut) {
    for (const double mirror : {1.0, -1.0}) {
        const auto small = oneSphere(glm::scale(at(0, -4), glm::dvec3(mirror, 1, 1)));
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(16));
        // From 4 m, (1 + 1/4)/2 = 62.5 % of a unit sphere's surface faces away from the eye. Fewer triangles are
        // culled, because ripples widen the clusters' normal cones.
        EXPECT_GT(share(plan.trianglesFacingAway, plan), 0.35);
        EXPECT_LT(share(plan.trianglesFacingAway, plan), 0.625);
        EXPECT_EQ(plan.trianglesDrawn + plan.trianglesFacingAway + plan.trianglesOutside, plan.trianglesAtFullDetail);
        EXPECT_TRUE(std::any_of(plan.leftOut.begin(), plan.leftOut.end(), [](const LeftOut& entry) {
            return entry.reason == "their clusters face away from the whole lens";
        }));
    }
}

// The bounds of clusters hold in the rest pose only, so a skin may move clusters out of their bounds.
TEST(Visibility, clustersOfASkinnedSphereAreKept) {
    const auto skinned = oneSphere(at(0, -4));
    Vertices& vertices = skinned->scene.meshes[0].vertices;
    vertices.joints.assign(vertices.count(), glm::u16vec4(0));
    vertices.weights.assign(vertices.count(), glm::vec4(1, 0, 0, 0));
    finish(*skinned);
    skinned->world.pose.objects[0].worldFromJoint = {at(0, -4)};
    const FramePlan plan = planFrame(skinned->world, skinned->view, settingsFor(16));
    EXPECT_EQ(plan.trianglesDrawn, plan.trianglesAtFullDetail);
}

TEST(Visibility, doubleSidedSurfacesNeverFaceAway) {
    const auto small = oneSphere(at(0, -4), true);
    EXPECT_EQ(planFrame(small->world, small->view, settingsFor(16)).trianglesFacingAway, 0u);
}

TEST(Visibility, whatReachesOutOfTheImageIsLeftOutUnlessItsBlurReachesIn) {
    // the sphere's centre is beyond the image's edge, which lies at x = 1.44 m
    const auto small = oneSphere(at(1.5, -4));
    small->view.lens.fStop = 16;
    const FramePlan sharp = planFrame(small->world, small->view, settingsFor(16));
    EXPECT_GT(share(sharp.trianglesOutside, sharp), 0.3);
    small->view.lens.fStop = 0.1;
    small->view.lens.focusDistance = 0.5;
    const FramePlan blurred = planFrame(small->world, small->view, settingsFor(16));
    EXPECT_LT(share(blurred.trianglesOutside, blurred), 0.5 * share(sharp.trianglesOutside, sharp));
    // With a limit on the background's blur, almost as many clusters are culled as in the sharp image.
    small->view.lens.backgroundLimit = 2;
    const FramePlan bounded = planFrame(small->world, small->view, settingsFor(16));
    EXPECT_GT(share(bounded.trianglesOutside, bounded), 0.9 * share(sharp.trianglesOutside, sharp));
}

TEST(Visibility, allIsKeptOnRequest) {
    const auto small = oneSphere(at(1.5, -4));
    RenderSettings settings = settingsFor(16);
    settings.keepAll = true;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    EXPECT_EQ(plan.trianglesDrawn, plan.trianglesAtFullDetail);
    EXPECT_TRUE(plan.objects[0].visible.empty());
}

TEST(Visibility, trianglesTooSmallForThePixelGridAreKept) {
    const auto small = oneSphere(at(0, -4, 0.0005));  // the sphere is 0.4 px wide and has 38,000 triangles
    EXPECT_EQ(planFrame(small->world, small->view, settingsFor(16)).trianglesFacingAway, 0u);
}

TEST(Visibility, aBoxAroundTheCameraIsNotTakenToFaceAway) {
    const auto small = oneSphere(at(0, -0.5));  // the camera is inside the sphere and sees only back faces
    small->view.nearPlane = 0.01;
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(16));
    EXPECT_LT(share(plan.trianglesFacingAway, plan), 0.6);
    EXPECT_GT(share(plan.trianglesOutside, plan), 0.3);
}

}  // namespace
}  // namespace defocus::engine
