#pragma once
// Draws batches (waves) of lens samples in one OpenGL context. Owns the layers, each the image of one sample, and all
// OpenGL objects that contexts cannot share.

#include <filesystem>
#include <optional>
#include <vector>

#include "gl/timer.h"
#include "render/accumulation/lens_layers.h"
#include "render/accumulation/wave_layers.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/methods.h"

namespace defocus::engine {

// Inputs that all batches (waves) of a frame share. `plan` and `uniforms` must exist until the last batch is drawn.
struct WaveFrame {
    const FramePlan* plan = nullptr;
    const FrameUniforms* uniforms = nullptr;
    WaveLayersInfo layers;
    std::optional<LayerWindow> window;  // rectangle of each layer that is drawn; nullopt: all pixels
    bool skipsHidden = false;
    bool countsSamples = false;  // true: the number of samples differs between pixels
    bool marksBlended = false;   // true: alpha above 1 marks blended surfaces; see SurfacePass::markBlended
    bool drawsSky = false;       // true: the environment is drawn into the layers
};

// Layers of one batch (wave) of samples. `data` is set only if RenderSettings::layers names data layers.
struct WaveTargets {
    explicit WaveTargets(const WaveFrame& frame);
    [[nodiscard]] std::size_t bytes() const { return picture.bytes() + (data ? data->bytes() : 0); }

    WaveLayers picture;
    std::optional<WaveDataLayers> data;
};

class WaveDrawer {
public:
    // `scene` and `occlusion` must outlive this object. `pendingBytes`: see SubmissionPacer.
    WaveDrawer(const GpuScene& scene, const Occlusion& occlusion, const RendererOptions& options,
               std::uint64_t pendingBytes);

    // Prepares a frame's shader programs and draw calls, and the layers of `targets` batches (waves) of samples. The
    // plan's data must be in the scene's buffers and textures.
    void prepare(const WaveFrame& frame, std::size_t targets);
    // Returns the draw calls for Occlusion::prepare, which must be called before draw() if hidden triangles are
    // skipped.
    [[nodiscard]] std::vector<OccludableDraw> opaqueDraws() const { return surfaces_->opaqueDraws(); }
    // Draws samples [first, first + count) into the set of layers with index `target`. Returns the number of hidden
    // triangles that were skipped.
    std::uint64_t draw(std::uint32_t first, std::uint32_t count, std::size_t target, WaveVisibility visibility);
    void freeTargets() { targets_.clear(); }
    [[nodiscard]] const WaveTargets& target(std::size_t index) const { return targets_[index]; }
    // Returns GPU times of the frame's passes. Waits for the GPU.
    [[nodiscard]] std::vector<PassTime> times();
    [[nodiscard]] std::size_t bytes() const;  // graphics memory in bytes; needs a prepared frame
    void resetTimes();

private:
    void makePasses(const WaveFrame& frame);
    std::uint64_t drawOpaque(std::uint32_t first, std::uint32_t count, const WaveTargets& to,
                             WaveVisibility& visibility);
    void drawSky(std::uint32_t first, std::uint32_t count, const WaveTargets& to);

    const GpuScene* scene_;
    const Occlusion* occlusion_;
    bool geometryShaderLayers_;
    std::filesystem::path shaderFolder_;
    SubmissionPacer pacer_;
    WaveFrame frame_;
    // Settings for which the passes and the layers were made.
    LayerFormat format_ = LayerFormat::automatic;
    std::vector<Layer> drawnLayers_;
    bool countsSamples_ = false;
    std::vector<WaveTargets> targets_;
    std::optional<ShadowMaps> shadows_;
    std::optional<SurfacePass> surfaces_;
    GpuTimer shadowTimer_, opaqueTimer_, skyTimer_, translucentTimer_;
};

}  // namespace defocus::engine
