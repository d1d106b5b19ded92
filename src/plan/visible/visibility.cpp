// Culls geometry. Sources: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic
// Rasterization, Appendix A. Shirman and Abi-Ezzi 1993, The Cone of Normals Technique for Fast Processing of Curved
// Patches.

#include "plan/visible/visibility.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace defocus::engine {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Max change of a triangle's altitude, in px, if its vertices are rounded to 8 subpixel bits.
constexpr double snapping = 1.0 / 128;
// Max rounding error of a float position, relative to the sum of the magnitudes of its added terms.
constexpr double transformation = 0x1p-21;
constexpr double storage = 1e-6;   // max relative rounding error of a cluster's bounds, which are floats
constexpr double guardBand = 1.8;  // |NDC| beyond which triangles may be clipped
constexpr int shutterParts = 4;    // number of intervals between two shutter times, each with its own motion bound
// Max number of shutter times (times at which motion is sampled) for culling. With more shutter times, no cluster is
// culled.
constexpr std::size_t maxMoments = 64;
constexpr double minSaving = 1.0 / 8;  // min culled fraction of a level's triangles; if fewer are culled, all are drawn
// Min number of culled triangles between two drawn ranges. A shorter gap is drawn, too, which joins the ranges.
constexpr std::uint32_t minGap = 128;

// Bounds of the lens in object space during a time interval of the exposure.
struct LensRange {
    glm::dvec3 eye{0};             // centre of the lens halfway through the interval
    glm::dmat3 viewFromNormal{1};  // inverse transpose of the object's matrix
    double inverseSize = 0;        // Frobenius norm of the object's inverse matrix
    // Max distance of a lens point, at any time of the interval, from its position halfway through.
    double motion = 0;
};

// An object as seen by all samples of the frame.
struct ObjectViews {
    std::vector<glm::dmat4> viewFromObject;  // matrix halfway through the exposure, then at each shutter time
    // Lens bounds, for culling back faces, in time intervals of the exposure; empty: back faces are not culled.
    std::vector<LensRange> lenses;
    double lensRadius = 0;  // radius in m of the disk that bounds the lens
    // With a tilted focus plane, the shape of a triangle's image depends on the lens point. Max factor, ≥ 1, by which
    // its altitude shrinks.
    double shapeLoss = 1;
    // Volume in m³ of a cube with sides of one object unit; min over the exposure.
    double minVolume = 0;
    double largestSize = 0;    // upper bound of the norms of viewFromObject
    double largestOffset = 0;  // max distance in m from the camera to the object's origin, over all viewFromObject
    OwnBlur own;               // bounds of the surfaces' blur factor and added blur
};

