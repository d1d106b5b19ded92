// Plans shadow maps. Sources: Haeberli and Akeley 1990, The Accumulation Buffer (soft shadows); Williams 1978, Casting
// Curved Shadows on Curved Surfaces; Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square.
#include "plan/visible/shadows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "plan/motion/object_pose.h"
#include "plan/visible/light_shares.h"
#include "plan/visible/seen_points.h"

namespace defocus::engine {

namespace {

constexpr int minMapSize = 128;         // min width and height of a shadow map, px
constexpr int maxImageMapSize = 2048;   // lower bound in px of the map size if the image is larger than this
constexpr double resolvedShare = 0.95;  // fraction of visible points where a texel must be at most texelPixels wide
// Max texel width in px. It may exceed 1, because each lens sample shifts the texels, and the mean over the samples
// smooths the shadows' edges.
constexpr double texelPixels = 2;
// A map has at most twice as many texels as the image has pixels, but the limit is never below this number.
constexpr double minTexelLimit = 1 << 20;
constexpr double maxSampleTexels = 64 << 20;  // max number of texels in all maps of a lens sample (256 MiB of depths)
constexpr double minShare = 0.01;             // lights below this share of the illuminance cast no shadow
constexpr double widestTangent = 3;           // max tan of half a map's field of view
constexpr double levelErrorTexels = 0.5;      // max simplification error of a caster, texels
constexpr std::size_t maxBoxes = 64;          // with more casters, a single box contains all casters
constexpr double nearShare = 1e-4;            // near plane of point and spot lights, as a fraction of the scene's size
constexpr std::uint32_t smoothPoints = 64;    // min number of points on a light for a smooth penumbra

struct Rectangle {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};
    void extend(const glm::dvec2& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void intersect(const Rectangle& other) {
        min = glm::max(min, other.min);
        max = glm::max(min, glm::min(max, other.max));
    }
};

struct Axes {
    glm::dvec3 x, y, z;
    explicit Axes(const glm::dvec3& towards) : z(glm::normalize(towards)) {
        const glm::dvec3 aside = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        x = glm::normalize(glm::cross(aside, z));
        y = glm::cross(z, x);
    }
    [[nodiscard]] glm::dvec3 of(const glm::dvec3& place) const {
        return {glm::dot(place, x), glm::dot(place, y), glm::dot(place, z)};
    }
};

Bounds boundsOfCorners(const std::vector<glm::dvec3>& corners) {
    Bounds bounds;
    for (const glm::dvec3& corner : corners) bounds.extend(corner);
    return bounds;
}

// ---- selection of lights and casters --------------------------------------------------------------------------------

// Returns the bounding box of the object over the exposure, in the view space of the middle of the exposure.
Bounds casterBox(const World& world, const FramePlan& plan, const ObjectPlan& object) {
    if (plan.middleFromView.empty() || object.motion.empty()) return object.viewBox;
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    Bounds box = posedBox(pyramid, object.pose, object.skinned);
    for (std::size_t i = 0; i < object.motion.size(); ++i)
        box.extend(transformed(posedBox(pyramid, object.motion[i], object.skinned), plan.middleFromView[i]));
    return box;
}

bool finite(const Bounds& box) {
    return !box.empty() && isFinite(glm::vec3(box.minimum)) && isFinite(glm::vec3(box.maximum));
}

// Returns the coarsest level whose simplification error is at most `error` m. `scale` is metres per unit of object
// space.
std::uint32_t casterLevel(const Pyramid& pyramid, double scale, double error) {
    std::uint32_t level = 0;
    while (level + 1 < pyramid.levels.size() && pyramid.levels[level + 1].error * scale <= error) ++level;
    return level;
}

// Returns true if a single shadow map can contain all that a point or spot light illuminates.
bool oneMapShows(const PlacedLight& placed, const glm::dvec3& position, const std::vector<glm::dvec3>& corners) {
    if (placed.light.type == LightType::spot &&
        std::tan(std::min(1.5, double{placed.light.outerConeAngle})) <= widestTangent)
        return true;
    const Axes axes(boundsOfCorners(corners).centre() - position + glm::dvec3(0, 1e-12, 0));
    return std::ranges::all_of(corners, [&](const glm::dvec3& corner) {
        const glm::dvec3 place = axes.of(corner - position);
        return place.z > 4 * placed.light.radius && glm::length(glm::dvec2(place)) < widestTangent * place.z;
    });
}

struct ShadowCandidate {
    int light = 0;
    double share = 0;  // light's share of the illuminance of the visible surfaces
    int faces = 1;
};

// Returns the shadow maps of the strongest lights, at most maxShadowMaps, in the order of the lights. `shares` are the
// results of lightShares().
std::vector<ShadowMap> chosenMaps(const World& world, const FramePlan& plan, const std::vector<glm::dvec3>& corners,
                                  const std::vector<double>& shares) {
    const glm::dvec3 camera(plan.view.worldFromCamera[3]);
    std::vector<ShadowCandidate> candidates;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const bool local = i < world.lights.size() && world.lights[i].light.type != LightType::directional;
        const bool several = local && !oneMapShows(world.lights[i], world.lights[i].position - camera, corners);
        candidates.push_back(
            {i < world.lights.size() ? static_cast<int>(i) : surroundings, shares[i], several ? 6 : 1});
    }
    std::ranges::stable_sort(candidates, std::greater<>(), &ShadowCandidate::share);
    std::size_t count = 0;
    std::vector<ShadowCandidate> chosen;
    for (const ShadowCandidate& one : candidates) {
        if (!(one.share >= minShare)) continue;
        if (count + static_cast<std::size_t>(one.faces) > maxShadowMaps) continue;
        count += static_cast<std::size_t>(one.faces);
        chosen.push_back(one);
    }
    std::ranges::sort(chosen, {}, &ShadowCandidate::light);
    std::vector<ShadowMap> maps;
    for (const ShadowCandidate& one : chosen)
        for (int face = 0; face < one.faces; ++face)
            maps.push_back({.light = one.light, .face = one.faces > 1 ? face : -1});
    return maps;
}

// Returns the number of points on each light per lens sample. A penumbra has as many brightness steps as there are
// points in all samples, so frames with few samples use several points per sample. If the frame is drawn in blocks of
// samples, the samples of earlier blocks count, too.
std::uint32_t pointsFor(const RenderSettings& settings, std::size_t maps) {
    const std::uint64_t samples = std::uint64_t{settings.firstSample} + settings.sampleCount;
    const std::uint64_t wanted = (smoothPoints + samples - 1) / std::max<std::uint64_t>(samples, 1);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, maxPointsPerSample(maps)));
}

