// Plans a frame. Source: Jeong, Kim and Lee 2011, Multi-Resolution Depth-of-Field Rendering (selection of levels from
// blur and projected size).

#include "plan/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "lod/pyramid/blurred_error.h"
#include "plan/lens_cells/blurred_patches.h"
#include "plan/motion/motion.h"
#include "plan/motion/object_pose.h"
#include "plan/visible/blend_order.h"
#include "plan/visible/shadows.h"
#include "plan/visible/visibility.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

void checkRequest(const View& view, const RenderSettings& settings) {
    checkLens(view.lens);
    if (view.width < 1 || view.height < 1 || view.width > maxImageSide || view.height > maxImageSide)
        fail("image size {} x {}: each side must be 1 to {} px", view.width, view.height, maxImageSide);
    if (settings.sampleCount < 1 || settings.sampleCount > maxSamples)
        fail("{} samples: choose 1 to {}", settings.sampleCount, maxSamples);
    if (settings.positions != 1 && settings.positions != 4)
        fail("{} subpixel positions per lens sample are not supported; choose 1 or 4 (--positions)",
             settings.positions);
    if (settings.positions > 1 && !settings.layers.empty())
        fail("data layers (--exr-layers) need one subpixel position per lens sample; give --positions 1");
    if (!(view.nearPlane > 0)) fail("the near plane must be above 0 m, not {}", view.nearPlane);
    if (!(settings.cocTolerance > 0)) fail("--coc-tolerance must be above 0 px, not {}", settings.cocTolerance);
    const LodThresholds thresholds =
        chosenThresholds(settings.thresholds, settings.metric, std::max(positionCount(settings), 1u));
    if (!(thresholds.blur >= 0) || !(thresholds.size >= 0) || !(thresholds.light >= 0))
        fail("--blur-threshold, --size-threshold and --light-threshold must be at least 0");
    const LodMetric metric = chosenMetric(settings.metric, settings.thresholds);
    const bool measured = metric == LodMetric::measured;
    if ((metric == LodMetric::score || metric == LodMetric::proportional) && settings.thresholds.size)
        fail("--lod-metric {} cannot be combined with --size-threshold; give --blur-threshold instead",
             lodMetricName(metric));
    if (measured ? settings.thresholds.blur || settings.thresholds.size : settings.thresholds.light.has_value())
        fail("--lod-metric {} accepts only {}", lodMetricName(metric),
             measured ? "--light-threshold" : "--blur-threshold and --size-threshold");
}

bool transmits(const Scene& scene, const Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [&](const Primitive& primitive) { return materialAt(scene, primitive.material).transmits(); });
}

bool hasTextures(const Scene& scene, const Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& primitive) {
        const auto uses = textureUses(materialAt(scene, primitive.material));
        return std::any_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->used(); });
    });
}

// Returns a plan of the object with its pose, bounding box, depths and blur, but without chosen levels.
ObjectPlan placedObject(const World& world, const FramePlan& plan, std::size_t index, const glm::dmat4& viewFromWorld) {
    const Object& object = world.pose.objects[index];
    ObjectPlan result;
    result.object = static_cast<int>(index);
    result.mesh = object.mesh;
    result.name = object.name;
    result.ground = object.ground;
    result.viewFromObject = viewFromWorld * object.worldFromObject;
    result.pose = objectPose(object, viewFromWorld);
    result.skinned = object.skinned();
    result.motion = objectMotion(world, plan.view, index, result.pose);
    result.deformed = deformed(object) || std::any_of(result.motion.begin(), result.motion.end(), morphs);
    result.mirrored = mirrors(result.pose);
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    Bounds& box = result.viewBox;
    if (result.motion.empty()) box = posedBox(pyramid, result.pose, result.skinned);
    for (const ObjectPose& pose : result.motion) box.extend(posedBox(pyramid, pose, result.skinned));
    if (box.empty()) return result;
    result.nearestDepth = -box.maximum.z;
    result.farthestDepth = -box.minimum.z;
    const VertexBlurBounds& blurs = world.scene->meshes[static_cast<std::size_t>(object.mesh)].blurBounds;
    result.cocScale = object.cocScale;
    result.own = ownBlur(plan.coc, object.cocScale, blurs);
    result.blurMoves = blurs.moves && shutterIsOpen(world, plan.view);
    if (result.nearestDepth > plan.view.nearPlane) {
        const CocBox cocBox = cocBoxOf(result.viewBox, result.own, plan);
        result.coc = circleOfConfusionRange(plan.coc, cocBox, plan.view.width);
        result.coc.smallest = smallestCoc(plan, cocBox);
    } else {
        result.coc = {std::numeric_limits<double>::infinity(), 0, 0, std::numeric_limits<double>::infinity()};
    }
    return result;
}

