#include "render/accumulation/lens_layers.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "gl/read_back.h"
#include "render/gpu_scene/surface_draws.h"

namespace defocus::engine {

namespace {

constexpr int tableEntries = 16;  // max number of objects or materials that are counted in a pixel

bool has(const std::vector<Layer>& layers, Layer layer) {
    return std::ranges::find(layers, layer) != layers.end();
}

struct Slot {
    const char* name;
    TextureFormat format;
};

struct ImageFormat {
    GLenum format;
    const char* qualifier;  // GLSL format qualifier
};

ImageFormat imageFormat(TextureFormat format) {
    if (format == TextureFormat::rg32f) return {GL_RG32F, "rg32f"};
    return format == TextureFormat::rgba16f ? ImageFormat{GL_RGBA16F, "rgba16f"} : ImageFormat{GL_RGBA32F, "rgba32f"};
}

// Returns the outputs (slots) that the data layers need, in order. They follow colour attachment 0, the image's colour.
std::vector<Slot> slotsOf(const std::vector<Layer>& layers, bool countsSamples) {
    std::vector<Slot> slots;
    const auto add = [&](bool wanted, const char* name, TextureFormat format) {
        if (wanted) slots.push_back({name, format});
    };
    const bool coc = has(layers, Layer::coc);
    // The coverage is the mean alpha of an output. The output of objects and materials, NUMBER_SLOT, has no alpha. If
    // no other layer is requested, the depth (DEPTH_SLOT) is therefore drawn, too.
    const auto isNumber = [](Layer layer) { return layer == Layer::objects || layer == Layer::materials; };
    const bool onlyNumbers = !layers.empty() && std::ranges::all_of(layers, isNumber);
    add(countsSamples || onlyNumbers || coc || has(layers, Layer::depth), "DEPTH_SLOT",
        coc ? TextureFormat::rgba32f : TextureFormat::rg32f);
    add(has(layers, Layer::position), "POSITION_SLOT", TextureFormat::rgba32f);
    add(has(layers, Layer::normal), "NORMAL_SLOT", TextureFormat::rgba16f);
    add(has(layers, Layer::albedo), "ALBEDO_SLOT", TextureFormat::rgba16f);
    add(has(layers, Layer::emission), "EMISSION_SLOT", TextureFormat::rgba32f);
    add(has(layers, Layer::motion), "MOTION_SLOT", TextureFormat::rgba32f);
    add(has(layers, Layer::objects) || has(layers, Layer::materials), "NUMBER_SLOT", TextureFormat::rgba32f);
    return slots;
}

constexpr const char* numberSlot = "NUMBER_SLOT";
constexpr const char* depthSlot = "DEPTH_SLOT";

// Returns whether the values of a slot are added up over the samples. The indices of objects and materials are counted
// in tables instead.
bool hasSum(const Slot& slot) {
    return slot.name != std::string_view(numberSlot);
}

std::vector<Layer> numberLayers(const std::vector<Layer>& layers) {
    std::vector<Layer> found;
    for (const Layer layer : {Layer::objects, Layer::materials})
        if (has(layers, layer)) found.push_back(layer);
    return found;
}

// Returns the RGBA texture `sum` plus the texture `compensation`.
Image total(Image sum, const Image& compensation) {
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += compensation.pixels[i];
    return sum;
}

Image channelOf(const Image& image, int channel) {
    Image result(image.width, image.height, 1);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = image.pixels[i * channels + static_cast<std::size_t>(channel)];
    return result;
}

// Returns `channels` channels of `sum` from channel `first` on, divided by each pixel's number of samples.
Image mean(const Image& sum, const Image& samples, int first, int channels) {
    Image result(sum.width, sum.height, channels);
    for (std::size_t i = 0; i < samples.pixels.size(); ++i)
        for (int c = 0; c < channels; ++c)
            result.pixels[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] =
                sum.pixels[4 * i + static_cast<std::size_t>(first + c)] / std::max(samples.pixels[i], 1.0f);
    return result;
}

NumberCounts readCounts(const GlTexture& table) {
    const TextureInfo& info = table.info();
    NumberCounts counts{info.width, info.height, info.layers, {}};
    const auto pixels = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height);
    std::vector<std::uint32_t> raw(pixels * static_cast<std::size_t>(info.layers));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(table.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      static_cast<GLsizei>(raw.size() * sizeof(std::uint32_t)), raw.data());
    counts.values.assign(raw.size(), 0);
    const auto width = static_cast<std::size_t>(info.width);
    const auto entries = static_cast<std::size_t>(info.layers);
    for (std::size_t y = 0; y < static_cast<std::size_t>(info.height); ++y) {
        const std::size_t row = static_cast<std::size_t>(info.height) - 1 - y;
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t e = 0; e < entries; ++e) {
                const std::uint32_t value = raw[e * pixels + row * width + x];
                if (value == 0) break;  // the first 0 ends the pixel's list; later entries are undefined
                counts.values[(y * width + x) * entries + e] = value;
            }
    }
    return counts;
}

}  // namespace

