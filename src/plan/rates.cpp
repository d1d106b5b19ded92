#include "plan/rates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "plan/lens_groups.h"
#include "plan/sample_range.h"

namespace defocus {

namespace {

struct Run {  // of samples or groups
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    [[nodiscard]] bool empty() const { return begin >= end; }
};

LevelDraw during(const LevelDraw& draw, const Run& run) {
    const std::uint32_t begin = std::max(draw.firstSample, run.begin);
    const std::uint32_t end = std::min(draw.firstSample + draw.sampleCount, run.end);
    LevelDraw cut = draw;
    cut.firstSample = begin < end ? begin : 0;
    cut.sampleCount = begin < end ? end - begin : 0;
    return cut;
}

// `object` in the samples of `run` alone.
ObjectPlan during(const ObjectPlan& object, const Run& run) {
    ObjectPlan cut = object;
    cut.coarse = during(object.coarse, run);
    cut.fine = during(object.fine, run);
    if (!boundarySample(cut)) cut.boundaryShare = 0;
    return cut;
}

void countTriangles(FramePlan& plan) {
    plan.trianglesDrawn = 0;
    for (const ObjectPlan& object : plan.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine})
            plan.trianglesDrawn += std::uint64_t{draw.triangleCount} * draw.sampleCount;
}

void reorder(FramePlan& block, const std::vector<std::uint32_t>& order) {
    const std::vector<LensSample> samples = block.samples;
    const std::vector<SampleMoment> moments = block.moments;
    for (std::size_t i = 0; i < order.size(); ++i) {
        block.samples[i] = samples[order[i]];
        if (!moments.empty()) block.moments[i] = moments[order[i]];
    }
}

// The number of the block's first group among all groups of the sequence.
std::uint32_t firstGroup(const FramePlan& block, std::uint32_t groupSize) {
    return block.settings.firstSample / groupSize;
}

// The groups' images: over all blocks they are the first samples of the sequence, as many as there are groups. What
// all groups share is drawn as a frame of so many samples would draw it.
std::vector<LensSample> groupImages(const FramePlan& block, std::uint32_t groupSize) {
    const auto count = static_cast<std::uint32_t>(block.samples.size());
    return lensSamples(block.view.lens, block.settings.sequence, firstGroup(block, groupSize),
                       (count + groupSize - 1) / groupSize, block.settings.seed);
}

// How many of the block's groups share an object, whose share is `share`: round(f·n) after n groups.
std::uint32_t sharedGroups(double share, const RatedBlock& block) {
    const std::uint32_t before = firstGroup(block.samples, block.groupSize);
    const auto count = static_cast<double>(block.groups.samples.size());
    return static_cast<std::uint32_t>(std::round(share * (before + count)) - std::round(share * before));
}

// Divides what a block draws of an object, which the first `groupCount` groups share, between its groups and its
// samples.
void divideObject(const ObjectPlan& object, std::uint32_t groupCount, RatedBlock& block) {
    const std::uint32_t size = block.groupSize;
    const auto sampleCount = static_cast<std::uint32_t>(block.samples.samples.size());
    const std::uint32_t shared = std::min(groupCount * size, sampleCount);
    const auto drawnBy = [](LevelDraw draw, const Run& run) {
        draw.firstSample = run.empty() ? 0 : run.begin;
        draw.sampleCount = run.empty() ? 0 : run.end - run.begin;
        return draw;
    };

    // Groups before `divided` draw the coarser level, and those after it the finer one. The samples of a group that
    // don't all draw the same level draw the object themselves.
    std::uint32_t divided = object.coarse.sampleCount > 0 ? groupCount : 0;
    std::uint32_t firstFine = divided;
    if (object.coarse.sampleCount > 0 && object.fine.sampleCount > 0) {
        const bool within = object.fine.firstSample % size != 0 || boundarySample(object);
        divided = std::min(object.fine.firstSample / size, groupCount);
        firstFine = std::min(divided + (within ? 1 : 0), groupCount);
    }
    ObjectPlan group = object;
    group.boundaryShare = 0;
    group.coarse = drawnBy(object.coarse, {0, divided});
    group.fine = drawnBy(object.fine, {firstFine, groupCount});
    std::fill_n(block.groupDraws.begin(), divided, true);
    std::fill(block.groupDraws.begin() + firstFine, block.groupDraws.begin() + groupCount, true);
    if (group.coarse.sampleCount + group.fine.sampleCount > 0) block.groups.objects.push_back(std::move(group));

    Run within{divided * size, std::min(firstFine * size, shared)};
    Run after{shared, sampleCount};
    if (!within.empty() && within.end == after.begin) after.begin = std::exchange(within, {}).begin;
    for (const Run& run : {within, after})
        if (!run.empty()) block.samples.objects.push_back(during(object, run));
}

// Where any lens sample may show the object; a pixel more on all sides than its blur and the pixel offsets reach.
PixelArea areaOf(const ObjectPlan& object, const FramePlan& plan) {
    const double pixelsPerTangent = plan.view.width / (2 * plan.tanHalfHorizontal);
    const glm::dvec2 middle(plan.view.width / 2.0, plan.view.height / 2.0);
    glm::dvec2 least(std::numeric_limits<double>::infinity());
    glm::dvec2 most = -least;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1 ? object.viewBox.maximum.x : object.viewBox.minimum.x,
                            corner & 2 ? object.viewBox.maximum.y : object.viewBox.minimum.y,
                            corner & 4 ? object.viewBox.maximum.z : object.viewBox.minimum.z);
        const glm::dvec2 place = middle + glm::dvec2(at) / -at.z * pixelsPerTangent;
        least = glm::min(least, place);
        most = glm::max(most, place);
    }
    const double margin = 0.5 * object.coc.largest + 2;
    const auto within = [](double value, int size) { return static_cast<int>(std::clamp<double>(value, 0, size)); };
    return {within(std::floor(least.x - margin), plan.view.width),
            within(std::floor(least.y - margin), plan.view.height), within(std::ceil(most.x + margin), plan.view.width),
            within(std::ceil(most.y + margin), plan.view.height)};
}