double selectedLevel(const Pyramid& pyramid, const ObjectPlan& object, const FramePlan& plan) {
    if (plan.settings.lod == LodMode::off || object.nearestDepth <= plan.view.nearPlane) return 0;
    if (plan.settings.metric == LodMetric::measured)
        return levelOfBlurredError(pyramid, blurredPatches(object, plan), pixelsPerUnitAtCentre(object, plan),
                                   plan.thresholds.light);
    LevelQuery query;
    const double centre = -object.viewBox.centre().z;
    const double depth = plan.settings.metric == LodMetric::score ? centre : object.nearestDepth;
    // Projected size in px of a length of 1 m at a depth of 1 m.
    const double pixelsAtUnitDepth = plan.view.width / (2 * plan.tanHalfHorizontal);
    query.pixelsPerUnit = largestScale(object.pose) * pixelsAtUnitDepth / depth;
    const glm::dvec3 box = object.viewBox.size();
    query.boxSize = std::max(box.x, box.y) * pixelsAtUnitDepth / centre;
    query.coc = plan.settings.lodCoc == LodCoc::centre ? cocAtCentre(object, plan) : object.coc.smallest;
    LodThresholds thresholds = plan.thresholds;
    if (plan.settings.lodCause == LodCause::size) thresholds.blur = 0;
    if (plan.settings.lodCause == LodCause::blur) thresholds.size = 0;
    return levelOfDetail(pyramid, query, plan.settings.metric, thresholds);
}

// Chooses the fractional level λ, the two adjacent levels, and the samples that draw each level.
void chooseLevels(ObjectPlan& object, const Pyramid& pyramid, const FramePlan& plan) {
    const auto sampleCount = static_cast<std::uint32_t>(plan.samples.size());
    if (object.nearestDepth > 0)
        object.projectedEdge = pyramid.levels.front().meanEdge * largestScale(object.pose) * plan.view.width /
                               (2 * plan.tanHalfHorizontal * object.nearestDepth);
    object.lambda = selectedLevel(pyramid, object, plan);
    const SampleSplit split = splitSamples(object.lambda, sampleCount, plan.settings.lod);
    const auto last = static_cast<std::uint32_t>(pyramid.levels.size() - 1);
    const auto draw = [&](std::uint32_t level, std::uint32_t first, std::uint32_t count) {
        level = std::min(level, last);
        return LevelDraw{level, first, count, pyramid.levels[level].triangleCount};
    };
    object.boundaryShare = split.level < last ? split.boundaryShare : 0;
    object.coarse = draw(split.level + 1, 0, split.coarseCount + (object.boundaryShare > 0 ? 1 : 0));
    object.fine = draw(split.level, split.coarseCount, sampleCount - split.coarseCount);
}

// Chooses how the triangles of the drawn levels are divided. Inside each part, linear interpolation of the clip-space
// blur (CoC · depth) then has an error of at most RenderSettings::cocTolerance.
void chooseRefinement(ObjectPlan& object, const World& world, const FramePlan& plan) {
    if (!plan.usesCocControls) return;
    if (object.nearestDepth <= plan.view.nearPlane) {
        object.cocDeviation = {std::numeric_limits<double>::infinity(),
                               plan.coc.varies() ? std::numeric_limits<double>::infinity() : 0};
    } else {
        const auto mesh = static_cast<std::size_t>(object.mesh);
        const Pyramid& pyramid = world.pyramids[mesh];
        double longest = 0;
        for (const LevelDraw& draw : {object.coarse, object.fine})
            if (draw.sampleCount > 0) longest = std::max(longest, pyramid.levels[draw.level].longestEdge);
        const CocBox box = cocBoxOf(object.viewBox, object.own, plan);
        object.cocDeviation =
            cocDeviation(plan.coc, box, longest * largestScale(object.pose),
                         plan.tanHalfHorizontal * glm::dvec2(1, 1 / plan.coc.aspect), plan.view.width);
    }
    object.cuts = object.cocDeviation.kinks > 0;
    if (object.cocDeviation.kinks > plan.settings.cocTolerance) object.refinement = Refinement::split;
    if (object.cocDeviation.curved > plan.settings.cocTolerance) object.refinement = Refinement::subdivide;
}

