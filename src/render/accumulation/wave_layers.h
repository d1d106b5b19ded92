#pragma once
// Render target of a batch (wave) of K lens samples: K layers of colours and depths, one per sample.

#include <cstdint>
#include <optional>

#include "gl/target.h"
#include "render/gpu_scene/layer_window.h"
#include "render/layer_format.h"

namespace defocus::engine {

struct WaveLayersInfo {
    int width = 1;  // width of the layers in px
    int height = 1;
    std::uint32_t count = 1;                    // number of layers, 1 … 64
    LayerFormat format = LayerFormat::rgba16f;  // format of the layers; not LayerFormat::automatic
    bool operator==(const WaveLayersInfo&) const = default;
};

class WaveLayers {
public:
    explicit WaveLayers(const WaveLayersInfo& info);

    // Clears the layers to transparent black and infinite depth, and binds them as the render target. `window`: the
    // only rectangle that is drawn; nullopt: all pixels.
    void begin(const std::optional<LayerWindow>& window = {}) const;
    // Disables the scissor test, by which begin() restricts drawing to a rectangle.
    static void end();
    [[nodiscard]] const Target& target() const { return target_; }
    [[nodiscard]] const GlTexture& colors() const { return colors_; }
    [[nodiscard]] const GlTexture& depths() const { return depths_; }
    [[nodiscard]] const WaveLayersInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const { return colors_.bytes() + depths_.bytes(); }

private:
    WaveLayersInfo info_;
    GlTexture colors_;
    GlTexture depths_;
    Target target_;
};

}  // namespace defocus::engine
