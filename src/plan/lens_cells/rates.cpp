#include "plan/lens_cells/rates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "plan/lens_cells/contact.h"
#include "plan/lens_cells/lens_groups.h"
#include "plan/sample_range.h"
#include "plan/visible/shadows.h"

namespace defocus::engine {

namespace {

struct Run {  // range of samples or groups
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

// Returns `object` restricted to the samples of `run`.
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

// Returns the index of the block's first group among all groups of the sequence.
std::uint32_t firstGroup(const FramePlan& block, std::uint32_t groupSize) {
    return block.settings.firstSample / groupSize;
}

// Returns the samples of the group images. Over all blocks they are the first samples of the sequence, one per group.
// Objects that all groups share look as in a frame with that many samples.
std::vector<LensSample> groupImages(const FramePlan& block, std::uint32_t groupSize) {
    const auto count = static_cast<std::uint32_t>(block.samples.size());
    return lensSamples(block.view.lens, block.settings.sequence, firstGroup(block, groupSize),
                       (count + groupSize - 1) / groupSize, block.settings.seed);
}

void moveToCells(FramePlan& block, const LensCells& cells) {
    for (LensSample& sample : block.samples) {
        assert(sample.index - cells.firstSample < cells.middles.size());
        sample.lens = cells.middles[sample.index - cells.firstSample];
        sample.pixel += glm::vec2(cells.pixelShift);
    }
}

// Returns the number of groups in the block that share an object with the given share f. After n groups of the
// sequence, round(f·n) groups share it.
std::uint32_t sharedGroups(double share, const RatedBlock& block) {
    const std::uint32_t before = firstGroup(block.samples, block.groupSize);
    const auto count = static_cast<double>(block.groups.samples.size());
    return static_cast<std::uint32_t>(std::round(share * (before + count)) - std::round(share * before));
}

// Returns the draws of an object that the first `count` groups share.
ObjectPlan sharedBy(const ObjectPlan& object, std::uint32_t count, std::uint32_t groupSize) {
    const double coarseSamples = object.coarse.sampleCount - (boundarySample(object) ? 1 - object.boundaryShare : 0.0);
    const double coarse = std::min<double>(coarseSamples / groupSize, count);
    const auto whole = static_cast<std::uint32_t>(coarse);
    ObjectPlan group = object;
    group.boundaryShare = object.fine.sampleCount > 0 ? coarse - whole : 0;
    const bool divided = group.boundaryShare > 0;
    group.coarse.sampleCount = object.fine.sampleCount > 0 ? whole + (divided ? 1 : 0) : count;
    group.coarse.firstSample = 0;
    group.fine.sampleCount = object.fine.sampleCount > 0 ? count - whole : 0;
    group.fine.firstSample = group.fine.sampleCount > 0 ? whole : 0;
    return group;
}

// Divides a block's draws of an object. The first `groupCount` groups share it; the remaining samples draw it
// individually.
void divideObject(const ObjectPlan& object, std::uint32_t groupCount, RatedBlock& block) {
    const auto sampleCount = static_cast<std::uint32_t>(block.samples.samples.size());
    const std::uint32_t shared = std::min(groupCount * block.groupSize, sampleCount);
    if (groupCount > 0) block.groups.objects.push_back(sharedBy(object, groupCount, block.groupSize));
    if (shared < sampleCount) block.samples.objects.push_back(during(object, {shared, sampleCount}));
    block.groupsShare = std::max(block.groupsShare, groupCount);
}

// Returns the area where any lens sample may show the object. A margin of one pixel surrounds the reach of blur and
// pixel offsets.
PixelArea areaOf(const ObjectPlan& object, const FramePlan& plan) {
    const ContactBounds bounds = contactBounds(object, plan);
    const double margin = 0.5 * object.coc.largest + 2;
    const auto within = [](double value, int size) { return static_cast<int>(std::clamp<double>(value, 0, size)); };
    return {within(std::floor(bounds.seenMin.x - margin), plan.view.width),
            within(std::floor(bounds.seenMin.y - margin), plan.view.height),
            within(std::ceil(bounds.seenMax.x + margin), plan.view.width),
            within(std::ceil(bounds.seenMax.y + margin), plan.view.height)};
}

bool overlap(const PixelArea& a, const PixelArea& b) {
    return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

// Returns disjoint areas that contain the areas of all objects.
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
            i = 0;  // the area has grown; test all areas again
        }
        areas.push_back(area);
    }
    return areas;
}

// Returns the reason why each sample draws the object regardless of its blur; empty if it may share.
std::string reasonForFullRate(const FramePlan& plan, const ObjectPlan& object) {
    if (plan.settings.keepAll) return "everything is drawn for each sample";
    if (!plan.usesLens) return "no blur reaches half a pixel";
    if (plan.coc.chromatic > 0) return "each sample has a wavelength of its own";
    if (plan.coc.aberrates()) return "the lens has astigmatism or coma";
    if (!object.motion.empty() || !plan.middleFromView.empty()) return "it or the camera moves";
    if (object.blurMoves) return "the blur of its vertices changes";
    if (object.blended) return "it is alpha-blended";
    if (object.transmits) return "it shows what lies behind it";
    return "";
}

}  // namespace