// Approximate max number of small triangles that all objects together are divided into, per lens sample.
constexpr double maxSmallTriangles = 4e6;

// Returns the approximate number of small triangles into which the triangles of the object's drawn levels are divided,
// with at most `maxParts` parts per edge. The number of parts of an edge is proportional to its length; most triangles
// have edges of the mean length. For objects that reach the near plane, the interpolation error of the blur has no
// bound. Few of their triangles are near enough to need more than 8 parts per edge, so 8 parts are assumed for all.
double smallTriangles(const ObjectPlan& object, const World& world, const FramePlan& plan, double maxParts) {
    constexpr double partsNearby = 8;
    const bool bounded = std::isfinite(object.cocDeviation.curved);
    const double needed = bounded ? std::sqrt(object.cocDeviation.curved / plan.settings.cocTolerance) : partsNearby;
    double count = 0;
    for (const LevelDraw& draw : {object.coarse, object.fine}) {
        if (draw.sampleCount == 0) continue;
        const PyramidLevel& level = world.pyramids[static_cast<std::size_t>(object.mesh)].levels[draw.level];
        const bool varied = bounded && level.longestEdge > 0;
        const double share = varied ? std::min(1.0, level.meanEdge / level.longestEdge) : 1;
        const double parts = std::clamp(needed * share, 1.0, maxParts);
        count = std::max(count, draw.triangleCount * parts * parts);
    }
    return count;
}

// Limits the subdivision of objects whose blur varies nonlinearly inside triangles (Refinement::subdivide), so that a
// lens sample has at most maxSmallTriangles small triangles.
void boundDivisions(FramePlan& plan, const World& world) {
    const auto fits = [&](std::uint32_t parts) {
        double count = 0;
        for (const ObjectPlan& object : plan.objects)
            if (object.refinement == Refinement::subdivide) count += smallTriangles(object, world, plan, parts);
        return count <= maxSmallTriangles;
    };
    std::uint32_t parts = maxEdgeParts;
    while (parts > 1 && !fits(parts)) parts /= 2;
    for (ObjectPlan& object : plan.objects) object.maxParts = parts;
}

// Returns why the object need not be drawn; empty if the object must be drawn.
std::string reasonToLeaveOut(const World& world, const FramePlan& plan, const ObjectPlan& object) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    if (pyramid.levels.front().triangleCount == 0) return "it has no triangles";
    if (outsideWidenedFrustum(object.viewBox, plan, object.own, object.coc.largest))
        return "it is outside the image for all lens samples";
    return "";
}

// Reorders the values in place, so that values[order[i]] moves to values[i]. Follows the cycles of the permutation.
void arrange(std::vector<ObjectPlan>& values, std::vector<std::size_t> order) {
    for (std::size_t begin = 0; begin < order.size(); ++begin) {
        if (order[begin] == begin) continue;
        ObjectPlan first = std::move(values[begin]);
        std::size_t place = begin;
        std::size_t from = std::exchange(order[place], place);
        while (from != begin) {
            values[place] = std::move(values[from]);
            place = from;
            from = std::exchange(order[place], place);
        }
        values[place] = std::move(first);
    }
}

// Adds the potentially visible objects to the plan, nearest first, so that near objects occlude farther objects early.
// Returns the invisible objects if RenderSettings::keepAll is set, else none. If `all` isn't null, it receives all
// objects in the order of World::pose.
std::vector<ObjectPlan> placeObjects(FramePlan& plan, const World& world, std::vector<ObjectPlan>* all) {
    const glm::dmat4 viewFromWorld = glm::inverse(plan.view.worldFromCamera);
    std::vector<ObjectPlan>& objects = plan.objects;
    objects.resize(world.pose.objects.size());
    std::vector<std::string> reasons(objects.size());
    parallelFor(objects.size(), [&](std::size_t i) {
        objects[i] = placedObject(world, plan, i, viewFromWorld);
        reasons[i] = reasonToLeaveOut(world, plan, objects[i]);
    });
    if (all != nullptr) *all = objects;
    std::vector<ObjectPlan> unseen;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(objects[i].mesh)];
        if (!reasons[i].empty() && plan.settings.keepAll && pyramid.levels.front().triangleCount > 0) {
            unseen.push_back(std::move(objects[i]));
            continue;
        }
        if (!reasons[i].empty()) {
            plan.leftOut.push_back({"object " + objects[i].name, std::move(reasons[i])});
            continue;
        }
        if (order.size() < i) objects[order.size()] = std::move(objects[i]);
        order.push_back(order.size());
    }
    objects.resize(order.size());
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return objects[i].nearestDepth; });
    arrange(objects, std::move(order));
    return unseen;
}