// ---- projections of the shadow maps ---------------------------------------------------------------------------------

// Returns the corners of the volume that the lens samples see, up to the farthest object. Shadows outside this volume
// are invisible.
std::vector<glm::dvec3> seenCorners(const FramePlan& plan) {
    double farthest = plan.view.nearPlane;
    double widening = 0;  // widening of the frustum by the blur, as a fraction of the image's half width
    for (const ObjectPlan& object : plan.objects) {
        farthest = std::max(farthest, object.farthestDepth);
        widening = std::max(widening, object.coc.largest / plan.view.width);
    }
    std::vector<glm::dvec3> corners;
    if (!std::isfinite(farthest)) return corners;
    widening = std::isfinite(widening) ? widening : 1;
    const double tanX = plan.tanHalfHorizontal * (1 + widening) * 1.02;
    const double tanY =
        plan.tanHalfHorizontal * (static_cast<double>(plan.view.height) / plan.view.width + widening) * 1.02;
    const glm::dmat3 worldFromView(plan.view.worldFromCamera);
    for (const double depth : {0.0, farthest})
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                corners.push_back(worldFromView * (depth * glm::dvec3(x * tanX, y * tanY, -1)));
    return corners;
}

// Returns a subtexel shift of a shadow map that depends only on the lens sample and the point on the light. Averaged
// over the samples, the shifts smooth the edges of shadows.
glm::dvec2 texelShift(const LensSample& sample, std::uint32_t point) {
    const glm::dvec2 at = glm::dvec2(sample.light) * glm::dvec2(7919, 6733) + glm::dvec2(sample.pixel) * 5.0 +
                          static_cast<double>(point) * glm::dvec2(0.754877666, 0.569840291);
    return glm::fract(at);
}