double frobeniusNorm(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

// Returns bounds of the lens in object space while the object's matrix, A with translation T, moves linearly from
// `from` to `to`. A lens point e lies at x = A⁻¹(e − T). Let A, T and x₀ be the values halfway through the movement,
// and let ΔA and ΔT be half the changes from start to end. At time τ ∈ [−1, 1] from halfway,
// x − x₀ = −τ·(I + τ·A⁻¹·ΔA)⁻¹·A⁻¹(ΔT + ΔA·x₀). Returns nullopt if the matrix may become singular or mirrored.
std::optional<LensRange> lensRange(const glm::dmat4& from, const glm::dmat4& to, bool mirrored, ObjectViews& views) {
    const glm::dmat4 middle = 0.5 * (from + to);
    const glm::dmat3 matrix(middle);
    const glm::dmat3 change(0.5 * (to - from));
    const double determinant = glm::determinant(matrix);
    if (!(std::abs(determinant) > 0) || (determinant < 0) != mirrored) return {};
    const glm::dmat3 inverse = glm::inverse(matrix);
    LensRange range;
    range.eye = -(inverse * glm::dvec3(middle[3]));
    range.viewFromNormal = glm::transpose(inverse);
    range.inverseSize = frobeniusNorm(inverse);
    const double turn = frobeniusNorm(inverse * change);
    if (!(turn < 0.5)) return {};
    const glm::dvec3 velocity = inverse * (glm::dvec3(0.5 * (to[3] - from[3])) + change * range.eye);
    range.motion = (glm::length(velocity) + turn * range.inverseSize * views.lensRadius) / (1 - turn);
    views.minVolume = std::min(views.minVolume, std::abs(determinant) * std::pow(1 - turn, 3));
    return range;
}

void addLenses(ObjectViews& views, const ObjectPlan& object, const World& world) {
    views.minVolume = infinity;
    std::vector<LensRange> lenses;
    const auto add = [&](const glm::dmat4& from, const glm::dmat4& to) {
        const std::optional<LensRange> range = lensRange(from, to, object.mirrored, views);
        if (range) lenses.push_back(*range);
        return range.has_value();
    };
    if (!add(object.viewFromObject, object.viewFromObject)) return;
    for (std::size_t i = 0; i < object.motion.size(); ++i) {
        const glm::dmat4& from = object.motion[i].viewFromJoint.front();
        const bool last = world.shutter.perSample || i + 1 == object.motion.size();
        const glm::dmat4& to = last ? from : object.motion[i + 1].viewFromJoint.front();
        const int parts = last ? 1 : shutterParts;
        const auto between = [&](int part) { return from + static_cast<double>(part) / parts * (to - from); };
        for (int part = 0; part < parts; ++part)
            if (!add(between(part), between(part + 1))) return;
    }
    views.lenses = std::move(lenses);
}

// Returns the largest distance of a lens sample from the lens's centre, in radii of the lens.
double lensReach(const FramePlan& plan) {
    double reach = 0;
    for (const LensSample& sample : plan.samples)
        reach = std::max(reach, static_cast<double>(glm::length(sample.lens)));
    return reach;
}

ObjectViews objectViews(const ObjectPlan& object, const World& world, const FramePlan& plan) {
    ObjectViews views;
    views.viewFromObject.push_back(object.viewFromObject);
    for (const ObjectPose& pose : object.motion) views.viewFromObject.push_back(pose.viewFromJoint.front());
    for (const glm::dmat4& matrix : views.viewFromObject) {
        views.largestSize = std::max(views.largestSize, frobeniusNorm(glm::dmat3(matrix)));
        views.largestOffset = std::max(views.largestOffset, glm::length(glm::dvec3(matrix[3])));
    }
    views.own = object.own;
    if (views.own.varies() || plan.coc.aberrates()) return views;
    const double factor = views.own.factorMax;
    const double reach = lensReach(plan);
    const ClipCircleOfConfusion& coc = plan.coc;
    const double slope = reach * factor * (coc.front + coc.chromatic) * std::hypot(coc.tilt.x, coc.aspect * coc.tilt.y);
    if (!(slope < 0.9)) return views;
    views.lensRadius =
        reach * factor * std::max(std::abs(coc.a), std::abs(coc.aBehind)) * plan.tanHalfHorizontal / (1 - slope);
    views.shapeLoss = (1 + slope) / (1 - slope);
    addLenses(views, object, world);
    return views;
}

// Returns a view-space box around the cluster's bounding sphere over all times of the exposure.
Bounds viewBoxOf(const Cluster& cluster, const ObjectViews& views) {
    Bounds box;
    for (const glm::dmat4& matrix : views.viewFromObject) {
        const glm::dvec3 centre(matrix * glm::dvec4(glm::dvec3(cluster.centre), 1));
        const glm::dmat3 rows = glm::transpose(glm::dmat3(matrix));
        const glm::dvec3 reach = static_cast<double>(cluster.radius) *
                                 glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
        box.extend(centre - reach);
        box.extend(centre + reach);
    }
    return box;
}

// Returns how far the lens must lie behind the planes of the cluster's triangles, in object units, so that rounding
// flips no triangle. Returns infinity if rounding may flip a triangle at any distance.
//
// A triangle of altitude α and longest edge L has the area f²·α·L·h·|det A|/(2 w₀w₁w₂) in px². A is the matrix from
// object to view space, and wᵢ are the depths of the corners. f is the number of px per unit at distance 1, and h the
// lens's distance from the triangle's plane. The triangle's edges are at most f·L·‖A‖·d/w² px long, where d is the max
// distance of a corner from the lens, and w the min depth. Its altitude in px is twice the area over the edge length.
// The result is the h at which this altitude equals the largest reduction of the altitude by rounding.
double minPlaneDistance(const Cluster& cluster, const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    const double min = -box.maximum.z;
    const double max = -box.minimum.z;
    if (!(min > plan.view.nearPlane * (1 + storage)) || !(cluster.minAltitude > 0)) return infinity;
    const double focal = plan.view.width / (2 * plan.tanHalfHorizontal);
    const double terms =
        views.largestSize * (glm::length(glm::dvec3(cluster.centre)) + cluster.radius) + views.largestOffset;
    const double lost = views.shapeLoss * (snapping + focal / min * transformation * terms);
    const double distance = glm::length(glm::max(glm::abs(box.minimum), glm::abs(box.maximum))) + views.lensRadius;
    return lost * views.largestSize * distance * max * max * max /
           (focal * cluster.minAltitude * views.minVolume * min * min);
}

// Returns true if the entire lens lies behind the planes of all triangles in the cluster by at least `margin`.
bool facesAway(const Cluster& cluster, const LensRange& lens, double lensRadius, double margin) {
    const double cosine = cluster.minCosine;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const glm::dvec3 axis(cluster.axis);
    const glm::dvec3 toCentre = glm::dvec3(cluster.centre) - lens.eye;
    const double along = glm::dot(toCentre, axis);
    const double across = glm::length(glm::cross(toCentre, axis));
    const double size = glm::length(toCentre);
    // Find the min of n·toCentre over all unit normals n in the cluster's normal cone. If the cone contains the
    // direction −toCentre, the min is −|toCentre|. Otherwise the min lies on the cone's boundary.
    const bool holdsOpposite = across * cosine + along * sine < 0;
    const double nearest = holdsOpposite ? -size : along * cosine - across * sine;
    const double disk = lensRadius * (glm::length(glm::dvec2(lens.viewFromNormal * axis)) + sine * lens.inverseSize);
    return nearest + cluster.planes - disk - lens.motion >= margin + storage * size;
}

// Returns true if no triangle in the box is clipped. Clipping would add corners with additional rounding errors.
bool staysWhole(const CocBox& coc, const FramePlan& plan) {
    const double reach = guardBand - circleOfConfusionRange(plan.coc, coc, plan.view.width).largest / plan.view.width *
                                         std::max(1.0, plan.coc.aspect);
    return std::max({-coc.ndcMin.x, coc.ndcMax.x, -coc.ndcMin.y, coc.ndcMax.y}) < reach;
}

// Returns true if the clip-space blur (CoC · depth) is a single linear function of the position over the box.
bool isOneLinearPiece(const CocBox& coc, const FramePlan& plan) {
    const glm::dvec2 tanHalf = plan.tanHalfHorizontal * glm::dvec2(1, 1 / plan.coc.aspect);
    const CocDeviation deviation = cocDeviation(plan.coc, coc, 1, tanHalf, plan.view.width);
    return deviation.kinks == 0 && deviation.curved == 0;
}

bool clusterFacesAway(const Cluster& cluster, const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    if (views.lenses.empty() || !(cluster.minCosine > 0)) return false;
    const double margin = minPlaneDistance(cluster, box, views, plan);
    if (!(margin < infinity)) return false;
    const bool away = std::all_of(views.lenses.begin(), views.lenses.end(), [&](const LensRange& lens) {
        return facesAway(cluster, lens, views.lensRadius, margin);
    });
    if (!away) return false;
    const CocBox coc = cocBoxOf(box, views.own, plan);
    return staysWhole(coc, plan) && (!plan.usesCocControls || isOneLinearPiece(coc, plan));
}

// ---- culling of levels ---------------------------------------------------------------------------------------------

bool clusterOutside(const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    double largest = infinity;
    if (-box.maximum.z > plan.view.nearPlane)
        largest = circleOfConfusionRange(plan.coc, cocBoxOf(box, views.own, plan), plan.view.width).largest;
    return outsideWidenedFrustum(box, plan, views.own, largest);
}

// Collects index ranges of a primitive's visible clusters, and counts the culled triangles between them.
class Runs {
public:
    explicit Runs(VisibleLevel& level) : level_(&level), runs_(&level.primitives.emplace_back()) {}

    void show(const IndexRange& range) {
        // If too few triangles were culled after the last range, extend that range over them.
        if (!runs_->empty() && (away_ + outside_) < minGap)
            runs_->back().count += 3 * (away_ + outside_) + range.count;
        else {
            leaveOut();
            runs_->push_back(range);
        }
        away_ = 0;
        outside_ = 0;
    }
    void hideFacingAway(std::uint32_t triangles) { away_ += triangles; }
    void hideOutside(std::uint32_t triangles) { outside_ += triangles; }
    void leaveOut() {
        level_->facingAway += away_;
        level_->outside += outside_;
    }

private:
    VisibleLevel* level_;
    std::vector<IndexRange>* runs_;
    std::uint32_t away_ = 0;     // triangles that face away, after the last range in runs_
    std::uint32_t outside_ = 0;  // triangles outside the image, after the last range in runs_
};

VisibleLevel levelWithoutHidden(const ObjectViews& views, const ObjectPlan& object, std::uint32_t number,
                                const World& world, const FramePlan& plan) {
    VisibleLevel visible;
    visible.level = number;
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    const PyramidLevel& level = pyramid.levels[number];
    auto cluster = level.clusters.begin();
    for (std::size_t p = 0; p < level.primitives.size(); ++p) {
        Runs runs(visible);
        const bool oneSided = !materialAt(*world.scene, mesh.primitives[p].material).doubleSided;
        const std::uint32_t end = level.primitives[p].first + level.primitives[p].count;
        for (; cluster != level.clusters.end() && cluster->indices.first < end; ++cluster) {
            const Bounds box = viewBoxOf(*cluster, views);
            if (clusterOutside(box, views, plan))
                runs.hideOutside(cluster->indices.count / 3);
            else if (oneSided && clusterFacesAway(*cluster, box, views, plan))
                runs.hideFacingAway(cluster->indices.count / 3);
            else
                runs.show(cluster->indices);
        }
        runs.leaveOut();
    }
    return visible;
}

}  // namespace