// Returns the largest CoC in px of all drawn objects. The background counts as an object if it is visible and its
// colour varies.
double largestBlur(const FramePlan& plan, const World& world) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects) largest = std::max(largest, object.coc.largest);
    const EnvironmentType type = world.environment.type;
    if (!plan.needsAlpha && (type == EnvironmentType::gradient || type == EnvironmentType::map))
        largest = std::max(largest, largestCocAtInfinity(plan.coc, plan.view.width));
    return largest;
}

// Replaces the lens by a pinhole if no blur is visible.
void leaveOutLens(FramePlan& plan, const World& world) {
    plan.largestBlur = largestBlur(plan, world);
    plan.usesLens = plan.settings.keepAll || plan.settings.refocus || plan.largestBlur >= minBlur;
    if (plan.usesLens) return;
    const double aspect = plan.coc.aspect;  // not reset: it belongs to the image, not to the lens
    plan.coc = {};
    plan.coc.aspect = aspect;
    plan.apertureDiameter = 0;
    for (LensSample& sample : plan.samples) sample.lens = glm::vec2(0);
    for (ObjectPlan& object : plan.objects) {
        object.coc = {};
        object.own = {};
    }
}

// Reduces the number of samples of a frame without visible blur to those that antialiasing needs. Keeps all samples if
// motion, shadows or stochastic transparency need them.
void leaveOutSamples(FramePlan& plan) {
    if (plan.usesLens) return;
    const bool stochastic = std::ranges::any_of(plan.blendOrder, &BlendRun::stochastic);
    const bool still = plan.moments.empty() && plan.shadows.maps.empty() && !stochastic;
    const std::uint32_t kept =
        still ? std::min(plan.settings.sampleCount, antialiasingSamples) : plan.settings.sampleCount;
    plan.leftOut.push_back(
        {"lens samples",
         fmt::format("no blur reaches half a pixel (maximum {:.2g} px), so {} samples are drawn only for {}",
                     plan.largestBlur, kept,
                     still                   ? "antialiasing"
                     : !plan.moments.empty() ? "motion"
                     : stochastic            ? "transparency"
                                             : "shadows")});
    plan.samples.resize(kept);
    plan.frameSamples = plan.frameFirst + kept;
}

bool hasOwnBlur(const FramePlan& plan, const World& world) {
    return std::any_of(plan.objects.begin(), plan.objects.end(), [&](const ObjectPlan& object) {
        const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
        return object.cocScale != 1 || mesh.blurBounds != VertexBlurBounds{};
    });
}

// Returns true if the frame's objects cast shadows. By default, they do so only in scenes with a ground plane.
bool drawsShadows(const World& world, const RenderSettings& settings) {
    return settings.shadows == Shadows::on ||
           (settings.shadows == Shadows::automatic && std::ranges::any_of(world.pose.objects, &Object::ground));
}

void noteUnusedPaths(FramePlan& plan, const World& world) {
    const Scene& scene = *world.scene;
    for (ObjectPlan& object : plan.objects) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        object.transmits = transmits(scene, mesh);
        plan.usesBlending |= object.blended;
        plan.usesTransmission |= object.transmits;
        plan.usesTextures |= hasTextures(scene, mesh);
    }
    for (const BlendRun& run : plan.blendOrder) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(plan.objects[run.object].mesh)];
        plan.sortsBlending |=
            !run.stochastic && !materialAt(scene, mesh.primitives[run.primitive].material).transmits();
    }
    if (plan.settings.lod == LodMode::off)
        plan.leftOut.push_back({"levels of detail", "the image is drawn at full detail (--lod)"});
    if (!plan.usesTextures) plan.leftOut.push_back({"texture path", "no drawn material has a texture"});
    if (!plan.usesBlending) plan.leftOut.push_back({"blend path", "no drawn material is alpha-blended"});
    if (!plan.usesTransmission) plan.leftOut.push_back({"transmission path", "no drawn material transmits light"});
    if (!plan.usesCocControls)
        plan.leftOut.push_back(
            {"blur controls",
             "neither the lens nor an object has blur controls, so the blur function is C(w) = a + b·w"});
    if (plan.shadows.maps.empty())
        plan.leftOut.push_back({"shadow maps", drawsShadows(world, plan.settings)
                                                   ? "no object casts a visible shadow"
                                                   : "shadows are off (--shadows, --ground)"});
    if (plan.moments.empty()) plan.leftOut.push_back({"motion path", "nothing moves while the shutter is open"});
}

