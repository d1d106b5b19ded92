// Sources: Haeberli and Akeley 1990, The Accumulation Buffer (soft shadows); Williams 1978, Casting Curved Shadows on
// Curved Surfaces; Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square.
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

namespace defocus::engine {

namespace {

constexpr int minMapSize = 128;  // px
constexpr int maxMapSize = 2048;
constexpr double minShare = 0.01;           // lights below this fraction of all light cast no shadow
constexpr double widestTangent = 3;         // max tan of half a map's field of view
constexpr double levelErrorTexels = 0.5;    // texels, max simplification error of a caster
constexpr std::size_t maxBoxes = 64;        // with more casters, a single box bounds them all
constexpr double nearShare = 1e-4;          // near plane of point and spot lights, relative to the scene's size
constexpr std::uint32_t smoothPoints = 64;  // points on a light that hide the steps of a penumbra

const glm::dvec3 luminanceWeights(0.2126, 0.7152, 0.0722);

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

// Returns the bounding box of the object over all moments, in the view space of the middle of the exposure.
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

// Returns the illuminance by a light, in lux, weighted over colours by luminance. `middle` is the centre of the
// casters. Their bounding radius `radius` (m) is the min distance.
double strength(const PlacedLight& placed, const glm::dvec3& middle, double radius) {
    const double brightness = placed.light.intensity * glm::dot(glm::dvec3(placed.light.color), luminanceWeights);
    if (placed.light.type == LightType::directional) return brightness;
    const double distance = std::max(glm::distance(placed.position, middle), std::max(radius, 1e-9));
    return brightness / (distance * distance);
}

// Returns true if a single shadow map can contain everything that a point or spot light illuminates.
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

struct Candidate {
    int light = 0;
    double strength = 0;
    int faces = 1;
};

std::vector<Candidate> candidates(const World& world, const FramePlan& plan, const std::vector<glm::dvec3>& corners) {
    const glm::dvec3 camera(plan.view.worldFromCamera[3]);
    const Bounds bounds = boundsOfCorners(corners);
    const double radius = 0.5 * glm::length(bounds.size());
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < world.lights.size(); ++i) {
        const PlacedLight& placed = world.lights[i];
        const bool far = placed.light.type == LightType::directional;
        found.push_back({static_cast<int>(i), strength(placed, bounds.centre() + camera, radius),
                         far || oneMapShows(placed, placed.position - camera, corners) ? 1 : 6});
    }
    const Environment& environment = world.environment;
    const EnvironmentDirections directions(environment);
    if (!directions.empty() && environment.lighting > 0) {
        const EnvironmentDirections::Choice choice = directions.at({0.5, 0.5});
        found.push_back({surroundings, glm::dot(choice.radiance, luminanceWeights) * environment.lighting / 4, 1});
    }
    return found;
}

// Returns the maps of the strongest lights that fit into maxShadowMaps, in the order of the lights.
std::vector<ShadowMap> chosenMaps(std::vector<Candidate> found) {
    std::ranges::stable_sort(found, std::greater<>(), &Candidate::strength);
    const double all = std::accumulate(found.begin(), found.end(), 0.0,
                                       [](double sum, const Candidate& one) { return sum + one.strength; });
    std::size_t count = 0;
    std::vector<Candidate> chosen;
    for (const Candidate& one : found) {
        if (!(one.strength >= minShare * all) || !(one.strength > 0) || !std::isfinite(one.strength)) continue;
        if (count + static_cast<std::size_t>(one.faces) > maxShadowMaps) continue;
        count += static_cast<std::size_t>(one.faces);
        chosen.push_back(one);
    }
    std::ranges::sort(chosen, {}, &Candidate::light);
    std::vector<ShadowMap> maps;
    for (const Candidate& one : chosen)
        for (int face = 0; face < one.faces; ++face)
            maps.push_back({.light = one.light, .face = one.faces > 1 ? face : -1});
    return maps;
}

// Returns the number of points on each light per sample. A penumbra has as many steps as there are points in total, so
// frames with few samples use several points per sample. The number of samples includes all earlier samples of the
// frame.
std::uint32_t pointsFor(const RenderSettings& settings, std::size_t maps) {
    const std::uint64_t samples = std::uint64_t{settings.firstSample} + settings.sampleCount;
    const std::uint64_t wanted = (smoothPoints + samples - 1) / std::max<std::uint64_t>(samples, 1);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, maxPointsPerSample(maps)));
}

// ---- projections ----------------------------------------------------------------------------------------------------

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

