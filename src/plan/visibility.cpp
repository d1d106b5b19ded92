// Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, Appendix A. Shirman and
// Abi-Ezzi 1993, The Cone of Normals Technique for Fast Processing of Curved Patches.

#include "plan/visibility.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace defocus {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double snapping = 1.0 / 128;      // px that an altitude may lose where positions have 8 bits below the pixel
constexpr double transformation = 0x1p-21;  // of a position's terms: what single precision may lose of their sum
constexpr double storage = 1e-6;            // relative: of a cluster's values
constexpr double guardBand = 1.8;           // images from the middle beyond which triangles may be clipped
constexpr int shutterParts = 4;             // of the way between two moments, each with one bound of the motion
constexpr std::size_t mostMoments = 64;     // of the shutter: with more, all clusters are drawn
constexpr double leastSaving = 1.0 / 8;     // of a level's triangles, below which it is drawn whole
constexpr std::uint32_t leastGap = 128;     // triangles: to hide fewer costs more than a further run of indices

// The lens in object space during a part of the exposure.
struct LensRange {
    glm::dvec3 eye{0};             // its centre in the middle of the part
    glm::dmat3 viewFromNormal{1};  // inverse transpose of the matrix
    double inverseSize = 0;        // bound of the norm of the inverse matrix
    double motion = 0;             // how far any point of the lens moves from where it is in the middle of the part
};

// An object as all samples of the frame see it.
struct ObjectViews {
    std::vector<glm::dmat4> viewFromObject;  // at the shutter's moments, and in the middle of the exposure
    std::vector<LensRange> lenses;           // empty: no cluster is taken to face away
    double lensRadius = 0;                   // m, of the disk that stands for the lens
    double shapeLoss = 1;      // a triangle's altitude in px shrinks by a tilted focus plane's shear, at most
    double leastVolume = 0;    // of a unit of the object's space, m³
    double largestSize = 0;    // bound of the matrices' norms
    double largestOffset = 0;  // m, of the object's origin from the camera
    double cocScale = 1;
};

double frobeniusNorm(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

// The lens while the matrix goes from `from` to `to`: at x = A⁻¹(e − T) for a point e. With τ the way from the middle,
// x − x₀ = −τ·(I + τ·A⁻¹·ΔA)⁻¹·A⁻¹(ΔT + ΔA·x₀). Nothing where the matrix may lose its inverse or its winding.
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
    views.leastVolume = std::min(views.leastVolume, std::abs(determinant) * std::pow(1 - turn, 3));
    return range;
}

