#pragma once
// The last pass before a window: converts a linear image on the GPU to display values (exposure, tone map, sRGB).
// Optionally draws a second image beside the first for comparison, and overlays of depth-of-field data. Reads no pixels
// back.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "image/tone_map.h"

namespace defocus::engine {

enum class DisplayOverlay {
    none,
    coc,    // circle of confusion: orange in front of the focus plane, blue behind
    level,  // level of detail λ of objects, dark violet (0) to yellow (8)
    work,   // triangles per pixel and lens sample: black (0) to pale yellow (maxShownWork), logarithmic
};

struct DisplaySettings {
    ToneMap toneMap = ToneMap::none;
    double exposure = 0;  // EV
    DisplayOverlay overlay = DisplayOverlay::none;
    bool focusPeaking = false;  // true: highlights sharp edges near the focus plane
    bool focusPlane = false;    // true: tints surfaces near the focus plane
    bool wireframe = false;
    double divider = 1;       // fraction of the width for the first image, 0 … 1; the second image fills the rest
    bool difference = false;  // true: the second image is replaced by differenceGain · |first − second|
    double differenceGain = 4;
    bool operator==(const DisplaySettings&) const = default;

    [[nodiscard]] bool needsAovs() const {
        return overlay == DisplayOverlay::coc || overlay == DisplayOverlay::level || focusPeaking || focusPlane ||
               wireframe;
    }
};

// Textures to draw, stretched to the output. All except `first` may be null if the settings do not use them.
struct DisplayInputs {
    const GlTexture* first = nullptr;  // the only or left image, linear premultiplied RGBA
    const GlTexture* second = nullptr;
    const GlTexture* coc = nullptr;  // `coc`, `level` and `wireframe` are from AovPass
    const GlTexture* level = nullptr;
    const GlTexture* wireframe = nullptr;
    const GlTexture* work = nullptr;  // triangles per pixel, summed over lens samples; from WorkPass
    std::uint32_t workSamples = 1;    // number of lens samples summed in `work`
};

class DisplayPass {
public:
    explicit DisplayPass(std::filesystem::path shaderFolder = {});

    void draw(const DisplayInputs& inputs, const DisplaySettings& settings, int width, int height);
    // Returns the output of the latest draw(): display values as rgba8, row 0 at the bottom. Needs at least one draw().
    [[nodiscard]] const GlTexture& texture() const { return texture_; }

    // Returns the PSNR in dB of two images of equal size; +∞ for equal images. As in compareImages, it is computed from
    // display values at EV 0. Waits for the GPU, so it is too slow for every frame.
    [[nodiscard]] double psnr(const GlTexture& first, const GlTexture& second);

private:
    const Program& programFor(const DisplayInputs& inputs, const DisplaySettings& settings);

    std::filesystem::path shaderFolder_;
    std::map<std::string, Program> programs_;  // key: keyOf() of the defines
    Program squaredError_;
    GlTexture texture_, levelColours_, workColours_, black_;
    Target target_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