CocBox cocBoxOf(const Bounds& viewBox, const OwnBlur& own, const FramePlan& plan) {
    CocBox box{.zNear = -viewBox.maximum.z, .zFar = -viewBox.minimum.z};
    box.own = own;
    const double aspect = static_cast<double>(plan.view.width) / plan.view.height;
    const glm::dvec2 perTangent(1 / plan.tanHalfHorizontal, aspect / plan.tanHalfHorizontal);
    box.ndcMin = glm::dvec2(infinity);
    box.ndcMax = -box.ndcMin;
    for (const glm::dvec3& corner : viewBox.corners()) {
        const glm::dvec2 ndc = glm::dvec2(corner) * perTangent / -corner.z;
        box.ndcMin = glm::min(box.ndcMin, ndc);
        box.ndcMax = glm::max(box.ndcMax, ndc);
    }
    return box;
}

namespace {

// Returns the largest clip-space blur |C| = |factor·(a + b·w) + added·w| of the thin lens at depth w, over all
// wavelengths. a and b are ClipCircleOfConfusion::a and ::front. C is linear in `factor` and `added`, so |C| is largest
// at the ends of their ranges.
double thinLensReach(const ClipCircleOfConfusion& coc, const OwnBlur& own, double w) {
    double reach = 0;
    for (const double factor : {own.factorMin, own.factorMax})
        for (const double added : {own.addedMin, own.addedMax})
            reach = std::max(reach, std::abs(factor * (coc.a + coc.front * w) + added * w));
    return reach + own.factorMax * std::abs(w) * coc.chromatic;
}

}  // namespace

