#include "capture/shot_json.h"

#include <gtest/gtest.h>

#include "capture/shot_options.h"
#include "core/error.h"
#include "lod/pyramid/level_selection.h"

namespace defocus::engine {
namespace {

std::string faultOf(std::string_view text, const std::vector<ShotOverride>& overrides = {}) {
    try {
        parseShot(text, "shots/x.json", overrides);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ShotJson, nothingSaidIsAShotOfOneFrame) {
    const Shot shot = parseShot("{}", "a/x.json");
    EXPECT_EQ(shot.range.first, 0);
    EXPECT_EQ(shot.range.last, 0);
    EXPECT_EQ(shot.frameRate, 24);
    EXPECT_TRUE(shot.request.scene.empty());
    EXPECT_FALSE(shot.focus);
    EXPECT_EQ(shot.outputs, std::vector<std::string>{"frames/####.exr"});
}

// Shots of version 0.1 can still be loaded. The file has every member that version 0.1 could write, except members that
// exclude each other.
TEST(ShotJson, shotsOfVersion01StillLoad) {
    const std::filesystem::path source = DEFOCUS_SOURCE_DIR;
    const Shot shot = loadShot(source / "tests/data/shots/version-0.1.json");
    Request request;
    applyShot(shot, request);
    EXPECT_EQ(shot.range.last, 71);
    EXPECT_EQ(shot.frameRate, 25);
    EXPECT_EQ(request.units, 1);
    EXPECT_EQ(request.background, Background(Color{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(request.clip, "Walk");
    EXPECT_EQ(request.shutterPosition, ShutterPosition::start);
    EXPECT_EQ(request.motionSegments, MotionSegments(4u));
    EXPECT_EQ(request.camera, CameraChoice(NamedCamera{"Near"}));
    EXPECT_TRUE(shot.focus);
    EXPECT_EQ(shot.lens.size(), 27u);
    EXPECT_EQ(shot.lens.at("bladeCount").keys.front().value, 7);
    EXPECT_EQ(shot.lens.at("fStop").keys.back().value, 8);
    EXPECT_EQ(request.samples, 128u);
    EXPECT_EQ(request.targetError, 0.003);
    EXPECT_EQ(request.sequence, Sequence::scrambledHalton);
    EXPECT_EQ(request.lod, LodMode::continuous);
    EXPECT_EQ(request.levelVertices, LevelVertices::surviving);
    EXPECT_EQ(request.method, "multirate");
    for (const char* name : {"shots/fish-pull.json", "shots/orrery.json", "shots/swimmers.json"})
        EXPECT_NO_THROW(loadShot(source / name));
}

// Settings beside a preset override the preset's values regardless of their order, because members of a JSON object are
// unordered.
TEST(ShotJson, whatIsGivenBesideAPresetWins) {
    for (const char* text :
         {R"({"preset": "jeong2011", "sequence": "r2"})", R"({"sequence": "r2", "preset": "jeong2011"})"}) {
        const Shot shot = parseShot(text, "x.json");
        Request request;
        applyShot(shot, request);
        EXPECT_EQ(request.sequence, Sequence::r2);
        EXPECT_EQ(request.lodMetric, LodMetric::proportional);
        EXPECT_EQ(request.levelVertices, LevelVertices::surviving);
        EXPECT_TRUE(request.lodCoc == LodCoc::centre);
        EXPECT_EQ(request.blurThreshold, proportionalLevels);
    }
    EXPECT_NE(faultOf(R"({"preset": "jeong2012"})").find("jeong2011"), std::string::npos);
}

TEST(ShotJson, pathsOfTheSceneAreRelativeToTheShot) {
    const Shot shot = parseShot(R"({"scene": "fox.glb", "environment": "/skies/sky.hdr"})", "a/b/x.json");
    EXPECT_EQ(shot.request.scene, "a/b/fox.glb");
    EXPECT_EQ(shot.request.environment, "/skies/sky.hdr");
    EXPECT_EQ(parseShot(R"({"environment": "studio"})", "a/b/x.json").request.environment, "studio");
}

TEST(ShotJson, exposureIsANumberOrAuto) {
    EXPECT_EQ(parseShot(R"({"exposure": -1.5})", "x.json").request.exposure, Exposure(ExposureValue{-1.5}));
    const Shot metered = parseShot(R"({"exposure": "auto"})", "x.json");
    EXPECT_EQ(metered.request.exposure, Exposure(MeteredExposure{}));
    EXPECT_THROW(parseShot(R"({"exposure": "bright"})", "x.json"), Error);
}

// Positions and distances in a shot are in metres unless the shot names another unit. If it has neither positions nor
// distances, the scene's unit is guessed.
TEST(ShotJson, lengthsInAShotAreMetres) {
    const auto unitsOf = [](const char* text) {
        Shot shot = parseShot(text, "x.json");
        Request request;
        applyShot(shot, request);
        settleShot(shot, request, {});
        return request.units;
    };
    EXPECT_FALSE(unitsOf(R"({"lens": {"fStop": 2}, "focus": {"node": "Fox"}})"));
    EXPECT_EQ(unitsOf(R"({"focus": {"distance": 2}})"), 1);
    EXPECT_EQ(unitsOf(R"({"camera": {"dolly": {"distance": 2}}})"), 1);
    EXPECT_EQ(unitsOf(R"({"camera": {"keys": [{"frame": 0, "position": [0, 0, 9], "target": [0, 0, 0]}]}})"), 1);
    EXPECT_EQ(unitsOf(R"({"units": "cm", "focus": {"distance": 2}})"), 0.01);
}

TEST(ShotJson, everyPartIsRead) {
    const Shot shot = parseShot(R"({
        "frameRate": 25, "range": [10, 20], "size": [320, 240], "samples": 16, "seed": 3, "animateSeed": true,
        "animation": {"clip": "Walk", "start": 0.5, "speed": 2, "loop": true},
        "camera": {"name": "Main", "keys": [{"frame": 1, "position": [1, 2, 3], "target": "Fox"},
                                            {"frame": 2.5, "position": "Tree", "target": [0, 0, 0]}],
                   "interpolation": "linear"},
        "focus": {"keys": [{"frame": 0, "node": "Fox"}, {"frame": 9, "distance": 4}], "interpolation": "linear"},
        "lens": {"fStop": 1.4, "dofEnabled": false, "bladeCount": 7,
                 "blurScale": {"keys": [{"frame": 0, "value": 1}, {"frame": 5, "value": 2}]}},
        "lod": "nearest", "method": "accumulation", "layerFormat": "rgba32f", "background": [0, 0.5, 1],
        "output": ["a/#.exr", "b/#.png"], "exposure": -1, "toneMap": "agx", "video": "film.mp4"})",
                                "x.json");
    EXPECT_EQ(shot.range.last, 20);
    EXPECT_EQ(shot.request.clip, "Walk");
    EXPECT_TRUE(shot.request.loop);
    const auto& keys = std::get<CameraKeys>(shot.movement);
    EXPECT_EQ(keys.easing, Easing::linear);
    EXPECT_EQ(std::get<glm::dvec3>(keys.positions[0].value), glm::dvec3(1, 2, 3));
    EXPECT_EQ(std::get<std::string>(keys.targets[0].value), "Fox");
    EXPECT_EQ(keys.positions[1].frame, 2.5);
    ASSERT_TRUE(shot.focus);
    EXPECT_EQ(std::get<FocusDistance>(shot.focus->keys[1].value).metres, 4);
    EXPECT_EQ(shot.lens.at("dofEnabled").keys[0].value, 0);
    EXPECT_EQ(shot.lens.at("blurScale").keys[1].value, 2);
    EXPECT_EQ(shot.lens.at("blurScale").easing, Easing::smooth);
    EXPECT_EQ(shot.request.lod, LodMode::nearest);
    EXPECT_EQ(shot.outputs.size(), 2u);
    EXPECT_EQ(shot.request.toneMap, ToneMap::agx);
}

TEST(ShotJson, faultsNameTheirPlaceAndWhatWasExpected) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"camera": {"keys": [{"frame": 0, "position": [0, 0, "a"], "target": [0, 0, 0]}]}})",
         R"(shots/x.json: /camera/keys/0/position: expected three numbers or the name of a node, not [0,0,"a"])"},
        {R"({"range": [0, -1]})", "shots/x.json: /range/1: expected an integer from 0 to 9999999, not -1"},
        {R"({"range": [5, 3]})", "shots/x.json: /range: expected a last frame that is not before the first, not [5,3]"},
        {R"({"lens": {"fStop": 0}})", "shots/x.json: /lens/fStop: expected a number from 0.001 to 1000000, not 0"},
        {R"({"lens": {"bladeCount": 2}})",
         "shots/x.json: /lens/bladeCount: bladeCount must be 0 (a disk) or 3 to 64, not 2"},
        {R"({"lens": {"fstop": 2}})", "shots/x.json: /lens: there is no key 'fstop'; did you mean 'fStop'?"},
        {R"({"sample": 2})", "shots/x.json: /: there is no key 'sample'; did you mean 'samples'?"},
        {R"({"focus": {"keys": [{"frame": 3, "distance": 1}, {"frame": 3, "distance": 2}]}})",
         "shots/x.json: /focus/keys/1/frame: expected a frame later than 3, the frame of the previous keyframe, not 3"},
        {R"({"focus": {"keys": []}})",
         "shots/x.json: /focus/keys: expected one keyframe or more, each with a frame, not []"},
        {R"({"focus": {"keys": [{"frame": 3}]}})",
         "shots/x.json: /focus/keys/0: give exactly one of 'node', 'distance', 'pixel' and 'auto'"},
        {R"({"lod": "best"})",
         R"(shots/x.json: /lod: expected "auto", "fractional", "continuous", "nearest" or "off", not "best")"},
        {R"({"focus": {"distance": 1}, "lens": {"focusDistance": 2}})",
         "shots/x.json: /lens/focusDistance: cannot be combined with the shot's 'focus'; give only one of them"},
        {R"({"camera": {"dolly": {"distance": 1}, "turntable": {}}})",
         "shots/x.json: /camera: give only one of 'keys', 'turntable' and 'dolly'"},
        {R"({"methodKeys": {"far-blur-depth": {"keys": [{"frame": 0, "value": 0}]}}})",
         "shots/x.json: /methodKeys/far-blur-depth/keys/0/value: expected a number from 1e-06 to 1000000000, not 0"},
        {R"({"scene": "a.glb\u0000x"})", "shots/x.json: /scene: contains a NUL character; remove it"},
        {R"({"output": ["a####.png", "b####.png\u0000"]})",
         "shots/x.json: /output/1: contains a NUL character; remove it"},
        {R"([1])", "shots/x.json: /: expected an object, not [1]"},
        {"{\"samples\": 4,\n  oops}",
         "shots/x.json: line 2, column 3: not valid JSON: unexpected character or end of file"},
        {"{\"samples\":\n [1e-999, \"1e999\", -1e999]}", "shots/x.json: line 2, column 20: the number is too large"},
        {"1e999", "shots/x.json: line 1, column 1: the number is too large"},
        {"", "shots/x.json: line 1, column 1: not valid JSON: unexpected character or end of file"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(faultOf(text), message) << text;
}

TEST(ShotJson, overridesReplaceValuesByTheirPlace) {
    const Shot shot = parseShot(
        R"({"samples": 4, "focus": {"node": "A"}})", "x.json",
        {parseShotOverride("/samples=32"), parseShotOverride("/focus/node=B C"), parseShotOverride("/lens/fStop=1.4")});
    EXPECT_EQ(shot.request.samples, 32u);
    EXPECT_EQ(std::get<FocusNode>(shot.focus->keys[0].value).name, "B C");
    EXPECT_EQ(shot.lens.at("fStop").keys[0].value, 1.4);
    EXPECT_EQ(faultOf("{}", {parseShotOverride("/smaples=3")}),
              "shots/x.json: /: there is no key 'smaples'; did you mean 'samples'?");
    EXPECT_NE(faultOf(R"({"samples": 4})", {parseShotOverride("/samples/3=3")}), "");
    EXPECT_THROW(parseShotOverride("samples=3"), Error);
    EXPECT_THROW(parseShotOverride("/samples"), Error);
}

TEST(ShotJson, deepNestingIsRefused) {
    const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
    std::string pointer;
    for (int i = 0; i < 1'000'000; ++i) pointer += "/a";
    EXPECT_EQ(faultOf(R"({"size": )" + deep + "}"), "shots/x.json: JSON nested deeper than 64 levels");
    EXPECT_EQ(faultOf("{}", {{"/size", deep}}), "--set /size: nested deeper than 64 levels");
    EXPECT_NE(faultOf("{}", {{pointer, "1"}}).find("nested deeper than 64 levels"), std::string::npos);
}

TEST(ShotJson, rangesOfTheCommandLine) {
    EXPECT_EQ(parseFrameRange("0:240").last, 240);
    EXPECT_EQ(parseFrameRange("12").first, 12);
    EXPECT_EQ(parseFrameRange("12").last, 12);
    for (const char* wrong : {"", ":", "1:", ":3", "5:4", "-1:3", "a:b", "1:2:3", "1.5:2", "99999999"})
        EXPECT_THROW(parseFrameRange(wrong), Error) << wrong;
}

}  // namespace
}  // namespace defocus::engine
