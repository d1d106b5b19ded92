#include "render/tiles/memory_needs.h"

#include <algorithm>

#include "core/error.h"
#include "core/memory_limits.h"
#include "core/parallel.h"
#include "gl/context.h"
#include "gl/device_memory.h"
#include "plan/render_settings.h"
#include "render/accumulation/lens_layers.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/layer_format.h"

namespace defocus::engine {

namespace {

constexpr std::uint64_t programBytes = 80u << 20;  // memory of a software driver's compiled shaders, bytes
// Measured memory of a drawing thread in bytes: compiled shaders, and triangles that the driver has queued.
constexpr std::uint64_t contextBytes = 144u << 20;
constexpr std::uint64_t outputBytes = 16u << 20;      // measured memory in bytes of the libraries that write the image
constexpr std::uint64_t occlusionTriangleBytes = 12;  // measured bytes per triangle for the occlusion test

std::uint64_t threeQuarters(std::uint64_t bytes) {
    return bytes / 4 * 3;
}

// Returns max(a − b, 0).
std::uint64_t remainder(std::uint64_t a, std::uint64_t b) {
    return a > b ? a - b : 0;
}

// Returns the memory in bytes that the scene needs with a software driver: the plan's meshes, the scene's textures, and
// the triangles that the occlusion test stores.
std::uint64_t sceneBytes(const World& world, const FramePlan& plan) {
    std::uint64_t bytes = 0;
    for (std::size_t mesh = 0; mesh < world.pyramids.size(); ++mesh) {
        const Pyramid& pyramid = world.pyramids[mesh];
        std::uint64_t vertices = 0;
        for (std::size_t level = 0; level < pyramid.levels.size(); ++level) {
            if (!plan.levelsUsed[mesh][level]) continue;
            const PyramidLevel& own = pyramid.levels[level];
            vertices = std::max<std::uint64_t>(vertices, own.vertexCount);
            bytes += own.positions.size() * (2 * sizeof(glm::vec3)) + own.colors.size() * (2 * sizeof(glm::u16vec4)) +
                     (own.uv0.size() + own.uv1.size()) * sizeof(glm::vec2) +
                     std::uint64_t{own.triangleCount} * (3 * sizeof(std::uint32_t) + occlusionTriangleBytes);
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

// Returns the memory that the frame needs and the memory that is now available to the process. `drawn`: bytes of layers
// and accumulation buffers that will be replaced; `heldByDevice`: bytes of the scene on a GPU.
TilingNeeds currentNeeds(const World& world, const FramePlan& plan, const DrawLimits& limits, std::uint64_t limit,
                         std::uint64_t drawn = 0, std::uint64_t heldByDevice = 0) {
    TilingNeeds needs;
    needs.width = plan.view.width;
    needs.height = plan.view.height;
    needs.rows = {0, plan.view.height};
    const std::uint64_t backdropFactor = plan.usesTransmission ? 2 : 1;
    const std::vector<Layer>& data = plan.settings.layers;
    const bool counts = countsSamples(plan);
    needs.layerPixel = layerPixelBytes(chosenLayerFormat(world, limits.layerFormat)) * backdropFactor +
                       LensLayers::layerBytes(data, counts);
    needs.dataPixel = LensLayers::sumBytes(data, counts);
    needs.layerMaps = shadowMapBytes(*world.scene, plan);
    needs.waveBytes = RendererOptions{}.waveBytes;
    needs.askedWave = limits.wave;
    needs.shared = currentIsSoftware();
    needs.elsewhere = remainder(residentMemory(), needs.shared ? drawn : 0) + outputBytes;
    if (needs.shared) {
        needs.layerPixel += sizeof(float);  // copy of the depths for the occlusion test
        needs.elsewhere += std::min(plan.trianglesDrawn * pendingTriangleBytes, pendingBytesWithin(limit));
    }
    needs.layerPixel *= plan.settings.positions;
    needs.hostMemory = remainder(limit, needs.elsewhere);
    needs.deviceMemory = needs.hostMemory;
    if (!needs.shared) {
        const std::uint64_t free = threeQuarters(freeDeviceMemory().value_or(freeMemory()) + drawn);
        needs.deviceMemory = limits.memory ? std::min(free, remainder(*limits.memory, heldByDevice)) : free;
    }
    needs.mayUseCells = !plan.usesTransmission;
    return needs;
}

// Returns the bytes of the accumulation buffers of an image without tiles. If the device shares the main memory, adds
// the bytes of the images on the host.
std::uint64_t untiledBytes(const TilingNeeds& needs) {
    const std::uint64_t sums = sumPixelBytes + needs.dataPixel;
    return pixelCount(needs.width, needs.height) * (needs.shared ? sums + untiledPixelBytes + needs.dataPixel : sums);
}

// Subtracts `bytes`, the memory that the scene will take, from the available memory. Only for software drivers.
void reserve(TilingNeeds& needs, std::uint64_t bytes) {
    needs.elsewhere += bytes;
    needs.hostMemory = needs.deviceMemory = remainder(needs.hostMemory, bytes);
}

// Returns how many of `wanted` threads can draw. The first thread needs none of `bytes`. Each further thread needs a
// context and two layers (images of one sample each), and all of them must fit into half of `bytes`. `layer`: size of a
// layer in bytes.
std::uint32_t threadsIn(std::uint64_t bytes, std::uint64_t layer, std::uint32_t wanted) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, 1 + bytes / 2 / (contextBytes + 2 * layer)));
}

// Returns a tile of one row at the top of the image's first cell, the largest part with its own window coordinates
// (plan/visible/tiles.h). Drawing this tile allocates all memory that any tile needs, except the memory of the tile's
// pixels.
Tile trialTile(const FramePlan& plan) {
    const PixelRectangle frame{0, 0, plan.view.width, plan.view.height};
    const PixelRectangle cell = plan.usesTransmission ? frame : cellsOf(frame.width, frame.height).front();
    return {{cell.left, cell.top, cell.width, 1}, cell};
}

// Returns the bytes of the layer, the shadow maps and the accumulation buffers of the tile `trial`.
std::uint64_t trialBytes(const TilingNeeds& needs, const Tile& trial) {
    return pixelCount(trial.cell.width, trial.cell.height) * needs.layerPixel + needs.layerMaps +
           pixelCount(trial.area.width, trial.area.height) * sumPixelBytes;
}

}  // namespace

std::uint64_t memoryLimit(const DrawLimits& limits) {
    return limits.memory.value_or(residentMemory() + threeQuarters(freeMemory()));
}

std::uint32_t wantedThreads(const DrawLimits& limits, const Method& method) {
    if (!method.usesThreads || !drawsInThreads(currentDevice(), currentDriver())) return 1;
    // The rasterizer threads of llvmpipe share the cores with the drawing threads. On two cores, two drawing threads
    // are slower than one.
    const std::uint32_t balanced = currentIsSoftware() ? std::max(1u, availableCores() / 2) : 1;
    return limits.threads.value_or(balanced);
}

std::uint64_t waveBytesWithin(std::uint64_t limit, std::uint32_t threads) {
    return std::min(RendererOptions{}.waveBytes * threads, remainder(limit, residentMemory()) / 4);
}

std::uint32_t threadsWithin(const TilingNeeds& needs, std::uint32_t wanted) {
    const std::uint64_t layer = pixelCount(needs.width, needs.height) * needs.layerPixel + needs.layerMaps;
    return threadsIn(remainder(needs.deviceMemory, untiledBytes(needs) + layer), layer, wanted);
}

std::uint32_t threadsWithin(int width, int height, std::uint64_t limit, std::uint32_t wanted) {
    const std::uint64_t layer = pixelCount(width, height) * 2 * layerPixelBytes(LayerFormat::rgba32f);
    return threadsIn(remainder(limit, residentMemory()), layer, wanted);
}

void reserveThreads(TilingNeeds& needs, std::uint32_t threads) {
    if (needs.shared && threads > 1) reserve(needs, threads * contextBytes);
}

std::uint64_t pendingBytesWithin(std::uint64_t limit) {
    return std::min(RendererOptions{}.pendingBytes, limit / 12);
}

std::uint32_t waveWithin(const TilingNeeds& needs) {
    if (needs.askedWave > 0) return needs.askedWave;
    const std::uint64_t bytes =
        std::min({needs.waveBytes, needs.deviceMemory / 4, remainder(needs.deviceMemory, untiledBytes(needs))});
    const std::uint64_t layer = pixelCount(needs.width, needs.height) * needs.layerPixel + needs.layerMaps;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(bytes / layer, 1, blockSamples));
}

