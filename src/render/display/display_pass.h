#pragma once
// The last step to a window: converts a linear image on the GPU to display values (exposure, tone map, sRGB).
// Optionally shows a second image beside it for comparison, and overlays with depth-of-field data. Reads no pixel back.

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
    level,  // objects by their level λ, dark violet (0) to yellow (8)
    work,   // Triangles that touch a pixel in a lens sample: black (0) to pale yellow (maxShownWork), logarithmic.
};

struct DisplaySettings {
    ToneMap toneMap = ToneMap::none;
    double exposure = 0;  // EV
    DisplayOverlay overlay = DisplayOverlay::none;
    bool focusPeaking = false;  // highlights sharp contours in the focus plane
    bool focusPlane = false;    // tints surfaces in the focus plane
    bool wireframe = false;
    double divider = 1;       // width share of the first image, 0 … 1; the rest shows the second image
    bool difference = false;  // the rest shows differenceGain · |first − second| instead
    double differenceGain = 4;

    [[nodiscard]] bool needsAovs() const {
        return overlay == DisplayOverlay::coc || overlay == DisplayOverlay::level || focusPeaking ||
               focusPlane || wireframe;
    }
};

// Textures to draw, stretched to the output. All but `first` may be null if the settings don't use them.
struct DisplayInputs {
    const GlTexture* first = nullptr;  // linear RGBA, premultiplied
    const GlTexture* second = nullptr;
    const GlTexture* coc = nullptr;  // from AovPass, like the next two
    const GlTexture* level = nullptr;
    const GlTexture* wireframe = nullptr;
    const GlTexture* work = nullptr;  // from WorkPass
    std::uint32_t workSamples = 1;    // number of lens samples in `work`
};

class DisplayPass {
public:
    explicit DisplayPass(std::filesystem::path shaderFolder = {});

    void draw(const DisplayInputs& inputs, const DisplaySettings& settings, int width, int height);
    // The output of the last draw(): display values as rgba8, row 0 at the bottom. Needs at least one draw.
    [[nodiscard]] const GlTexture& texture() const { return texture_; }

    // Returns the PSNR in dB of two images of equal size, from display values at EV 0 (as compareImages does). Infinity
    // for equal images. Reads pixels back, so it is too slow for every frame.
    [[nodiscard]] double psnr(const GlTexture& first, const GlTexture& second);

private:
    const Program& programFor(const DisplayInputs& inputs, const DisplaySettings& settings);

    std::filesystem::path shaderFolder_;
    std::map<std::string, Program> programs_;  // keyed by their defines
    Program squaredError_;
    GlTexture texture_, levelColours_, workColours_, black_;
    Target target_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