bool overlap(const PixelArea& a, const PixelArea& b) {
    return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

// Areas that hold those of all objects and don't overlap.
std::vector<PixelArea> disjointAreas(const FramePlan& plan) {
    std::vector<PixelArea> areas;
    for (const ObjectPlan& object : plan.objects) {
        PixelArea area = areaOf(object, plan);
        if (area.pixels() == 0) continue;
        for (std::size_t i = 0; i < areas.size();) {
            if (!overlap(area, areas[i])) {
                ++i;
                continue;
            }
            area = {std::min(area.left, areas[i].left), std::min(area.bottom, areas[i].bottom),
                    std::max(area.right, areas[i].right), std::max(area.top, areas[i].top)};
            areas.erase(areas.begin() + static_cast<std::ptrdiff_t>(i));
            i = 0;  // it has grown
        }
        areas.push_back(area);
    }
    return areas;
}

}  // namespace

std::uint32_t groupSamples(std::uint32_t count) {
    return std::clamp(count / leastLensGroups, 1u, mostGroupSamples);
}

LensRate lensRate(const FramePlan& plan, const ObjectPlan& object) {
    if (plan.settings.keepAll) return {0, "everything is drawn for each sample"};
    if (!plan.usesLens) return {0, "no blur reaches half a pixel"};
    if (plan.coc.chromatic > 0) return {0, "each sample has a wavelength of its own"};
    if (!object.motion.empty() || !plan.middleFromView.empty()) return {0, "it or the camera moves"};
    if (object.blended) return {0, "it is alpha-blended"};
    const double share = (leastShareBlur - object.coc.largest) / (leastShareBlur - wholeShareBlur);
    return {std::clamp(share, 0.0, 1.0), ""};
}

RatedBlock ratedBlock(const FramePlan& plan, std::uint32_t first, std::uint32_t count) {
    assert(first % rateBlock == 0 && count <= rateBlock);
    RatedBlock block{samplesOf(plan, first, count), {}, 1, {}, {}};
    const std::uint32_t size = groupSamples(count);
    if (plan.settings.keepAll || !plan.usesLens || size == 1) return block;

    block.groupSize = size;
    block.groups = block.samples;
    block.groups.samples = groupImages(block.samples, size);
    reorder(block.samples, groupedOrder(block.samples.samples, block.groups.samples, size));
    block.groups.moments.clear();
    block.groups.objects.clear();
    block.groupDraws.assign(block.groups.samples.size(), false);
    const std::vector<ObjectPlan> objects = std::exchange(block.samples.objects, {});
    for (const ObjectPlan& object : objects) {
        divideObject(object, sharedGroups(lensRate(plan, object).share, block), block);
    }
    if (block.groups.objects.empty()) {
        block.groups.samples.clear();
        block.groupDraws.clear();
    }
    block.sharedAreas = disjointAreas(block.groups);
    countTriangles(block.samples);
    countTriangles(block.groups);
    return block;
}

std::uint64_t ratedTriangles(const FramePlan& plan) {
    std::uint64_t triangles = 0;
    const auto total = static_cast<std::uint32_t>(plan.samples.size());
    for (std::uint32_t first = 0; first < total; first += rateBlock) {
        const RatedBlock block = ratedBlock(plan, first, std::min(rateBlock, total - first));
        triangles += block.samples.trianglesDrawn + block.groups.trianglesDrawn;
    }
    return triangles;
}

}  // namespace defocus
