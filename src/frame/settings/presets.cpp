#include "frame/settings/presets.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

std::span<const Preset> presets() {
    static const std::vector<Preset> all = {
        // Jeong, Kim and Lee 2011 give no constant of proportionality for their rule "level ∝ blur / object size". The
        // constant, blurThreshold, is this program's choice (proportionalLevels in level_selection.h).
        {"jeong2011",
         "accumulation, with levels of detail chosen by the ratio of blur to object size (Jeong et al. 2011)",
         {{"method", "accumulation"},
          {"sequence", "halton"},
          {"lod", "fractional"},
          {"blurThreshold", "10"},
          {"lodMetric", "proportional"},
          {"lodCoc", "centre"},
          {"levelVertices", "surviving"}}},
        // Tzeng et al. 2012. The paper gives no values for blurThreshold, bin-size and lines-per-position; these values
        // are this program's choice.
        {"tzeng2012",
         "line samples, with a limited number of stored segments for each (Tzeng et al. 2012)",
         {{"focusBreathing", "true"},
          {"method",
           "line:resolve=published,shading-step=0,interval-bits=16,lines-per-position=4,bin-size=65536,"
           "shading=vertices,coc-interpolation=linear,wheel=shared"},
          {"lod", "nearest"},
          {"blurThreshold", "0.25"},
          {"lodMetric", "score"},
          {"lodCoc", "smallest"},
          {"levelVertices", "quarters"}}},
        {"scheuermann2004",
         "one pinhole image, blurred with the samples of a Poisson disk (Scheuermann 2004)",
         {{"method", "scheuermann:bits=8,multisampling=4,pinholes=1"}, {"lod", "off"}}},
        {"garcia2018",
         "one pinhole image, blurred with separable circular kernels (Garcia 2018)",
         {{"method",
           "circular:near-components=1,resolution=quarter,kernel=published,max-coc=published,kernel-taps=eight,"
           "storage=r10g10b10a2,transparency-buckets=0,pinholes=1"},
          {"lod", "off"}}},
        {"lee2010",
         "lens rays, traced through the depth layers of one pinhole image (Lee et al. 2010)",
         {{"method", "layered:pinholes=1"}, {"lod", "off"}}},
        {"munkberg2012",
         "stochastic lens samples for each pixel (Munkberg et al. 2012)",
         {{"method", "stochastic:coc-interpolation=linear"}, {"lod", "off"}}},
    };
    return all;
}

const Preset& presetNamed(std::string_view name) {
    const auto found = std::ranges::find(presets(), name, &Preset::name);
    if (found == presets().end()) throw UsageError(fmt::format("there is no preset '{}'", name));
    return *found;
}

void applyPreset(const Preset& preset, Request& request) {
    for (const PresetValue& value : preset.values) settingNamed(value.setting)->set(request, value.text);
}

void clearPreset(const Preset& preset, Request& request) {
    for (const PresetValue& value : preset.values) settingNamed(value.setting)->clear(request);
}

const Preset* presetOf(const Request& request) try {
    const auto has = [&](const Preset& preset) {
        return std::ranges::all_of(preset.values, [&](const PresetValue& value) {
            return settingNamed(value.setting)->text(request) == value.text;
        });
    };
    const auto found = std::ranges::find_if(presets(), has);
    return found == presets().end() ? nullptr : &*found;
} catch (const Error&) {
    return nullptr;  // the request has an unknown method or method setting
}

}  // namespace defocus::engine