// Sets the projection's rows for x and y, so that `area` fills a map of `size` texels. A border leaves room for the
// subtexel `shift`. `axes` are the coordinate axes of `area`.
void setRows(ShadowProjection& projection, const Axes& axes, const glm::dvec3& origin, Rectangle area, int size,
             const glm::dvec2& shift, double smallest) {
    const glm::dvec2 extent = glm::max(area.max - area.min, glm::dvec2(smallest));
    const glm::dvec2 texel = extent / (size - 2.0);
    const glm::dvec2 min = area.min - texel * (0.5 + shift);
    const glm::dvec4& w = glm::dvec4(projection.clipRows[3]);
    const auto row = [&](const glm::dvec3& axis, double begin, double width) {
        const glm::dvec4 along(axis, -glm::dot(axis, origin));
        return glm::vec4(2 / width * along - (2 * begin / width + 1) * w);
    };
    projection.clipRows[0] = row(axes.x, min.x, texel.x * size);
    projection.clipRows[1] = row(axes.y, min.y, texel.y * size);
    projection.texel = static_cast<float>(std::max(texel.x, texel.y));
}

ShadowProjection parallelProjection(const ShadowPlan& shadows, const glm::dvec3& toLight, const glm::dvec2& shift) {
    const Axes axes(toLight);
    Rectangle area;
    double nearest = -std::numeric_limits<double>::infinity();
    double farthest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : shadows.corners) {
        const glm::dvec3 place = axes.of(corner);
        area.extend(glm::dvec2(place));
        nearest = std::max(nearest, place.z);
        farthest = std::min(farthest, place.z);
    }
    Rectangle visible;
    for (const glm::dvec3& corner : shadows.seen) visible.extend(glm::dvec2(axes.of(corner)));
    if (!shadows.seen.empty()) area.intersect(visible);
    const double diagonal = glm::length(boundsOfCorners(shadows.corners).size());
    const double margin = 1e-3 * diagonal;
    const double depth = nearest - farthest + 2 * margin;
    ShadowProjection projection;
    projection.toLight = glm::vec3(axes.z);
    projection.clipRows[2] = glm::vec4(axes.z / depth, (margin - farthest) / depth);
    projection.clipRows[3] = glm::vec4(0, 0, 0, 1);
    setRows(projection, axes, glm::dvec3(0), area, shadows.size, shift, 1e-6 * diagonal);
    return projection;
}

glm::dvec3 faceDirection(int face) {
    glm::dvec3 direction(0);
    direction[face / 2] = face % 2 == 0 ? 1 : -1;
    return direction;
}

// Returns the bounds of `corners`, projected to the plane at distance 1 from the light; nullopt if a corner's depth
// from the light is at most `nearest`.
std::optional<Rectangle> inFront(const Axes& axes, const glm::dvec3& origin, const std::vector<glm::dvec3>& corners,
                                 double nearest) {
    Rectangle area;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 place = axes.of(corner - origin);
        if (place.z <= nearest) return {};
        area.extend(glm::dvec2(place) / place.z);
    }
    return area;
}

// Returns the projection of a shadow map from one point of the disk of a point or spot light. `point` is the position
// on the unit disk, `camera` the camera's position in m.
ShadowProjection localProjection(const ShadowPlan& shadows, const glm::dvec3& camera, const PlacedLight& placed,
                                 int face, const glm::dvec2& point, const glm::dvec2& shift) {
    const Bounds bounds = boundsOfCorners(shadows.corners);
    const double diagonal = glm::length(bounds.size());
    const glm::dvec3 centre = placed.position - camera;
    const bool spot = placed.light.type == LightType::spot && face < 0;
    const Axes disk(spot ? placed.direction : bounds.centre() - centre + glm::dvec3(0, 1e-12, 0));
    const glm::dvec3 origin = centre + double{placed.light.radius} * (point.x * disk.x + point.y * disk.y);
    // Geometry closer than the lamp's diameter casts no shadow, because it may be the lamp's own glass.
    const double nearest = std::max(nearShare * diagonal, 2.0 * placed.light.radius);

    const Axes axes(face >= 0 ? faceDirection(face) : spot ? placed.direction : bounds.centre() - origin);
    Rectangle area;
    if (face >= 0 || spot) {
        const double tangent =
            face >= 0 ? 1 + 4.0 / shadows.size : 1.02 * std::tan(double{placed.light.outerConeAngle});
        area.extend(glm::dvec2(-tangent));
        area.extend(glm::dvec2(tangent));
    }
    const auto casters = inFront(axes, origin, shadows.corners, nearest);
    if (face < 0 && casters) {
        if (spot)
            area.intersect(*casters);
        else
            area = *casters;
    }
    if (face < 0 && !shadows.seen.empty())
        if (const auto visible = inFront(axes, origin, shadows.seen, nearest)) area.intersect(*visible);
    ShadowProjection projection;
    projection.clipRows[2] = glm::vec4(0, 0, 0, nearest);
    projection.clipRows[3] = glm::vec4(axes.z, -glm::dot(axes.z, origin));
    setRows(projection, axes, origin, area, shadows.size, shift, 1e-6);
    return projection;
}