ShaderDefines LensLayers::defines(const std::vector<Layer>& layers, bool countsSamples) {
    ShaderDefines defines;
    int attachment = 1;
    for (const Slot& slot : slotsOf(layers, countsSamples))
        defines.emplace_back(slot.name, std::to_string(attachment++));
    if (has(layers, Layer::coc)) defines.emplace_back("DRAWS_COC", "");
    return defines;
}

bool countsSamples(const FramePlan& plan) {
    return plan.view.lens.catEye > 0;
}

std::uint64_t LensLayers::layerBytes(const std::vector<Layer>& layers, bool countsSamples) {
    if (layers.empty()) return 0;
    std::uint64_t bytes = 0;
    for (const Slot& slot : slotsOf(layers, countsSamples)) bytes += pixelBytes(slot.format);
    return bytes;
}

std::uint64_t LensLayers::sumBytes(const std::vector<Layer>& layers, bool countsSamples) {
    if (layers.empty()) return 0;
    const std::vector<Slot> slots = slotsOf(layers, countsSamples);
    const auto sums = static_cast<std::uint64_t>(std::ranges::count_if(slots, hasSum));
    return 2 * pixelBytes(TextureFormat::rgba32f) * sums +
           numberLayers(layers).size() * tableEntries * pixelBytes(TextureFormat::r32ui);
}

bool LensLayers::countNumbers(const std::vector<Layer>& layers) {
    return !numberLayers(layers).empty();
}

WaveDataLayers::WaveDataLayers(const std::vector<Layer>& layers, bool countsSamples, const WaveLayers& picture) {
    const WaveLayersInfo& info = picture.info();
    std::vector<const GlTexture*> colors = {&picture.colors()};
    for (const Slot& slot : slotsOf(layers, countsSamples)) {
        GlTexture& texture = textures_[slot.name];
        texture = GlTexture({.format = slot.format,
                             .width = info.width,
                             .height = info.height,
                             .layers = static_cast<int>(info.count)});
        colors.push_back(&texture);
    }
    target_ = Target(colors, &picture.depths());
}

void WaveDataLayers::begin() const {
    constexpr float transparent[4] = {};
    for (GLint i = 1; i <= static_cast<GLint>(textures_.size()); ++i)
        glClearNamedFramebufferfv(target_.name(), GL_COLOR, i, transparent);
    target_.bind();
}

std::size_t WaveDataLayers::bytes() const {
    std::size_t total = 0;
    for (const auto& [slot, texture] : textures_) total += texture.bytes();
    return total;
}

LensLayers::LensLayers(const std::vector<Layer>& layers, bool countsSamples, const glm::ivec2& size,
                       std::filesystem::path shaderFolder)
    : layers_(layers), size_(size), shaderFolder_(std::move(shaderFolder)) {
    const auto image = [&](TextureFormat format, int depth) {
        return GlTexture({.format = format, .width = size.x, .height = size.y, .layers = depth});
    };
    for (const Slot& slot : slotsOf(layers, countsSamples)) {
        if (!hasSum(slot)) continue;
        SlotSum& sum = slots_[slot.name];
        sum.sum = image(TextureFormat::rgba32f, 0);
        sum.compensation = image(TextureFormat::rgba32f, 0);
    }
    for (const Layer layer : numberLayers(layers)) tables_[layer].entries = image(TextureFormat::r32ui, tableEntries);
    unused_ = image(TextureFormat::rgba8, 0);
    sums_ = Target({&unused_});
}

const Program& LensLayers::program(const char* fragment, ShaderDefines defines) {
    const auto [entry, isNew] = programs_.try_emplace(fragment + keyOf(defines));
    if (isNew) entry->second = Program({{fullscreenShader, fragment}, std::move(defines), shaderFolder_});
    return entry->second;
}

const std::string& LensLayers::coverageSlot() const {
    return slots_.contains(depthSlot) ? slots_.find(depthSlot)->first : slots_.begin()->first;
}