// Returns true if all corners of the box lie outside one plane of the frustum, which the lens widens. For the left
// plane, at image position −1, this means x/tan(θx/2) + w + |C| < 0, with half a pixel added for the jitter. x is the
// view-space position, w the depth, θx the horizontal field of view and C the clip-space blur (CoC · depth). For a thin
// lens, |C(w)| is convex, so the corners bound it. For other lenses, |C|/w is at most `largest`, the largest CoC in px,
// divided by the image's width in px. If a side of `area`, the rectangle of a tile, lies inside the image, one more
// pixel is added for the rounding of vertex positions.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest,
                           const PixelRectangle& area) {
    const View& view = plan.view;
    const ClipCircleOfConfusion& coc = plan.coc;
    const double tanX = plan.tanHalfHorizontal;
    const double tanY = tanX * view.height / view.width;
    const auto border = [](int pixel, int pixels, int rounded) {
        if (pixel <= 0) return -1.0;
        return pixel >= pixels ? 1.0 : 2.0 * (pixel + rounded) / pixels - 1;
    };
    const double left = border(area.left, view.width, -1);
    const double right = border(area.left + area.width, view.width, 1);
    const double upper = -border(area.top, view.height, -1);
    const double lower = -border(area.top + area.height, view.height, 1);
    bool outside[5] = {true, true, true, true, true};
    for (const glm::dvec3& corner : viewBox.corners()) {
        const double w = -corner.z;
        const double reach = coc.thinLens() ? thinLensReach(coc, own, w) : std::abs(w) * largest / view.width;
        const double x = corner.x / tanX;
        const double y = corner.y / tanY;
        const double marginX = std::abs(w) / view.width + reach;
        const double marginY = std::abs(w) / view.height + reach * view.width / view.height;
        outside[0] &= x - left * w + marginX < 0;
        outside[1] &= right * w - x + marginX < 0;
        outside[2] &= y - lower * w + marginY < 0;
        outside[3] &= upper * w - y + marginY < 0;
        outside[4] &= w < view.nearPlane;
    }
    return std::any_of(std::begin(outside), std::end(outside), [](bool value) { return value; });
}

bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest) {
    return outsideWidenedFrustum(viewBox, plan, own, largest, {0, 0, plan.view.width, plan.view.height});
}

void leaveOutClusters(ObjectPlan& object, const World& world, const FramePlan& plan) {
    if (object.deformed || object.skinned || object.motion.size() > maxMoments) return;
    const ObjectViews views = objectViews(object, world, plan);
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    for (LevelDraw* draw : {&object.coarse, &object.fine}) {
        if (draw->sampleCount == 0) continue;
        VisibleLevel visible = levelWithoutHidden(views, object, draw->level, world, plan);
        const std::uint32_t all = pyramid.levels[draw->level].triangleCount;
        const std::uint32_t saved = visible.facingAway + visible.outside;
        if (saved == 0 || saved < minSaving * all) continue;
        draw->triangleCount = all - saved;
        object.visible.push_back(std::move(visible));
    }
}

}  // namespace defocus::engine
