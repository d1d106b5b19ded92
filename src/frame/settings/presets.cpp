#include "frame/settings/presets.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

std::span<const Preset> presets() {
    // Jeong, Kim and Lee 2011 use fixed thresholds. These values are the thresholds that this program computes for 64
    // samples.
    static const std::vector<Preset> all = {
        {"jeong2011",
         "Jeong, Kim and Lee 2011 as published: Halton samples, fixed thresholds, levels by the blur at the box's "
         "centre and in steps of half, of surviving vertices",
         {{"sequence", "halton"},
          {"lod", "fractional"},
          {"blurThreshold", "0.25"},
          {"sizeThreshold", "3.3"},
          {"lodMetric", "halving"},
          {"lodCoc", "centre"},
          {"levelVertices", "surviving"}}},
        // Tzeng and others 2012. blurThreshold is the score at which a level begins; its value is this program's
        // choice.
        {"tzeng2012",
         "Tzeng and others 2012 as published: line samples in a buffer of fixed size, the same for all pixels, each "
         "segment shaded in its middle from the light of vertices; of three levels of 100, 75 and 50 % of the vertices "
         "one by its score",
         {{"method", "line:resolve=published,shading-step=0,shading=vertices,wheel=shared"},
          {"lod", "nearest"},
          {"blurThreshold", "0.25"},
          {"lodMetric", "score"},
          {"lodCoc", "smallest"},
          {"levelVertices", "quarters"}}},
        {"scheuermann2004",
         "Scheuermann 2004 as published: eight taps of a blur of at most 10 px, linear in depth, over one pinhole "
         "image in bytes",
         {{"method", "scheuermann:bits=8,pinholes=1"}, {"lod", "off"}}},
        {"garcia2018",
         "Garcia 2018 as published: fields of quarter size, kernels of his slides with eight taps on each side, "
         "sums in ten bits, near pixels weighed by their blur, one pinhole image",
         {{"method",
           "circular:near-components=1,resolution=quarter,kernel=published,kernel-taps=eight,storage=r10g10b10a2,"
           "transparency-buckets=0,pinholes=1"},
          {"lod", "off"}}},
        {"lee2010",
         "Lee, Eisemann and Seidel 2010 as published: lens rays through the depth layers of one pinhole image",
         {{"method", "layered:pinholes=1"}, {"lod", "off"}}},
        {"munkberg2012",
         "Munkberg, Toth and Akenine-Möller 2012 as published: each pixel has its own points on the lens and in time, "
         "and sees full detail",
         {{"method", "stochastic"}, {"lod", "off"}}},
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