// Returns the projection of a shadow map from the point of the light at `place` in [0, 1)².
ShadowProjection mapProjection(const World& world, const glm::dvec3& camera, const ShadowPlan& shadows,
                               const EnvironmentDirections& directions, const ShadowMap& map, const glm::dvec2& place,
                               const glm::dvec2& shift) {
    if (map.light == surroundings) {
        const EnvironmentDirections::Choice choice = directions.at(place);
        ShadowProjection projection = parallelProjection(shadows, choice.toLight, shift);
        projection.radiance = glm::vec3(choice.radiance / std::numbers::pi);
        return projection;
    }
    const glm::dvec2 onDisk = diskPoint(place);
    const PlacedLight& placed = world.lights[static_cast<std::size_t>(map.light)];
    if (placed.light.type != LightType::directional)
        return localProjection(shadows, camera, placed, map.face, onDisk, shift);
    const Axes axes(-placed.direction);
    const double tangent = std::tan(0.5 * placed.light.angularDiameter);
    return parallelProjection(shadows, axes.z + tangent * (onDisk.x * axes.x + onDisk.y * axes.y), shift);
}

// ---- size of the shadow maps ----------------------------------------------------------------------------------------

// Returns the resolution (texels per side) that the shadow map needs at the point `seen`. At that resolution, a texel
// at the point is texelPixels times as wide as the larger of a pixel and half the blur's diameter. Returns 0 if the
// point is outside the map.
double texelsNeeded(const FramePlan& plan, const ShadowProjection& projection, int size, const SeenPoint& seen) {
    const glm::vec4 place(glm::vec3(seen.place), 1);
    const double w = glm::dot(projection.clipRows[3], place);
    const glm::dvec2 clip(glm::dot(projection.clipRows[0], place), glm::dot(projection.clipRows[1], place));
    if (!(std::max(std::abs(clip.x), std::abs(clip.y)) <= w)) return 0;
    const double pixel = 2 * plan.tanHalfHorizontal / plan.view.width * seen.depth;
    return w * projection.texel * size / (texelPixels * pixel * std::max(1.0, 0.5 * seen.blur));
}

// Returns the map size that suffices for all but a small fraction of the visible surfaces, within the limits of memory
// and time. Shaders are compiled for each size. To keep the number of sizes small, a size is rounded up to a power of
// two or 1.5 times a power of two.
int mapSize(const World& world, const FramePlan& plan, const ShadowPlan& shadows,
            const EnvironmentDirections& directions, const std::vector<std::vector<SeenPoint>>& rays) {
    const glm::dvec3 camera(plan.view.worldFromCamera[3]);
    std::vector<ShadowProjection> projections;
    for (const ShadowMap& map : shadows.maps)
        projections.push_back(mapProjection(world, camera, shadows, directions, map, glm::dvec2(0.5), glm::dvec2(0.5)));
    std::vector<double> needed;
    for (const std::vector<SeenPoint>& ray : rays)
        for (const SeenPoint& seen : ray) {
            needed.push_back(0);
            for (const ShadowProjection& projection : projections)
                needed.back() = std::max(needed.back(), texelsNeeded(plan, projection, shadows.size, seen));
        }
    const auto wanted =
        needed.begin() + static_cast<std::ptrdiff_t>(resolvedShare * static_cast<double>(needed.size() - 1));
    std::ranges::nth_element(needed, wanted);
    const double pixels = static_cast<double>(plan.view.width) * plan.view.height;
    const double ofSample = maxSampleTexels / static_cast<double>(shadows.maps.size() * shadows.points);
    const double most = std::sqrt(std::min(ofSample, std::max(minTexelLimit, 2 * pixels)));
    int size = minMapSize;
    while (size < std::min(*wanted, most)) size = size % 3 == 0 ? size / 3 * 4 : size / 2 * 3;
    return std::min(size, static_cast<int>(most));
}

// Returns the position in [0, 1)² of light point number `point` of a lens sample. The position is the same on all
// lights. The points of one sample are consecutive in the sequence, so the points of all samples together are evenly
// distributed.
glm::dvec2 lightPoint(const FramePlan& plan, const LensSample& sample, std::uint32_t point) {
    if (plan.shadows.points == 1) return glm::dvec2(sample.light);
    const std::uint64_t index = std::uint64_t{sample.index} * plan.shadows.points + point;
    return sequencePoint(plan.settings.sequence, index, plan.settings.seed).light;
}

}  // namespace

