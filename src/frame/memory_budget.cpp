#include "frame/memory_budget.h"

#include <algorithm>

#include "core/memory_limits.h"
#include "gl/context.h"
#include "gl/device_memory.h"
#include "render/layer_format.h"
#include "render/shadow_maps.h"

namespace defocus {

namespace {

std::uint64_t threeQuarters(std::uint64_t bytes) {
    return bytes / 4 * 3;
}

std::uint64_t beyond(std::uint64_t a, std::uint64_t b) {
    return a > b ? a - b : 0;
}

}  // namespace

std::uint64_t memoryLimit(const Request& request) {
    return request.memory.value_or(residentMemory() + threeQuarters(freeMemory()));
}

std::uint64_t waveBytesWithin(std::uint64_t limit) {
    return std::min(RendererOptions{}.waveBytes, beyond(limit, residentMemory()) / 4);
}

TilingNeeds tilingNeeds(const World& world, const FramePlan& plan, const RowRange& rows, const Request& request,
                        std::uint64_t limit, std::uint64_t drawn, std::uint64_t heldByDevice) {
    TilingNeeds needs;
    needs.width = plan.view.width;
    needs.height = plan.view.height;
    needs.rows = rows;
    needs.layerPixel = layerPixelBytes(chosenLayerFormat(world, plan, request.layerFormat)) *
                       (plan.usesTransmission ? 2 : 1);  // with the backdrop
    needs.layerMaps = shadowMapBytes(plan);
    needs.waveBytes = RendererOptions{}.waveBytes;
    needs.askedWave = request.wave;
    needs.shared = currentIsSoftware();
    needs.elsewhere = beyond(residentMemory(), needs.shared ? drawn : 0);
    needs.hostMemory = beyond(limit, needs.elsewhere);
    needs.deviceMemory = needs.hostMemory;
    if (!needs.shared) {
        const std::uint64_t free = threeQuarters(freeDeviceMemory().value_or(freeMemory()) + drawn);
        needs.deviceMemory = request.memory ? std::min(free, beyond(*request.memory, heldByDevice)) : free;
    }
    needs.mayUseCells = !plan.usesTransmission;
    return needs;
}

Tile trialTile(const FramePlan& plan) {
    const PixelRectangle whole{0, 0, plan.view.width, plan.view.height};
    const PixelRectangle cell = plan.usesTransmission ? whole : cellsOf(whole.width, whole.height).front();
    return {{cell.left, cell.top, cell.width, 1}, cell};
}

std::uint64_t trialBytes(const TilingNeeds& needs, const Tile& trial) {
    const auto pixels = [](const PixelRectangle& area) {
        return static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
    };
    return pixels(trial.cell) * needs.layerPixel + needs.layerMaps + pixels(trial.area) * sumPixelBytes;
}

}  // namespace defocus