ShadowProjection parallelProjection(const FramePlan& plan, const glm::dvec3& toLight,
                                    const std::vector<glm::dvec3>& seen, const glm::dvec2& shift) {
    const Axes axes(toLight);
    Rectangle area;
    double nearest = -std::numeric_limits<double>::infinity();
    double farthest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : plan.shadows.corners) {
        const glm::dvec3 place = axes.of(corner);
        area.extend(glm::dvec2(place));
        nearest = std::max(nearest, place.z);
        farthest = std::min(farthest, place.z);
    }
    Rectangle visible;
    for (const glm::dvec3& corner : seen) visible.extend(glm::dvec2(axes.of(corner)));
    if (!seen.empty()) area.intersect(visible);
    const double diagonal = glm::length(boundsOfCorners(plan.shadows.corners).size());
    const double margin = 1e-3 * diagonal;
    const double depth = nearest - farthest + 2 * margin;
    ShadowProjection projection;
    projection.toLight = glm::vec3(axes.z);
    projection.clipRows[2] = glm::vec4(axes.z / depth, (margin - farthest) / depth);
    projection.clipRows[3] = glm::vec4(0, 0, 0, 1);
    setRows(projection, axes, glm::dvec3(0), area, plan.shadows.size, shift, 1e-6 * diagonal);
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

ShadowProjection localProjection(const FramePlan& plan, const PlacedLight& placed, int face, const glm::dvec2& point,
                                 const std::vector<glm::dvec3>& seen, const glm::dvec2& shift) {
    const Bounds bounds = boundsOfCorners(plan.shadows.corners);
    const double diagonal = glm::length(bounds.size());
    const glm::dvec3 centre = placed.position - glm::dvec3(plan.view.worldFromCamera[3]);
    const bool spot = placed.light.type == LightType::spot && face < 0;
    const Axes disk(spot ? placed.direction : bounds.centre() - centre + glm::dvec3(0, 1e-12, 0));
    const glm::dvec3 origin = centre + double{placed.light.radius} * (point.x * disk.x + point.y * disk.y);
    // Geometry closer than the lamp's diameter casts no shadow, because it may be the lamp's own glass.
    const double nearest = std::max(nearShare * diagonal, 2.0 * placed.light.radius);

    const Axes axes(face >= 0 ? faceDirection(face) : spot ? placed.direction : bounds.centre() - origin);
    Rectangle area;
    if (face >= 0 || spot) {
        const double tangent =
            face >= 0 ? 1 + 4.0 / plan.shadows.size : 1.02 * std::tan(double{placed.light.outerConeAngle});
        area.extend(glm::dvec2(-tangent));
        area.extend(glm::dvec2(tangent));
    }
    const auto casters = inFront(axes, origin, plan.shadows.corners, nearest);
    if (face < 0 && casters) {
        if (spot)
            area.intersect(*casters);
        else
            area = *casters;
    }
    if (face < 0 && !seen.empty())
        if (const auto visible = inFront(axes, origin, seen, nearest)) area.intersect(*visible);
    ShadowProjection projection;
    projection.clipRows[2] = glm::vec4(0, 0, 0, nearest);
    projection.clipRows[3] = glm::vec4(axes.z, -glm::dot(axes.z, origin));
    setRows(projection, axes, origin, area, plan.shadows.size, shift, 1e-6);
    return projection;
}

// Returns the position in [0, 1)² of a sample's `point` on the lights. The points of one sample are consecutive in the
// sequence. The points of all samples together are therefore evenly distributed.
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

// ---- surroundings ---------------------------------------------------------------------------------------------------