std::uint32_t groupSamples(std::uint32_t count) {
    return std::clamp(count / minLensGroups, 1u, maxGroupSamples);
}

FrameRates frameRates(const FramePlan& plan, bool cells) {
    FrameRates rates;
    rates.objects.resize(plan.objects.size());
    if (cells) {
        rates.cells = lensCells(plan);
        const bool blurs = rates.cells.blur > 0;
        for (ObjectRates& object : rates.objects)
            object.reason = blurs ? "its images are blurred as those of lens cells" : rates.cells.reason;
        return rates;
    }
    rates.shares = true;
    std::vector<ContactBounds> bounds;
    std::vector<double> blurs;
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        const ObjectPlan& object = plan.objects[i];
        rates.objects[i].reason = reasonForFullRate(plan, object);
        bounds.push_back(contactBounds(object, plan));
        blurs.push_back(rates.objects[i].reason.empty() ? std::clamp(object.coc.largest, wholeShareBlur, minShareBlur)
                                                        : minShareBlur);
    }
    const std::vector<double> spread = spreadOverContact(bounds, blurs, wholeShareBlur, minShareBlur);
    for (std::size_t i = 0; i < spread.size(); ++i) {
        rates.objects[i].lensShare = (minShareBlur - spread[i]) / (minShareBlur - wholeShareBlur);
        if (spread[i] > blurs[i]) rates.objects[i].reason = "it lies beside what shares less";
        if (plan.objects[i].heldLensShare) rates.objects[i].lensShare = *plan.objects[i].heldLensShare;
    }
    return rates;
}

double imagesPerSample(const FramePlan& plan, const ObjectRates& rates) {
    const auto count = static_cast<std::uint32_t>(plan.samples.size());
    const std::uint32_t size = groupSamples(std::min(count, rateBlock));
    return 1 - rates.lensShare + rates.lensShare / size;
}

RatedBlock ratedBlock(const FramePlan& plan, const FrameRates& rates, std::uint32_t first, std::uint32_t count) {
    assert(first % rateBlock == 0 && count <= rateBlock && rates.objects.size() == plan.objects.size());
    RatedBlock block{samplesOf(plan, first, count), {}, 1, 0, {}};
    if (rates.cells.blur > 0) {
        moveToCells(block.samples, rates.cells);
        return block;
    }
    const std::uint32_t size = groupSamples(count);
    if (!rates.shares || plan.settings.keepAll || !plan.usesLens || size == 1) return block;

    block.groupSize = size;
    block.groups = block.samples;
    block.groups.samples = groupImages(block.samples, size);
    block.groups.settings.firstSample = firstGroup(block.samples, size);
    reorder(block.samples, groupedOrder(block.samples.samples, block.groups.samples, size));
    for (std::size_t i = 0; i < count; ++i) block.samples.samples[i].pixel = block.groups.samples[i / size].pixel;
    block.groups.moments.clear();
    block.groups.objects.clear();
    // A group's image replaces all of its samples, so it takes over their points on the lights.
    ShadowPlan& shadows = block.groups.shadows;
    shadows.points = std::min(shadows.points * size, maxPointsPerSample(shadows.maps.size()));
    const std::vector<ObjectPlan> objects = std::exchange(block.samples.objects, {});
    for (std::size_t i = 0; i < objects.size(); ++i)
        divideObject(objects[i], sharedGroups(rates.objects[i].lensShare, block), block);
    if (block.groups.objects.empty()) block.groups.samples.clear();
    block.sharedAreas = disjointAreas(block.groups);
    countTriangles(block.samples);
    countTriangles(block.groups);
    return block;
}

std::uint64_t ratedTriangles(const FramePlan& plan, const FrameRates& rates) {
    std::uint64_t triangles = 0;
    const auto total = static_cast<std::uint32_t>(plan.samples.size());
    for (std::uint32_t first = 0; first < total; first += rateBlock) {
        const RatedBlock block = ratedBlock(plan, rates, first, std::min(rateBlock, total - first));
        triangles += block.samples.trianglesDrawn + block.groups.trianglesDrawn;
    }
    return triangles;
}

}  // namespace defocus::engine