void addLenses(ObjectViews& views, const ObjectPlan& object, const World& world) {
    views.leastVolume = infinity;
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

ObjectViews objectViews(const ObjectPlan& object, const World& world, const FramePlan& plan) {
    ObjectViews views;
    views.viewFromObject.push_back(object.viewFromObject);
    for (const ObjectPose& pose : object.motion) views.viewFromObject.push_back(pose.viewFromJoint.front());
    for (const glm::dmat4& matrix : views.viewFromObject) {
        views.largestSize = std::max(views.largestSize, frobeniusNorm(glm::dmat3(matrix)));
        views.largestOffset = std::max(views.largestOffset, glm::length(glm::dvec3(matrix[3])));
    }
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    if (mesh.cocScaleLeast != mesh.cocScaleMost) return views;
    views.cocScale = object.cocScale * mesh.cocScaleLeast;
    double reach = 0;  // of the samples on the unit disk
    for (const LensSample& sample : plan.samples)
        reach = std::max(reach, static_cast<double>(glm::length(sample.lens)));
    const ClipCircleOfConfusion& coc = plan.coc;
    const double slope =
        reach * views.cocScale * (coc.front + coc.chromatic) * std::hypot(coc.tilt.x, coc.aspect * coc.tilt.y);
    if (!(slope < 0.9)) return views;
    views.lensRadius = reach * views.cocScale * std::abs(coc.a) * plan.tanHalfHorizontal / (1 - slope);
    views.shapeLoss = (1 + slope) / (1 - slope);
    addLenses(views, object, world);
    return views;
}

// Around the cluster's ball at all times.
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

// How far (object units) the lens must lie behind a plane so that no triangle of the cluster turns over when its
// corners are rounded: a triangle of altitude α and longest edge L has the area f²·α·L·h·|det A|/(2 w₀w₁w₂) in px², f
// px a unit at distance 1 and h the distance from its plane, and edges of at most f·L·‖A‖·distance/w². Infinity where
// it might.
double leastPlaneDistance(const Cluster& cluster, const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    const double least = -box.maximum.z;
    const double most = -box.minimum.z;
    if (!(least > plan.view.nearPlane * (1 + storage)) || !(cluster.leastAltitude > 0)) return infinity;
    const double focal = plan.view.width / (2 * plan.tanHalfHorizontal);
    const double terms =
        views.largestSize * (glm::length(glm::dvec3(cluster.centre)) + cluster.radius) + views.largestOffset;
    const double lost = views.shapeLoss * (snapping + focal / least * transformation * terms);
    const double distance = glm::length(glm::max(glm::abs(box.minimum), glm::abs(box.maximum))) + views.lensRadius;
    return lost * views.largestSize * distance * most * most * most /
           (focal * cluster.leastAltitude * views.leastVolume * least * least);
}

// All of the lens lies behind all planes of the cluster by `margin` or more.
bool facesAway(const Cluster& cluster, const LensRange& lens, double lensRadius, double margin) {
    const double cosine = cluster.leastCosine;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const glm::dvec3 axis(cluster.axis);
    const glm::dvec3 toCentre = glm::dvec3(cluster.centre) - lens.eye;
    const double along = glm::dot(toCentre, axis);
    const double across = glm::length(glm::cross(toCentre, axis));
    const double size = glm::length(toCentre);
    // n·toCentre is least for the n that is turned away from it by the cone's angle, or opposite if the cone holds
    // that.
    const bool holdsOpposite = across * cosine + along * sine < 0;
    const double nearest = holdsOpposite ? -size : along * cosine - across * sine;
    const double disk = lensRadius * (glm::length(glm::dvec2(lens.viewFromNormal * axis)) + sine * lens.inverseSize);
    return nearest + cluster.planes - disk - lens.motion >= margin + storage * size;
}

bool clusterFacesAway(const Cluster& cluster, const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    if (views.lenses.empty() || !(cluster.leastCosine > 0)) return false;
    const double margin = leastPlaneDistance(cluster, box, views, plan);
    if (!(margin < infinity)) return false;
    const bool away = std::all_of(views.lenses.begin(), views.lenses.end(), [&](const LensRange& lens) {
        return facesAway(cluster, lens, views.lensRadius, margin);
    });
    if (!away) return false;
    // Neither clipped into other triangles nor bent by C?
    const CocBox coc = cocBoxOf(box, views.cocScale, views.cocScale, plan);
    const double reach = guardBand - circleOfConfusionRange(plan.coc, coc, plan.view.width).largest / plan.view.width *
                                         std::max(1.0, plan.coc.aspect);
    if (!(std::max({-coc.ndcLeast.x, coc.ndcMost.x, -coc.ndcLeast.y, coc.ndcMost.y}) < reach)) return false;
    if (!plan.usesCocControls) return true;
    const glm::dvec2 tanHalf = plan.tanHalfHorizontal * glm::dvec2(1, 1 / plan.coc.aspect);
    const CocDeviation deviation = cocDeviation(plan.coc, coc, 1, tanHalf, plan.view.width);
    return deviation.kinks == 0 && deviation.curved == 0;
}

bool clusterOutside(const Bounds& box, const ObjectViews& views, const FramePlan& plan) {
    double largest = infinity;
    if (-box.maximum.z > plan.view.nearPlane)
        largest = circleOfConfusionRange(plan.coc, cocBoxOf(box, views.cocScale, views.cocScale, plan), plan.view.width)
                      .largest;
    return outsideWidenedFrustum(box, plan, largest);
}

bool doubleSided(const Scene& scene, const Primitive& primitive) {
    return primitive.material >= 0 && scene.materials[static_cast<std::size_t>(primitive.material)].doubleSided;
}

// Runs of a primitive's indices, and what is left out between them.
class Runs {
public:
    explicit Runs(VisibleLevel& level) : level_(&level), runs_(&level.primitives.emplace_back()) {}

    void show(const IndexRange& range) {
        if (!runs_->empty() && (away_ + outside_) < leastGap)  // not worth a further run
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
    std::uint32_t away_ = 0;  // triangles since the last run
    std::uint32_t outside_ = 0;
};

VisibleLevel levelWithoutHidden(const ObjectViews& views, const ObjectPlan& object, std::uint32_t number,
                                const World& world, const FramePlan& plan) {
    VisibleLevel visible;
    visible.level = number;
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    const PyramidLevel& level = world.pyramids[static_cast<std::size_t>(object.mesh)].levels[number];
    auto cluster = level.clusters.begin();
    for (std::size_t p = 0; p < level.primitives.size(); ++p) {
        Runs runs(visible);
        const bool oneSided = !doubleSided(*world.scene, mesh.primitives[p]);
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

CocBox cocBoxOf(const Bounds& viewBox, double scaleLeast, double scaleMost, const FramePlan& plan) {
    CocBox box{.zNear = -viewBox.maximum.z, .zFar = -viewBox.minimum.z};
    box.scaleLeast = scaleLeast;
    box.scaleMost = scaleMost;
    const double aspect = static_cast<double>(plan.view.width) / plan.view.height;
    const glm::dvec2 perTangent(1 / plan.tanHalfHorizontal, aspect / plan.tanHalfHorizontal);
    box.ndcLeast = glm::dvec2(infinity);
    box.ndcMost = -box.ndcLeast;
    for (const glm::dvec3& corner : viewBox.corners()) {
        const glm::dvec2 ndc = glm::dvec2(corner) * perTangent / -corner.z;
        box.ndcLeast = glm::min(box.ndcLeast, ndc);
        box.ndcMost = glm::max(box.ndcMost, ndc);
    }
    return box;
}

// All corners lie outside one plane of the frustum: for the left one, at the place −1 in the image, while x/tan + w +
// |C| < 0 (half a pixel added for the jitter). The thin lens's |C(w)| is convex, so corners bound it; otherwise |C|/w
// is at most `largest` px over the image's width. Within the image a further pixel makes up for rounded corners of
// triangles.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, double largest, const PixelRectangle& area) {
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
        const double reach = coc.thinLens() ? std::abs(coc.a + coc.front * w) + std::abs(w) * coc.chromatic
                                            : std::abs(w) * largest / view.width;
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

bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, double largest) {
    return outsideWidenedFrustum(viewBox, plan, largest, {0, 0, plan.view.width, plan.view.height});
}

void leaveOutClusters(ObjectPlan& object, const World& world, const FramePlan& plan) {
    if (object.deformed || object.skinned || object.motion.size() > mostMoments) return;
    const ObjectViews views = objectViews(object, world, plan);
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    for (LevelDraw* draw : {&object.coarse, &object.fine}) {
        if (draw->sampleCount == 0) continue;
        VisibleLevel visible = levelWithoutHidden(views, object, draw->level, world, plan);
        const std::uint32_t all = pyramid.levels[draw->level].triangleCount;
        const std::uint32_t saved = visible.facingAway + visible.outside;
        if (saved == 0 || saved < leastSaving * all) continue;
        draw->triangleCount = all - saved;
        object.visible.push_back(std::move(visible));
    }
}

}  // namespace defocus
