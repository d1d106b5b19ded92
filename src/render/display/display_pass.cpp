#include "render/display/display_pass.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "gl/read_back.h"
#include "render/aov/work.h"
#include "render/gpu_scene/colour_texture.h"

namespace defocus::engine {

namespace {

// Returns the flags for `choices.z` in shaders/view/display.frag.
int flagsOf(const DisplaySettings& settings) {
    return (settings.difference ? 1 : 0) | (settings.focusPeaking ? 2 : 0) | (settings.focusPlane ? 4 : 0) |
           (settings.wireframe ? 8 : 0);
}

}  // namespace

DisplayPass::DisplayPass(std::filesystem::path shaderFolder)
    : shaderFolder_(std::move(shaderFolder)),
      levelColours_(colourMapTexture(viridis)),
      workColours_(colourMapTexture(magma)),
      black_({.format = TextureFormat::rgba8, .width = 1, .height = 1}) {
    constexpr unsigned char pixel[4] = {0, 0, 0, 255};
    black_.upload(0, 1, 1, pixel);
}

const Program& DisplayPass::programFor(const DisplayInputs& inputs, const DisplaySettings& settings) {
    const bool marks = settings.focusPeaking || settings.focusPlane || settings.wireframe;
    ShaderDefines defines;
    if (inputs.second != nullptr) defines.emplace_back("compares", "true");
    if (settings.overlay != DisplayOverlay::none) defines.emplace_back("overlays", "true");
    if (marks) defines.emplace_back("marks", "true");
    std::string key;
    for (const auto& [name, value] : defines) key += name + ' ';
    const auto [entry, isNew] = programs_.try_emplace(key);
    if (isNew) entry->second = Program({{fullscreenShader, "view/display.frag"}, std::move(defines), shaderFolder_});
    return entry->second;
}

void DisplayPass::draw(const DisplayInputs& inputs, const DisplaySettings& settings, int width, int height) {
    if (!texture_ || texture_.info().width != width || texture_.info().height != height) {
        texture_ = GlTexture({.format = TextureFormat::rgba8, .width = width, .height = height, .linear = true});
        target_ = Target({&texture_});
    }
    target_.bind();
    const GlTexture* textures[] = {inputs.first, inputs.second,    inputs.coc,
                                   inputs.level, inputs.wireframe, inputs.work};
    for (GLuint unit = 0; unit < 6; ++unit) (textures[unit] != nullptr ? *textures[unit] : black_).attach(unit);
    (settings.overlay == DisplayOverlay::work ? workColours_ : levelColours_).attach(6);
    const Program& chosen = programFor(inputs, settings);
    const GLuint program = chosen.name();
    glProgramUniform4f(program, 0, static_cast<float>(width), static_cast<float>(height),
                       static_cast<float>(std::exp2(settings.exposure)), static_cast<float>(settings.differenceGain));
    glProgramUniform4i(program, 1, static_cast<int>(settings.toneMap), static_cast<int>(settings.overlay),
                       flagsOf(settings), 0);
    glProgramUniform1f(program, 2, inputs.second != nullptr ? static_cast<float>(settings.divider) : 2.0f);
    const int cocWidth = inputs.coc != nullptr ? inputs.coc->info().width : width;
    glProgramUniform1f(program, 3, static_cast<float>(width) / static_cast<float>(cocWidth));
    glProgramUniform2f(program, 4, 1 / static_cast<float>(inputs.workSamples),
                       1 / std::log2(1 + static_cast<float>(maxShownWork)));
    fullscreen_.draw(chosen);
}

double DisplayPass::psnr(const GlTexture& first, const GlTexture& second) {
    const TextureInfo& info = first.info();
    if (info.width != second.info().width || info.height != second.info().height)
        fail("images of {} x {} and {} x {} px cannot be compared; their sizes must be equal", info.width, info.height,
             second.info().width, second.info().height);
    if (!squaredError_) squaredError_ = Program({{fullscreenShader, "view/squared_error.frag"}, {}, shaderFolder_});
    const GlTexture errors({.format = TextureFormat::r32f, .width = info.width, .height = info.height});
    const Target target({&errors});
    target.bind();
    first.attach(0);
    second.attach(1);
    fullscreen_.draw(squaredError_);
    const Image image = readBack(errors, 1);
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum > 0 ? -10 * std::log10(sum / static_cast<double>(image.pixels.size()))
                   : std::numeric_limits<double>::infinity();
}

}  // namespace defocus::engine
