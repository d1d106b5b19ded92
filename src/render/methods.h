#pragma once
// The name table of rendering methods, and what each can be asked for, by name and as text: the options of `render`,
// the methods of a bench and the metadata of an image say it alike, for example
// "circular:far-components=5,resolution=half". Optional builds (the Embree ray tracer) add their methods with
// registerMethod before use.

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
    std::string name;                  // "far-components"; on the command line --far-components
    std::string standard;              // its value when nothing is said
    std::string description;           // for --help
    std::vector<std::string> choices;  // one of these, or, when empty, a number:
    double min = 0;
    double max = 0;
    bool whole = true;          // an integer
    std::string onlyWith = {};  // "resolve=published": the setting without which a method refuses this one
    bool ofTheScene = false;    // no value suits all scenes: benches over all settings leave it out
    bool keyed = false;         // a number that a shot may give keys: see valueAt
};

// Values by name, as text.
using MethodSettings = std::map<std::string, std::string>;

struct RendererOptions {
    LayerFormat layerFormat = LayerFormat::automatic;
    std::uint32_t wave = 0;                  // K, lens samples drawn at once; 0: as many as waveBytes allow
    std::uint64_t waveBytes = 160ull << 20;  // memory for a wave's layers
    bool geometryShaderLayers = false;       // pick layers in a geometry shader even where the vertex shader may
    std::filesystem::path shaderFolder;      // overrides the embedded shaders; empty: none
    MethodSettings settings;                 // of the method (Method::settings); what is not said is standard
};

// What of the lens's aperture an image shows.
enum class ApertureShown { oval, shape, all };  // oval: of any ratio; shape: all but a cat's eye

struct Method {
    std::string name;
    std::string description;
    bool needsGl = true;          // a current GL context
    bool usesLensSamples = true;  // false: the plan's number of samples means nothing to it (post-process methods)
    bool shadesAsLit = true;      // false: only unlit, opaque surfaces look as with the other methods
    bool showsThrough = true;     // false: what transmits is drawn opaque
    bool sumsBlocks = false;      // Renderer::continueWith adds to the sum: the number of samples may be left open
    bool drawsTiles = false;      // FramePlan::tile is honoured; else the whole image is drawn, whatever the plan says
    bool drawsShadows = true;     // false: lights shine through whatever stands before them
    bool drawsMotion = true;      // false: everything stands still while the shutter is open
    ApertureShown aperture = ApertureShown::all;
    std::vector<MethodSetting> settings;
    MethodSettings best = {};  // that come closest to the reference, at whatever cost; what isn't said is standard
    // Throws Error for settings that the method doesn't take.
    std::function<std::unique_ptr<Renderer>(const World&, const RendererOptions&)> make;
};

// A method with its settings, complete.
struct MethodUse {
    const Method* method = nullptr;
    MethodSettings settings;
    [[nodiscard]] bool sharesImages() const;  // "multirate" with cells=off
    [[nodiscard]] std::string text() const;   // "name" or "name:setting=value,…": what differs from the standard
};

const std::vector<Method>& methods();
void registerMethod(Method method);
// Throws Error listing the known names for an unknown one.
const Method& methodNamed(std::string_view name);
// The inverse of MethodUse::text. Throws Error for an unknown method or setting and for a value out of range.
MethodUse parseMethodUse(std::string_view text);

// `given` with the standard values filled in. Throws Error, naming `method`, for a name that isn't in `known` (it lists
// those that are) and for a value that the setting doesn't take.
MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given);

// The value of a setting that is a number; `settings` must be complete.
double numberOf(const MethodSettings& settings, const std::string& name);

// The same of a setting that may have keys: View::methodValues goes before what is set.
double valueAt(const View& view, const MethodSettings& settings, const std::string& name);

// "taps=16,coc=thin-lens": what differs from the standard values, in the table's order; empty when nothing does.
std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings);

}  // namespace defocus::engine