std::uint32_t maxPointsPerSample(std::size_t maps) {
    return static_cast<std::uint32_t>(std::max<std::size_t>(maxShadowMaps / std::max<std::size_t>(maps, 1), 1));
}

glm::dvec2 diskPoint(const glm::dvec2& point) {
    const glm::dvec2 at = 2.0 * point - 1.0;
    if (at == glm::dvec2(0)) return at;
    const bool wide = std::abs(at.x) > std::abs(at.y);
    const double radius = wide ? at.x : at.y;
    const double angle = std::numbers::pi / 4 * (wide ? at.y / at.x : 2 - at.x / at.y);
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

// ---- plan and projections -------------------------------------------------------------------------------------------

ShadowPlan planShadows(const World& world, const FramePlan& plan, const std::vector<ObjectPlan>& objects) {
    // Collect all shadow casters and their bounding boxes.
    ShadowPlan shadows;
    const glm::dmat4 fromView{glm::dmat3(plan.view.worldFromCamera)};
    std::vector<Bounds> boxes;
    for (const ObjectPlan& object : objects) {
        const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
        if (object.ground || pyramid.levels.front().triangleCount == 0) continue;
        const Bounds box = casterBox(world, plan, object);
        if (!finite(box)) continue;
        boxes.push_back(box);
        shadows.casters.push_back(object);
    }
    if (boxes.size() > maxBoxes) {
        Bounds all;
        for (const Bounds& box : boxes) all.extend(box);
        boxes = {all};
    }
    for (const Bounds& box : boxes)
        for (const glm::dvec3& corner : box.corners()) shadows.corners.emplace_back(fromView * glm::dvec4(corner, 1));
    if (shadows.casters.empty() || plan.objects.empty()) return {};
    const std::vector<std::vector<SeenPoint>> rays = seenPoints(plan);
    shadows.maps = chosenMaps(world, plan, shadows.corners, lightShares(world, plan, rays));
    for (ShadowMap& map : shadows.maps) {
        if (map.light == surroundings) continue;
        const Light& light = world.lights[static_cast<std::size_t>(map.light)].light;
        map.lightSize = light.type == LightType::directional ? light.angularDiameter : light.radius;
    }
    if (shadows.maps.empty()) return {};
    shadows.points = pointsFor(plan.settings, shadows.maps.size());
    shadows.seen = seenCorners(plan);

    // A map has at least as many texels across as the image has pixels, within limits.
    shadows.size = std::clamp(std::max(plan.view.width, plan.view.height), minMapSize, maxImageMapSize);
    shadows.size = std::max(shadows.size, mapSize(world, plan, shadows, environmentDirections(world), rays));
    // Casters use levels whose error is at most levelErrorTexels.
    const double texel = glm::length(boundsOfCorners(shadows.corners).size()) / shadows.size;
    const auto samples = static_cast<std::uint32_t>(plan.samples.size());
    for (ObjectPlan& caster : shadows.casters) {
        const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(caster.mesh)];
        const double scale = largestScale(caster.pose);
        const std::uint32_t level =
            plan.settings.lod == LodMode::off ? 0 : casterLevel(pyramid, scale, levelErrorTexels * texel);
        caster.coarse = {};
        caster.fine = {level, 0, samples, pyramid.levels[level].triangleCount};
        shadows.casterError = std::max(shadows.casterError, pyramid.levels[level].error * scale);
    }
    return shadows;
}

EnvironmentDirections environmentDirections(const World& world) {
    return EnvironmentDirections(world.environment, std::ranges::any_of(world.pose.objects, &Object::ground));
}

std::vector<ShadowProjection> shadowProjections(const World& world, const FramePlan& plan,
                                                const EnvironmentDirections& directions) {
    const glm::dvec3 camera(plan.view.worldFromCamera[3]);
    std::vector<ShadowProjection> projections;
    projections.reserve(plan.samples.size() * plan.shadows.points * plan.shadows.maps.size());
    for (const LensSample& sample : plan.samples)
        for (std::uint32_t point = 0; point < plan.shadows.points; ++point) {
            const glm::dvec2 place = lightPoint(plan, sample, point);
            const glm::dvec2 shift = texelShift(sample, point);
            for (const ShadowMap& map : plan.shadows.maps)
                projections.push_back(mapProjection(world, camera, plan.shadows, directions, map, place, shift));
        }
    return projections;
}

}  // namespace defocus::engine
