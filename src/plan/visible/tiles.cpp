#include "plan/visible/tiles.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "plan/frame_plan.h"
#include "plan/visible/visibility.h"

namespace defocus::engine {

namespace {

int cellSide(int pixels) {
    const int cells = (pixels + maxCellPixels - 1) / maxCellPixels;
    return (pixels + cells - 1) / cells;
}

// Removes the objects for which `isKept` returns false from the plan's objects and from its blend order.
void keepObjects(FramePlan& plan, const auto& isKept) {
    std::vector<std::optional<std::uint32_t>> newIndex(plan.objects.size());
    std::vector<ObjectPlan> kept;
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        if (!isKept(plan.objects[i])) continue;
        newIndex[i] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(plan.objects[i]));
    }
    plan.objects = std::move(kept);
    std::erase_if(plan.blendOrder, [&](const BlendRun& run) { return !newIndex[run.object]; });
    for (BlendRun& run : plan.blendOrder) run.object = *newIndex[run.object];
}

}  // namespace

std::vector<PixelRectangle> cellsOf(int width, int height) {
    const int across = cellSide(width);
    const int down = cellSide(height);
    std::vector<PixelRectangle> cells;
    for (int top = 0; top < height; top += down)
        for (int left = 0; left < width; left += across)
            cells.push_back({left, top, std::min(across, width - left), std::min(down, height - top)});
    return cells;
}

RowRange rowsOfPart(int height, int index, int count) {
    assert(index >= 0 && index < count && count <= height);
    const auto border = [&](int part) { return static_cast<int>(std::int64_t{height} * part / count); };
    return {border(index), border(index + 1)};
}

FramePlan tileOf(const FramePlan& plan, const Tile& tile) {
    FramePlan part = plan;
    part.tile = tile;
    if (plan.settings.keepAll || plan.usesTransmission) return part;
    keepObjects(part, [&](const ObjectPlan& object) {
        return !outsideWidenedFrustum(object.viewBox, plan, object.own, object.coc.largest, tile.area);
    });
    part.trianglesDrawn = 0;
    for (const ObjectPlan& object : part.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine})
            part.trianglesDrawn += std::uint64_t{draw.triangleCount} * draw.sampleCount;
    return part;
}

}  // namespace defocus::engine