// Appends objects that no lens sample sees. Called last, so that these objects affect no other decision of the plan.
// Omits their transmissive primitives: each transmissive object needs a copy of the image behind it, and only the
// nearest eight get one.
void addUnseen(FramePlan& plan, const World& world, std::vector<ObjectPlan> unseen) {
    const std::uint32_t maxParts = plan.objects.empty() ? 1 : plan.objects.front().maxParts;
    for (ObjectPlan& object : unseen) {
        const auto mesh = static_cast<std::size_t>(object.mesh);
        if (plan.moments.empty()) {
            object.motion.clear();
            object.blurMoves = false;
        }
        chooseLevels(object, world.pyramids[mesh], plan);
        chooseRefinement(object, world, plan);
        object.maxParts = maxParts;
        object.coc = {};  // an unseen object must not raise the maximum CoC that renderers use
        const std::vector<Primitive>& primitives = world.scene->meshes[mesh].primitives;
        for (std::uint32_t p = 0; p < primitives.size(); ++p) {
            const Material& material = materialAt(*world.scene, primitives[p].material);
            if (material.alphaMode == AlphaMode::blend && !material.transmits())
                plan.blendOrder.insert(plan.blendOrder.begin(),
                                       {static_cast<std::uint32_t>(plan.objects.size()), p, 0, {}, true});
        }
        plan.objects.push_back(std::move(object));
    }
}

void noteLevels(FramePlan& plan, const World& world) {
    std::uint64_t kept = 0;
    std::uint64_t all = 0;
    std::uint64_t whole = 0;
    plan.levelsUsed.resize(world.pyramids.size());
    for (std::size_t mesh = 0; mesh < world.pyramids.size(); ++mesh) {
        plan.levelsUsed[mesh].assign(world.pyramids[mesh].levels.size(), plan.settings.keepAll);
        all += world.pyramids[mesh].levels.size();
    }
    for (const ObjectPlan& object : plan.objects) {
        auto& used = plan.levelsUsed[static_cast<std::size_t>(object.mesh)];
        for (const LevelDraw& draw : {object.coarse, object.fine}) {
            if (draw.sampleCount > 0) used[draw.level] = true;
            plan.trianglesDrawn += std::uint64_t{draw.triangleCount} * draw.sampleCount;
            const VisibleLevel* visible = visibleLevel(object, draw.level);
            if (visible == nullptr) continue;
            plan.trianglesFacingAway += std::uint64_t{visible->facingAway} * draw.sampleCount;
            plan.trianglesOutside += std::uint64_t{visible->outside} * draw.sampleCount;
        }
        plan.trianglesAtFullDetail +=
            std::uint64_t{world.pyramids[static_cast<std::size_t>(object.mesh)].levels[0].triangleCount} *
            plan.samples.size();
        whole += object.coarse.sampleCount == 0 ? 1 : 0;
    }
    for (const ObjectPlan& caster : plan.shadows.casters)
        plan.levelsUsed[static_cast<std::size_t>(caster.mesh)][caster.fine.level] = true;
    for (const auto& used : plan.levelsUsed)
        kept += static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));
    if (kept < all)
        plan.leftOut.push_back(
            {fmt::format("{} of {} pyramid levels", all - kept, all), "no sample of this frame uses them"});
    if (plan.trianglesFacingAway > 0)
        plan.leftOut.push_back({fmt::format("{} triangles, summed over all samples", plan.trianglesFacingAway),
                                "their clusters face away from the whole lens"});
    if (plan.trianglesOutside > 0)
        plan.leftOut.push_back({fmt::format("{} triangles, summed over all samples", plan.trianglesOutside),
                                "their clusters are outside the image for all lens samples"});
    const LodMode mode = plan.settings.lod;
    if (whole > 0 && (mode == LodMode::fractional || mode == LodMode::continuous))
        plan.leftOut.push_back({fmt::format("sample split of {} object{}", whole, whole == 1 ? "" : "s"),
                                "each has an integer level, which all samples draw"});
}

}  // namespace

