#pragma once
// The last step to a window: a linear image on the GPU becomes display values (exposure, tone map, sRGB), beside a
// second image where two are compared, with overlays that say why it looks as it does. No pixel is read back.

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
    rate,   // objects by the images that a lens sample takes (method multirate), dark violet (1) to yellow (1/4)
    work,   // triangles that touch a pixel in a lens sample: black (none) to pale yellow (mostShownWork), logarithmic
};

struct DisplaySettings {
    ToneMap toneMap = ToneMap::none;
    double exposure = 0;  // EV
    DisplayOverlay overlay = DisplayOverlay::none;
    bool focusPeaking = false;  // marks sharp contours that are in focus
    bool focusPlane = false;    // tints what is in focus
    bool wireframe = false;
    double divider = 1;       // share of the width that shows the first image; the rest shows the second
    bool difference = false;  // the rest shows differenceGain · |first − second| instead
    double differenceGain = 4;

    [[nodiscard]] bool needsAovs() const {
        return overlay == DisplayOverlay::coc || overlay == DisplayOverlay::level || overlay == DisplayOverlay::rate ||
               focusPeaking || focusPlane || wireframe;
    }
};

// What is drawn; all but `first` may be null where the settings don't need them. Textures are stretched to the output.
struct DisplayInputs {
    const GlTexture* first = nullptr;  // linear RGBA, premultiplied
    const GlTexture* second = nullptr;
    const GlTexture* coc = nullptr;  // of AovPass
    const GlTexture* level = nullptr;
    const GlTexture* rate = nullptr;
    const GlTexture* wireframe = nullptr;
    const GlTexture* work = nullptr;  // of WorkPass
    std::uint32_t workSamples = 1;    // that are in it
};

class DisplayPass {
public:
    explicit DisplayPass(std::filesystem::path shaderFolder = {});

    void draw(const DisplayInputs& inputs, const DisplaySettings& settings, int width, int height);
    // Display values as rgba8, row 0 at the bottom; what was drawn last. At least one draw.
    [[nodiscard]] const GlTexture& texture() const { return texture_; }

    // PSNR in dB of two images of one size on display values at EV 0, as compareImages has it; infinity for equal ones.
    // Reads back; not for every frame.
    [[nodiscard]] double psnr(const GlTexture& first, const GlTexture& second);

private:
    const Program& programFor(const DisplayInputs& inputs, const DisplaySettings& settings);

    std::filesystem::path shaderFolder_;
    std::map<std::string, Program> programs_;  // by what they show beside the image
    Program squaredError_;
    GlTexture texture_, levelColours_, workColours_, black_;
    Target target_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