TilingNeeds needsBeforeUpload(const World& world, const FramePlan& plan, const DrawLimits& limits,
                              std::uint64_t limit) {
    TilingNeeds needs = currentNeeds(world, plan, limits, limit);
    if (!needs.shared) return needs;
    reserve(needs, programBytes + sceneBytes(world, plan));
    return needs;
}

TilingNeeds measuredNeeds(const World& world, const FramePlan& plan, const DrawLimits& limits, Renderer& renderer,
                          std::uint64_t limit) {
    const Tile trial = trialTile(plan);
    const std::uint64_t drawn = trialBytes(currentNeeds(world, plan, limits, limit), trial);
    renderer.setWave({.samples = 1});
    renderer.start(tileOf(plan, trial));
    renderer.advance();
    // Read the image before the memory is measured, because drivers may keep layers until then.
    static_cast<void>(renderer.image());
    const std::uint64_t uploaded = remainder(renderer.stats().peakBytes, drawn);
    TilingNeeds needs = currentNeeds(world, plan, limits, limit, drawn, uploaded);
    // Reserve memory for the objects outside the one-row tile drawn above, which are not yet uploaded.
    if (needs.shared) reserve(needs, remainder(sceneBytes(world, plan), uploaded));
    return needs;
}

bool surelyFits(int width, int height, bool mapsPossible, const DrawLimits& limits, std::uint64_t limit) {
    const std::uint64_t pixel = 2 * layerPixelBytes(LayerFormat::rgba32f) + sumPixelBytes + untiledPixelBytes;
    const bool oneCell = cellsOf(width, height).size() == 1;
    return !limits.memory && oneCell && !mapsPossible &&
           pixelCount(width, height) * pixel <= remainder(limit, residentMemory());
}

bool mustDrawInTiles(const World& world, const FramePlan& plan, const DrawLimits& limits, const Method& method,
                     std::uint64_t limit) {
    if (!method.needsGl || (!method.drawsTiles && !limits.memory)) return false;
    if (fitsInOnePiece(needsBeforeUpload(world, plan, limits, limit))) return false;
    if (!method.drawsTiles)
        refuseTiles(plan, limit, fmt::format("method '{}' cannot draw tiles; choose accumulation", method.name));
    return true;
}

void refuseTiles(const FramePlan& plan, std::uint64_t limit, const std::string& reason) {
    fail("an image of {} x {} px does not fit into {} of memory in one piece, and {}", plan.view.width,
         plan.view.height, bytesText(limit), reason);
}

}  // namespace defocus::engine