FramePlan withoutObjects(FramePlan plan) {
    plan.objects.clear();
    plan.blendOrder.clear();
    plan.shadows = {};
    return plan;
}

const VisibleLevel* visibleLevel(const ObjectPlan& object, std::uint32_t level) {
    const auto found = std::find_if(object.visible.begin(), object.visible.end(),
                                    [&](const VisibleLevel& visible) { return visible.level == level; });
    return found == object.visible.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> boundarySample(const ObjectPlan& object) {
    const std::uint32_t coarseEnd = object.coarse.firstSample + object.coarse.sampleCount;
    if (object.coarse.sampleCount == 0 || object.fine.sampleCount == 0 || coarseEnd <= object.fine.firstSample)
        return {};
    return object.fine.firstSample;
}

FramePlan planFrame(const World& world, const View& view, const RenderSettings& settings) {
    checkRequest(view, settings);
    checkShutter(world, view, settings);
    FramePlan plan;
    plan.view = view;
    plan.settings = settings;
    plan.settings.metric = chosenMetric(settings.metric, settings.thresholds);
    plan.thresholds = chosenThresholds(settings.thresholds, settings.metric, positionCount(settings));
    plan.tanHalfHorizontal = tanHalfHorizontalFov(view.lens);
    plan.apertureDiameter = apertureDiameter(view.lens);
    plan.coc = clipCircleOfConfusion(view.lens, view.width, view.height);
    plan.needsAlpha = world.environment.type == EnvironmentType::none || !world.environment.visible;
    plan.showsMap = !plan.needsAlpha && world.environment.type == EnvironmentType::map;
    if (plan.needsAlpha && view.lens.dofEnabled && view.lens.catEye > 0)
        fail(
            "lens: cat's-eye bokeh (--cat-eye) cannot be combined with a transparent background; leave one of them "
            "out");
    plan.samples = lensSamples(view.lens, settings.sequence, settings.firstSample, settings.sampleCount, settings.seed);
    // Each lens sample renders a grid of positions in a pixel. The jitter therefore spans one grid cell instead of a
    // pixel.
    for (LensSample& sample : plan.samples) sample.pixel /= static_cast<float>(positionsPerAxis(settings));
    plan.frameFirst = settings.firstSample;
    plan.frameSamples = settings.firstSample + settings.sampleCount;

    const bool shadows = drawsShadows(world, settings);
    std::vector<ObjectPlan> mayCast;
    std::vector<ObjectPlan> unseen = placeObjects(plan, world, shadows ? &mayCast : nullptr);
    planMoments(plan, world, mayCast);
    if (shadows) plan.shadows = planShadows(world, plan, mayCast);

    leaveOutLens(plan, world);
    plan.usesOwnBlur = plan.usesLens && hasOwnBlur(plan, world);
    plan.usesCocControls = plan.usesLens && (plan.usesOwnBlur || !plan.coc.thinLens());
    const auto chooseAllLevels = [&] {
        parallelFor(plan.objects.size(), [&](std::size_t i) {
            ObjectPlan& object = plan.objects[i];
            chooseLevels(object, world.pyramids[static_cast<std::size_t>(object.mesh)], plan);
        });
    };
    chooseAllLevels();
    chooseBlending(plan, world);
    leaveOutSamples(plan);
    if (plan.samples.size() < settings.sampleCount) chooseAllLevels();  // splits the remaining samples
    parallelFor(plan.objects.size(), [&](std::size_t i) {
        ObjectPlan& object = plan.objects[i];
        chooseRefinement(object, world, plan);
        if (!settings.keepAll) leaveOutClusters(object, world, plan);
    });
    if (plan.usesCocControls) boundDivisions(plan, world);
    noteUnusedPaths(plan, world);
    addUnseen(plan, world, std::move(unseen));
    noteLevels(plan, world);
    return plan;
}

}  // namespace defocus::engine
