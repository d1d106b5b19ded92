#include "frame/settings/unused_settings.h"

#include <gtest/gtest.h>

#include "frame/settings/settings.h"

namespace defocus::engine {
namespace {

struct Given {
    const char* name;
    const char* text;
};

std::vector<std::string> linesOf(const std::vector<Given>& given, const Scene& scene = {}) {
    Request request;
    for (const Given& each : given) setByName(request, each.name, each.text);
    Lens lens;
    lens.dofEnabled = request.lens.dofEnabled.value_or(true);
    lens.exposureTime = request.lens.exposureTime.value_or(0);
    return unusedSettings(request, scene, lens);
}

TEST(UnusedSettings, aDefaultRequestHasNone) {
    EXPECT_TRUE(linesOf({}).empty());
}

TEST(UnusedSettings, eachIsNamedWithItsReason) {
    const std::vector<std::pair<std::vector<Given>, std::string>> cases = {
        {{{"method", "circular"}, {"seed", "2"}}, "--seed has no effect: method circular has no lens samples"},
        {{{"method", "circular"}, {"lod", "off"}, {"samples", "8"}, {"positions", "4"}},
         "--samples, --positions have no effect: method circular has no lens samples"},
        // Unless --lod is off, the number of samples is used, because it determines the levels of detail.
        {{{"method", "circular"}, {"samples", "8"}, {"positions", "4"}},
         "--positions has no effect: method circular has no lens samples"},
        {{{"method", "line"}, {"positions", "4"}},
         "--positions has no effect: method line draws one subpixel position per lens sample"},
        {{{"method", "circular"}, {"bladeCount", "5"}, {"obstruction", "0.5"}},
         "--blades, --obstruction have no effect: method circular supports only round and oval apertures"},
        {{{"method", "scheuermann"}, {"bladeCount", "5"}, {"catEye", "0.5"}, {"coma", "1"}},
         "--cat-eye, --coma have no effect: method scheuermann does not support blur that differs across the image or "
         "between colours"},
        {{{"method", "circular"}, {"shutter", "0.1"}},
         "--shutter has no effect: method circular does not support motion blur"},
        {{{"motionSegments", "4"}}, "--motion-segments has no effect: there is no motion blur without --shutter"},
        {{{"environmentRotation", "30"}},
         "--environment-rotation has no effect: there is no environment map without --environment"},
        {{{"time", "2"}}, "--time has no effect: the scene has no animation"},
        {{{"dofEnabled", "false"}, {"fStop", "2"}}, "--fstop has no effect: --no-dof disables all blur"},
        {{{"lod", "off"}, {"lightThreshold", "0.1"}}, "--light-threshold has no effect: --lod off draws full detail"},
        {{{"lodCoc", "centre"}},
         "--lod-coc has no effect: with --lod-metric measured, the blur of the whole object chooses the level of "
         "detail"}};
    for (const auto& [given, line] : cases) EXPECT_EQ(linesOf(given), std::vector<std::string>{line});
}

TEST(UnusedSettings, whatHasItsOtherHalfIsUsed) {
    Scene moving;
    moving.clips.emplace_back();
    EXPECT_TRUE(linesOf({{"seed", "2"}, {"bladeCount", "5"}, {"fStop", "2"}, {"lightThreshold", "0.1"}}).empty());
    EXPECT_TRUE(linesOf({{"shutter", "0.1"}, {"motionSegments", "4"}, {"time", "1"}}, moving).empty());
    EXPECT_TRUE(linesOf({{"dofEnabled", "false"}, {"fStop", "2"}, {"exposureTime", "0.1"}}).empty());
    EXPECT_TRUE(linesOf({{"lodMetric", "size"}, {"lodCoc", "centre"}}).empty());
}

}  // namespace
}  // namespace defocus::engine
