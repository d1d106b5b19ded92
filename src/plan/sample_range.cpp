#include "plan/sample_range.h"

#include <algorithm>
#include <cassert>

namespace defocus::engine {

namespace {

LevelDraw within(const LevelDraw& draw, std::uint32_t first, std::uint32_t count) {
    const std::uint32_t begin = std::max(draw.firstSample, first);
    const std::uint32_t end = std::min(draw.firstSample + draw.sampleCount, first + count);
    LevelDraw cut = draw;
    cut.firstSample = begin < end ? begin - first : 0;
    cut.sampleCount = begin < end ? end - begin : 0;
    return cut;
}

}  // namespace

FramePlan samplesOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count) {
    assert(std::size_t{first} + count <= plan.samples.size());
    FramePlan part = plan;
    const auto begin = plan.samples.begin() + first;
    part.samples.assign(begin, begin + count);
    if (!plan.moments.empty()) part.moments.assign(plan.moments.begin() + first, plan.moments.begin() + first + count);
    part.settings.sampleCount = count;
    part.settings.firstSample += first;
    part.trianglesDrawn = trianglesDrawn(plan, first, count);
    for (ObjectPlan& object : part.objects) {
        object.coarse = within(object.coarse, first, count);
        object.fine = within(object.fine, first, count);
        // The sample that draws both levels of the object may lie outside the range.
        if (!boundarySample(object)) object.boundaryShare = 0;
    }
    return part;
}

std::uint64_t trianglesDrawn(const FramePlan& plan, std::uint32_t first, std::uint32_t count) {
    std::uint64_t triangles = 0;
    for (const ObjectPlan& object : plan.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine})
            triangles += std::uint64_t{within(draw, first, count).sampleCount} * draw.triangleCount;
    return triangles;
}

}  // namespace defocus::engine
