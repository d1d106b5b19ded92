#pragma once
// The table of rendering methods and their settings, by name and as text. The options of `render`, the methods of a
// bench and the metadata of an image use the same text, for example "circular:far-components=5,resolution=half".
// Optional builds (the Embree ray tracer) add their methods with registerMethod before use.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/layer_format.h"
#include "render/renderer.h"

namespace defocus::engine {

struct MethodSetting {
    std::string name;                  // such as "far-components", on the command line --far-components
    std::string standard;              // default value, as text
    std::string description;           // for --help
    std::vector<std::string> choices;  // allowed values; if empty, the value is a number in [min, max]
    double min = 0;
    double max = 0;
    bool whole = true;          // an integer
    std::string onlyWith = {};  // such as "resolve=published": the setting that this one requires
    bool ofTheScene = false;    // no default suits all scenes; benches over all settings skip it
    bool keyed = false;         // a number that a shot may animate with keys: see valueAt
};

// Values as text, keyed by name.
using MethodSettings = std::map<std::string, std::string>;

struct RendererOptions {
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;                  // K, lens samples drawn at once; 0: as many as fit into waveBytes
    std::uint64_t waveBytes = 160ull << 20;  // memory for a wave's layers
    bool geometryShaderLayers = false;       // selects layers in a geometry shader even if the vertex shader could
    std::filesystem::path shaderFolder;      // folder with shaders that replace the embedded ones; empty: none
    MethodSettings settings;                 // of the method (Method::settings); missing ones take their default
};

// Aperture features that a method reproduces.
enum class ApertureShown { oval, shape, all };  // oval: anamorphic ratio only; shape: all but the cat's eye

struct Method {
    std::string name;
    std::string description;
    bool needsGl = true;          // needs a current GL context
    bool usesLensSamples = true;  // false: ignores the plan's number of samples (post-process methods)
    bool shadesAsLit = true;      // false: only unlit, opaque surfaces match the other methods
    bool showsThrough = true;     // false: draws transmitting surfaces as opaque
    bool blursCells = false;      // blurs images as lens cells where the frame allows it (plan/lens_cells/lens_cells.h)
    bool sumsBlocks = false;      // Renderer::continueWith adds to the sum, so the number of samples may stay open
    bool drawsTiles = false;      // true: draws only FramePlan::tile; false: always draws the full image
    bool drawsShadows = true;     // false: lights shine through occluders
    bool drawsMotion = true;      // false: draws moving objects as frozen at one moment of the exposure
    ApertureShown aperture = ApertureShown::all;
    std::vector<MethodSetting> settings;
    MethodSettings best = {};  // settings closest to the reference at any cost; missing ones take their default
    // Returns a renderer. Throws Error for settings that the method doesn't accept.
    std::function<std::unique_ptr<Renderer>(const World&, const RendererOptions&)> make;
};

// A method with complete settings.
struct MethodUse {
    const Method* method = nullptr;
    MethodSettings settings;
    // "name" or "name:setting=value,…" with the settings that differ from their default.
    [[nodiscard]] std::string text() const;
};

const std::vector<Method>& methods();
void registerMethod(Method method);
// Returns the method of this name. Throws Error listing all names if it is unknown.
const Method& methodNamed(std::string_view name);
// Parses the text of MethodUse::text. Throws Error for an unknown method or setting, or a value out of range.
MethodUse parseMethodUse(std::string_view text);

// Returns `given` with defaults filled in. Throws Error, naming `method`, for a name that is not in `known` (and lists
// the known names), or for a value that the setting doesn't accept.
MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given);

// Returns the value of a numeric setting; `settings` must be complete.
double numberOf(const MethodSettings& settings, const std::string& name);

// Returns the value of a numeric setting that a shot may animate: View::methodValues takes precedence over `settings`.
double valueAt(const View& view, const MethodSettings& settings, const std::string& name);

// Returns the settings that differ from their default, in the order of `known`, as in "taps=16,coc=thin-lens". Empty if
// none differs.
std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings);

}  // namespace defocus::engine