void LensLayers::addSlot(const std::string& slot, const GlTexture& layers, const FrameUniforms& frame,
                         std::uint32_t first, std::uint32_t count) {
    const ImageFormat format = imageFormat(layers.info().format);
    ShaderDefines defines = frame.defines();
    defines.emplace_back("waveSamples", std::to_string(count));
    defines.emplace_back("LAYER_FORMAT", format.qualifier);
    if (slot == depthSlot || slot == coverageSlot())
        defines.emplace_back(slot == depthSlot ? "keepsNearest" : "sumsAlpha", "true");
    const Program& sum = program("accumulation/sum_layer.frag", std::move(defines));
    SlotSum& sums = slots_.at(slot);
    sums.timer.begin();
    glBindImageTexture(0, sums.sum.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(1, sums.compensation.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(2, layers.name(), 0, GL_TRUE, 0, GL_READ_ONLY, format.format);
    glProgramUniform1i(sum.name(), 1, static_cast<GLint>(samples_ % blockSamples));
    glProgramUniform1i(sum.name(), 3, samples_ == 0 ? 1 : 0);
    frame.bind(first);
    fullscreen_.draw(sum);
    sums.timer.end();
}

void LensLayers::addNumbers(Layer layer, const GlTexture& numbers, const FrameUniforms& frame, std::uint32_t first,
                            std::uint32_t count) {
    ShaderDefines defines = frame.defines();
    defines.emplace_back("tableEntries", std::to_string(tableEntries));
    const Program& counts = program("accumulation/count_numbers.frag", std::move(defines));
    Table& table = tables_.at(layer);
    table.timer.begin();
    numbers.attach(0);
    glBindImageTexture(0, table.entries.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    glProgramUniform1i(counts.name(), 0, static_cast<GLint>(count));
    glProgramUniform1i(counts.name(), 1, static_cast<GLint>(samples_ % blockSamples));
    glProgramUniform1i(counts.name(), 3, samples_ == 0 ? 1 : 0);
    glProgramUniform1i(counts.name(), 4, layer == Layer::objects ? 0 : 1);
    frame.bind(first);
    fullscreen_.draw(counts);
    table.timer.end();
}

void LensLayers::add(const WaveDataLayers& wave, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count) {
    glDisable(GL_BLEND);
    sums_.bind();
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const auto& [slot, sum] : slots_) addSlot(slot, wave.of(slot), frame, first, count);
    for (const auto& [layer, table] : tables_) addNumbers(layer, wave.of(numberSlot), frame, first, count);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    samples_ += count;
}

LayerImages LensLayers::images(const glm::dvec3& camera) const {
    LayerImages result;
    std::map<std::string, Image> sums;
    // Channels of the depth layer's sum: depth, coverage, CoC, nearest depth. The compensation texture contains the
    // rounding errors of the first three sums; its last channel is the number of samples (sum_layer.frag).
    result.samples = Image(size_.x, size_.y, 1);
    std::ranges::fill(result.samples.pixels, static_cast<float>(samples_));
    for (const auto& [slot, sum] : slots_)
        if (slot != depthSlot) sums[slot] = total(readBack(sum.sum, 4), readBack(sum.compensation, 4));
    if (const auto depth = slots_.find(depthSlot); depth != slots_.end()) {
        const Image sum = readBack(depth->second.sum, 4);
        const Image lost = readBack(depth->second.compensation, 4);
        sums[depthSlot] = total(sum, lost);
        result.samples = channelOf(lost, 3);
        if (has(layers_, Layer::depth)) result.nearestDepth = channelOf(sum, 3);
    }
    const std::string& slot = coverageSlot();
    result.coverage = mean(sums.at(slot), result.samples, slot == depthSlot ? 1 : 3, 1);
    const auto take = [&](Layer layer, const char* slot, int first, int channels) {
        if (has(layers_, layer)) result.means[layer] = mean(sums.at(slot), result.samples, first, channels);
    };
    take(Layer::depth, depthSlot, 0, 1);
    take(Layer::coc, depthSlot, 2, 1);
    take(Layer::position, "POSITION_SLOT", 0, 3);
    take(Layer::normal, "NORMAL_SLOT", 0, 3);
    take(Layer::albedo, "ALBEDO_SLOT", 0, 3);
    take(Layer::emission, "EMISSION_SLOT", 0, 3);
    take(Layer::motion, "MOTION_SLOT", 0, 2);
    if (const auto position = result.means.find(Layer::position); position != result.means.end())
        for (std::size_t i = 0; i < result.coverage.pixels.size(); ++i)
            for (glm::length_t c = 0; c < 3; ++c)
                position->second.pixels[3 * i + static_cast<std::size_t>(c)] +=
                    static_cast<float>(camera[c] * static_cast<double>(result.coverage.pixels[i]));
    for (const auto& [layer, table] : tables_) result.numbers[layer] = readCounts(table.entries);
    return result;
}

std::vector<PassTime> LensLayers::times() {
    std::vector<PassTime> times;
    for (auto& [slot, sum] : slots_) times.push_back({"sum of " + slot, sum.timer.milliseconds()});
    for (auto& [layer, table] : tables_)
        times.push_back(
            {layer == Layer::objects ? "count of objects" : "count of materials", table.timer.milliseconds()});
    return times;
}

std::size_t LensLayers::bytes() const {
    std::size_t total = unused_.bytes();
    for (const auto& [slot, sum] : slots_) total += sum.sum.bytes() + sum.compensation.bytes();
    for (const auto& [layer, table] : tables_) total += table.entries.bytes();
    return total;
}

}  // namespace defocus::engine
