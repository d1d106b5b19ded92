#pragma once
// Table of rendering methods and their settings. Command-line options, benchmarks and image metadata use the same text
// form, for example "circular:far-components=5,resolution=half". Optional parts of the build (the Embree ray tracer)
// add their methods with registerMethod.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gl/pacer.h"
#include "render/layer_format.h"
#include "render/renderer.h"

namespace defocus::engine {

struct MethodSetting {
    std::string name;  // e.g. "far-components"; the command-line option is --far-components
    std::string defaultValue;
    std::string description;           // help text
    std::vector<std::string> choices;  // allowed values; empty: a number in [min, max]
    double min = 0;
    double max = 0;
    bool integer = true;        // true: values must be integers (numeric settings only)
    std::string onlyWith = {};  // e.g. "resolve=published": only allowed with this setting
    bool ofTheScene = false;    // true: each scene needs its own value; benchmarks skip this setting
    bool keyed = false;         // true: a shot may animate the value with keys, see valueAt (numeric settings only)
};

// Setting values as text, keyed by the name of the setting.
using MethodSettings = std::map<std::string, std::string>;

struct RendererOptions {
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;                  // lens samples drawn together (a wave); 0: as many as fit into waveBytes
    std::uint64_t waveBytes = 160ull << 20;  // max memory of all layers that are drawn at once
    std::uint32_t threads = 1;               // threads that draw (Method::usesThreads), each with a context of its own
    // Max memory in bytes of the triangles that a software OpenGL driver has queued but not yet drawn.
    std::uint64_t pendingBytes = SubmissionPacer::defaultBytes;
    bool geometryShaderLayers = false;        // true: always select layers in a geometry shader
    std::filesystem::path shaderFolder = {};  // shaders in this folder replace embedded shaders; empty: none
    MethodSettings settings = {};             // values of Method::settings; missing settings have their default
};

// Features of the aperture that a method reproduces. oval: only the anamorphic ratio. shape: the aperture's shape, but
// no effects that differ across the image (cat's-eye bokeh) or between colours (axial chromatic aberration). all: these
// effects, too.
enum class ApertureShown { oval, shape, all };

struct Method {
    std::string name;
    std::string description;
    bool needsGl = true;          // true: needs a current OpenGL context
    bool usesLensSamples = true;  // false: ignores the plan's lens samples, as post-process methods do
    bool shadesAsLit = true;      // true: shades as other methods do; false: only unlit, opaque surfaces match them
    bool showsThrough = true;     // false: draws transmitting surfaces as opaque
    bool blursCells = false;      // true: blurs each sample's image to fill gaps between samples (plan/lens_cells/)
    bool sumsBlocks = false;      // true: Renderer::continueWith adds samples to the current image
    bool drawsTiles = false;      // true: draws only FramePlan::tile; false: always the full image
    bool drawsLayers = false;     // true: draws data layers (RenderSettings::layers)
    bool drawsPositions = false;  // true: may draw each sample at several pixel positions (RenderSettings::positions)
    bool usesThreads = false;     // true: draws in RendererOptions::threads threads
    bool drawsShadows = true;     // false: no shadows
    bool drawsMotion = true;      // false: draws moving objects at a single time within the exposure
    ApertureShown aperture = ApertureShown::all;
    // Returns whether the method draws levels of detail. Ray tracers trace the loaded meshes only. Post-process methods
    // start from a sharp image, in which no blur hides a coarse level.
    [[nodiscard]] bool drawsLevels() const { return needsGl && usesLensSamples; }
    std::vector<MethodSetting> settings;
    MethodSettings best = {};  // settings that minimize the error, at any cost in time; other settings: default
    // Creates a renderer. Throws Error for settings that the method does not accept.
    std::function<std::unique_ptr<Renderer>(const World&, const RendererOptions&)> make;
};

// Method with a value for each of its settings.
struct MethodUse {
    const Method* method = nullptr;
    MethodSettings settings;
    // Returns "name", or "name:setting=value,…" with the settings that differ from their default.
    [[nodiscard]] std::string text() const;
};

// Name of the method that chooses between accumulation and multirate for each frame; see drawnMethod.
inline constexpr const char* automaticMethod = "auto";

const std::vector<Method>& methods();
void registerMethod(Method method);
// Returns the method with this name. Throws Error, with a list of all names, if there is none.
const Method& methodNamed(std::string_view name);
// Returns the method that draws the plan. For method "auto", this is the method that it chooses; other methods are
// returned unchanged.
MethodUse drawnMethod(const MethodUse& use, const FramePlan& plan);
// Inverse of MethodUse::text. Throws Error for an unknown method or setting, or a value out of range.
MethodUse parseMethodUse(std::string_view text);

// Returns `given` with defaults for missing settings. Throws Error, with `method` in its message, for a setting that is
// not in `known` or a value that a setting does not accept.
MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given);

// Returns the value of a numeric setting; `settings` must be complete.
double numberOf(const MethodSettings& settings, const std::string& name);

// Returns the value of a numeric setting that a shot may animate: from View::methodValues if present, else from
// `settings`.
double valueAt(const View& view, const MethodSettings& settings, const std::string& name);

// Returns the settings that differ from their default, in the order of `known`, e.g. "taps=16,coc=thin-lens"; empty if
// none differs.
std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings);

}  // namespace defocus::engine
