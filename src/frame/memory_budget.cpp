#include "frame/memory_budget.h"

#include <algorithm>

#include "core/memory_limits.h"
#include "gl/context.h"
#include "gl/device_memory.h"
#include "render/frame_uniforms.h"
#include "render/layer_format.h"
#include "render/shadow_maps.h"

namespace defocus {

namespace {

// What a software driver takes: its programs, once it draws, and what it keeps of each triangle until a layer is done.
constexpr std::uint64_t programBytes = 80u << 20;
constexpr std::uint64_t binnedTriangleBytes = 96;
constexpr std::uint64_t mostBinnedBytes = 256u << 20;

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

std::uint32_t waveWithin(const TilingNeeds& needs) {
    if (needs.askedWave > 0) return needs.askedWave;
    const std::uint64_t pixels = std::uint64_t(needs.width) * std::uint64_t(needs.height);
    const std::uint64_t others = pixels * (sumPixelBytes + (needs.shared ? wholePixelBytes : 0));
    const std::uint64_t bytes = std::min({needs.waveBytes, needs.deviceMemory / 4, beyond(needs.deviceMemory, others)});
    const std::uint64_t layer = pixels * needs.layerPixel + needs.layerMaps;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(bytes / layer, 1, blockSamples));
}

std::uint64_t bytesToUpload(const World& world, const FramePlan& plan) {
    std::uint64_t bytes = programBytes;
    for (std::size_t mesh = 0; mesh < world.pyramids.size(); ++mesh) {
        const Pyramid& pyramid = world.pyramids[mesh];
        std::uint64_t vertices = 0;
        for (std::size_t level = 0; level < pyramid.levels.size(); ++level) {
            if (!plan.levelsUsed[mesh][level]) continue;
            const PyramidLevel& own = pyramid.levels[level];
            vertices = std::max<std::uint64_t>(vertices, own.vertexCount);
            bytes += own.positions.size() * (2 * sizeof(glm::vec3)) + own.colors.size() * (2 * sizeof(glm::u16vec4)) +
                     (own.uv0.size() + own.uv1.size()) * sizeof(glm::vec2) +
                     std::uint64_t{own.triangleCount} * 3 * sizeof(std::uint32_t);
        }
        const Mesh& source = world.scene->meshes[mesh];
        bytes += vertices * ((source.vertices.tangents.empty() ? 0 : sizeof(glm::vec4)) +
                             (source.vertices.blurs.empty() ? 0 : sizeof(VertexBlur)));
        for (const MorphTarget& morph : source.morphTargets)
            bytes += (morph.positions.size() + morph.normals.size() + morph.tangents.size()) * sizeof(glm::vec3);
    }
    for (const Texture& texture : world.scene->textures)
        if (texture.image >= 0) {
            const TextureImage& image = world.scene->images[static_cast<std::size_t>(texture.image)];
            bytes += image.rgba.size() / 3 * (texture.mipmaps ? 4 : 3);
        }
    return bytes;
}

TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const Request& request, std::uint64_t limit) {
    TilingNeeds needs = tilingNeeds(world, plan, {0, plan.view.height}, request, limit);
    if (!needs.shared) return needs;
    const std::uint64_t upload = bytesToUpload(world, plan);
    needs.elsewhere += upload;
    needs.hostMemory = needs.deviceMemory = beyond(needs.hostMemory, upload);
    return needs;
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
    if (needs.shared) {
        needs.layerPixel += sizeof(float);  // a copy of the depths, which say what is hidden
        needs.layerMaps += std::min(
            plan.trianglesDrawn / std::max<std::size_t>(plan.samples.size(), 1) * binnedTriangleBytes, mostBinnedBytes);
    }
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
