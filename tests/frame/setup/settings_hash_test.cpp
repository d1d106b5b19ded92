// Tests the hash that identifies finished frames: it changes with every setting that changes the image, and with no
// other setting.

#include "frame/setup/settings_hash.h"

#include <gtest/gtest.h>

#include "frame/settings/presets.h"
#include "frame/settings/settings.h"

namespace defocus::engine {
namespace {

std::string hashOf(const Request& request) {
    FilmSettings film;
    film.request = request;
    FrameMoment frame;
    frame.settings = renderSettings(request);
    return settingsHash(film, frame);
}

TEST(SettingsHash, changesWithWhatChangesThePicture) {
    const std::string defaults = hashOf({});
    const std::vector<std::pair<const char*, const char*>> values = {{"levelVertices", "surviving"},
                                                                     {"lodMetric", "proportional"},
                                                                     {"lodCoc", "centre"},
                                                                     {"sequence", "halton"},
                                                                     {"blurThreshold", "0.25"},
                                                                     {"samples", "65"},
                                                                     {"seed", "1"},
                                                                     {"layerFormat", "rgba32f"}};
    for (const auto& [name, value] : values) {
        Request request;
        setByName(request, name, value);
        EXPECT_NE(hashOf(request), defaults) << name;
    }
    for (const auto& [name, value] : std::vector<std::pair<const char*, const char*>>{
             {"wave", "3"}, {"threads", "5"}, {"noCache", "true"}, {"strict", "true"}}) {
        Request request;
        setByName(request, name, value);
        EXPECT_EQ(hashOf(request), defaults) << name;
    }
}

TEST(SettingsHash, isThatOfTheMethodThatDraws) {
    Request limited;
    setByName(limited, "memory", "1GiB");
    Request named = limited;
    setByName(named, "method", "accumulation");
    EXPECT_EQ(hashOf(limited), hashOf(named)) << "with a memory limit, auto is accumulation";
    EXPECT_NE(hashOf(limited), hashOf({}));
}

TEST(SettingsHash, isThatOfWhatAPresetSets) {
    Request byPreset;
    setByName(byPreset, "preset", "jeong2011");
    Request byValue;
    for (const PresetValue& value : presetNamed("jeong2011").values) setByName(byValue, value.setting, value.text);
    EXPECT_EQ(hashOf(byPreset), hashOf(byValue));
    EXPECT_NE(hashOf(byPreset), hashOf({}));
}

}  // namespace
}  // namespace defocus::engine