namespace {

constexpr int gridColumns = 64;
constexpr int gridRows = 32;

glm::dvec3 gridDirection(double u, double v) {
    const double polar = std::numbers::pi * v;
    const double azimuth = 2 * std::numbers::pi * (u - 0.5);
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// Returns the mean radiance of the environment map's pixels in a grid cell, or the radiance of one pixel if cells are
// smaller than pixels.
glm::dvec3 meanRadiance(const Image& map, int column, int row) {
    const auto pixel = [&](int x, int y) {
        const float* value = map.at(std::min(x, map.width - 1), std::min(y, map.height - 1));
        glm::dvec3 color(value[0], value[map.channels >= 3 ? 1 : 0], value[map.channels >= 3 ? 2 : 0]);
        for (int c = 0; c < 3; ++c) color[c] = std::min(std::max(0.0, std::isnan(color[c]) ? 0.0 : color[c]), 65504.0);
        return color;
    };
    const int left = column * map.width / gridColumns,
              right = std::max(left + 1, (column + 1) * map.width / gridColumns);
    const int top = row * map.height / gridRows, bottom = std::max(top + 1, (row + 1) * map.height / gridRows);
    glm::dvec3 sum(0);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) sum += pixel(x, y);
    return sum / (static_cast<double>(right - left) * (bottom - top));
}

glm::dvec3 cellRadiance(const Environment& environment, int column, int row) {
    if (environment.type == EnvironmentType::map) return meanRadiance(*environment.map, column, row);
    if (environment.type == EnvironmentType::uniform) return glm::dvec3(environment.zenith);
    const double height = std::cos(std::numbers::pi * (row + 0.5) / gridRows);
    const glm::dvec3 pole(height > 0 ? environment.zenith : environment.nadir);
    return glm::mix(glm::dvec3(environment.horizon), pole, std::abs(height));
}

// Inverts cumulative sums. Returns the index of the interval that contains `place`, a fraction of the last sum, and the
// position [0, 1] inside the interval.
std::pair<std::size_t, double> inverted(std::span<const double> sums, double place) {
    const double target = place * sums.back();
    const auto found = std::ranges::upper_bound(sums, target);
    const auto index = std::min(static_cast<std::size_t>(found - sums.begin()), sums.size() - 1);
    const double before = index > 0 ? sums[index - 1] : 0;
    const double width = sums[index] - before;
    return {index, width > 0 ? std::clamp((target - before) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

EnvironmentDirections::EnvironmentDirections(const Environment& environment) {
    if (environment.type == EnvironmentType::none) return;
    double all = 0;
    for (int row = 0; row < gridRows; ++row) {
        const double solidAngle =
            2 * std::numbers::pi / gridColumns *
            (std::cos(std::numbers::pi * row / gridRows) - std::cos(std::numbers::pi * (row + 1) / gridRows));
        double inRow = 0;
        for (int column = 0; column < gridColumns; ++column) {
            radiances_.push_back(cellRadiance(environment, column, row));
            inRow += glm::dot(radiances_.back(), luminanceWeights) * solidAngle;
            cellSums_.push_back(inRow);
        }
        all += inRow;
        rowSums_.push_back(all);
    }
}

EnvironmentDirections::Choice EnvironmentDirections::at(const glm::dvec2& point) const {
    const auto [row, down] = inverted(rowSums_, point.y);
    const auto cells = std::span(cellSums_).subspan(row * gridColumns, gridColumns);
    const auto [column, across] = inverted(cells, point.x);
    // Points at uniform heights on the unit sphere cover the cell's solid angle uniformly.
    const double top = std::cos(std::numbers::pi * static_cast<double>(row) / gridRows);
    const double bottom = std::cos(std::numbers::pi * (static_cast<double>(row) + 1) / gridRows);
    const double polar = std::acos(std::clamp(glm::mix(top, bottom, down), -1.0, 1.0));
    const glm::dvec3& radiance = radiances_[row * gridColumns + column];
    const double luminance = glm::dot(radiance, luminanceWeights);
    return {gridDirection((static_cast<double>(column) + across) / gridColumns, polar / std::numbers::pi),
            luminance > 0 ? radiance * (rowSums_.back() / luminance) : glm::dvec3(0)};
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
    shadows.maps = chosenMaps(candidates(world, plan, shadows.corners));
    for (ShadowMap& map : shadows.maps) {
        if (map.light == surroundings) continue;
        const Light& light = world.lights[static_cast<std::size_t>(map.light)].light;
        map.lightSize = light.type == LightType::directional ? light.angularDiameter : light.radius;
    }
    if (shadows.maps.empty()) return {};
    shadows.points = pointsFor(plan.settings, shadows.maps.size());
    shadows.seen = seenCorners(plan);

    // The map has as many texels across the scene as the image has pixels. Casters use levels whose error is at most
    // levelErrorTexels.
    shadows.size = std::clamp(std::max(plan.view.width, plan.view.height), minMapSize, maxMapSize);
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

std::vector<ShadowProjection> shadowProjections(const World& world, const FramePlan& plan,
                                                const EnvironmentDirections& directions) {
    const std::vector<glm::dvec3>& seen = plan.shadows.seen;
    std::vector<ShadowProjection> projections;
    projections.reserve(plan.samples.size() * plan.shadows.points * plan.shadows.maps.size());
    for (const LensSample& sample : plan.samples)
        for (std::uint32_t point = 0; point < plan.shadows.points; ++point) {
            const glm::dvec2 place = lightPoint(plan, sample, point);
            const glm::dvec2 onDisk = diskPoint(place);
            const glm::dvec2 shift = texelShift(sample, point);
            for (const ShadowMap& map : plan.shadows.maps) {
                if (map.light == surroundings) {
                    const EnvironmentDirections::Choice choice = directions.at(place);
                    projections.push_back(parallelProjection(plan, choice.toLight, seen, shift));
                    projections.back().radiance = glm::vec3(choice.radiance / std::numbers::pi);
                    continue;
                }
                const PlacedLight& placed = world.lights[static_cast<std::size_t>(map.light)];
                if (placed.light.type != LightType::directional) {
                    projections.push_back(localProjection(plan, placed, map.face, onDisk, seen, shift));
                    continue;
                }
                const Axes axes(-placed.direction);
                const double tangent = std::tan(0.5 * placed.light.angularDiameter);
                projections.push_back(
                    parallelProjection(plan, axes.z + tangent * (onDisk.x * axes.x + onDisk.y * axes.y), seen, shift));
            }
        }
    return projections;
}

}  // namespace defocus::engine
