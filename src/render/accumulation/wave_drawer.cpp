#include "render/accumulation/wave_drawer.h"

#include <algorithm>
#include <utility>

namespace defocus::engine {

WaveTargets::WaveTargets(const WaveFrame& frame) : picture(frame.layers) {
    const std::vector<Layer>& layers = frame.plan->settings.layers;
    if (!layers.empty()) data.emplace(layers, frame.countsSamples, picture);
}

WaveDrawer::WaveDrawer(const GpuScene& scene, const Occlusion& occlusion, const RendererOptions& options,
                       std::uint64_t pendingBytes)
    : scene_(&scene),
      occlusion_(&occlusion),
      geometryShaderLayers_(options.geometryShaderLayers),
      shaderFolder_(options.shaderFolder),
      pacer_(pendingBytes) {}

void WaveDrawer::prepare(const WaveFrame& frame, std::size_t targets) {
    frame_ = frame;
    const std::vector<Layer>& layers = frame.plan->settings.layers;
    const bool sameFormat =
        format_ == frame.layers.format && drawnLayers_ == layers && countsSamples_ == frame.countsSamples;
    const bool sameTargets = sameFormat && !targets_.empty() && targets_.size() == targets &&
                             targets_.front().picture.info() == frame.layers;
    if (!sameTargets) {
        targets_.clear();  // free the old layers first: there may not be enough memory for both
        targets_.reserve(targets);
        while (targets_.size() < targets) targets_.emplace_back(frame);
    }
    if (!sameFormat) makePasses(frame);
    format_ = frame.layers.format;
    drawnLayers_ = layers;
    countsSamples_ = frame.countsSamples;
    shadows_->prepare(*frame.plan, *frame.uniforms);
    surfaces_->prepare(*frame.plan, *frame.uniforms, &*shadows_);
    surfaces_->markBlended(frame.marksBlended);
}

void WaveDrawer::makePasses(const WaveFrame& frame) {
    const std::vector<Layer>& layers = frame.plan->settings.layers;
    SurfacePassInfo pass{.fragmentShader = "accumulation/object.frag",
                         .defines = layerFormatDefines(frame.layers.format),
                         .stochasticAlpha = true,
                         .vertexShaderLayers = vertexShaderMayPickLayer() && !geometryShaderLayers_,
                         .shaderFolder = shaderFolder_};
    if (!layers.empty()) {
        pass.fragmentShader = "accumulation/layers.frag";
        for (const auto& define : LensLayers::defines(layers, frame.countsSamples)) pass.defines.push_back(define);
        const bool drawsCoc = std::ranges::find(layers, Layer::coc) != layers.end();
        pass.readsOwnBlur = drawsCoc;
        pass.readsPosition = drawsCoc || std::ranges::find(layers, Layer::position) != layers.end();
        pass.writesLayers = true;
        pass.writesNumbers = LensLayers::countNumbers(layers);
    }
    shadows_.emplace(*scene_, pacer_, pass.vertexShaderLayers, pass.shaderFolder);
    surfaces_.emplace(*scene_, pacer_, pass);
}

std::uint64_t WaveDrawer::draw(std::uint32_t first, std::uint32_t count, std::size_t target,
                               WaveVisibility visibility) {
    const WaveTargets& to = targets_[target];
    std::uint64_t hidden = 0;
    if (!shadows_->defines().empty()) shadowTimer_.measure([&] { shadows_->draw(first, count); });
    opaqueTimer_.measure([&] { hidden = drawOpaque(first, count, to, visibility); });
    if (frame_.drawsSky) skyTimer_.measure([&] { drawSky(first, count, to); });
    if (surfaces_->hasTranslucent())
        translucentTimer_.measure([&] { surfaces_->drawTranslucent(first, count, to.picture.colors()); });
    WaveLayers::end();
    return hidden;
}

std::uint64_t WaveDrawer::drawOpaque(std::uint32_t first, std::uint32_t count, const WaveTargets& to,
                                     WaveVisibility& visibility) {
    to.picture.begin(frame_.window);
    if (to.data) to.data->begin();
    if (!frame_.skipsHidden) {
        surfaces_->drawOpaque(first, count);
        return 0;
    }
    const std::uint32_t layer = first % blockSamples % frame_.layers.count;
    return surfaces_->drawOpaqueVisible(first, count, to.picture.depths(), layer, *occlusion_, visibility);
}

// Draws the sky into the colour layers, but not into the data layers.
void WaveDrawer::drawSky(std::uint32_t first, std::uint32_t count, const WaveTargets& to) {
    if (to.data) to.picture.target().bind();
    surfaces_->drawSky(first, count);
    if (to.data) to.data->bind();
}

std::vector<PassTime> WaveDrawer::times() {
    std::vector<PassTime> times;
    if (!shadows_->defines().empty()) times.push_back({"shadows", shadowTimer_.milliseconds()});
    times.push_back({"opaque", opaqueTimer_.milliseconds()});
    if (frame_.drawsSky) times.push_back({"sky", skyTimer_.milliseconds()});
    if (surfaces_->hasTranslucent()) times.push_back({"translucent", translucentTimer_.milliseconds()});
    return times;
}

void WaveDrawer::resetTimes() {
    for (GpuTimer* timer : {&shadowTimer_, &opaqueTimer_, &skyTimer_, &translucentTimer_}) timer->reset();
}

std::size_t WaveDrawer::bytes() const {
    std::size_t total = shadows_->bytes() + surfaces_->bytes();
    for (const WaveTargets& target : targets_) total += target.bytes();
    return total;
}

}  // namespace defocus::engine
