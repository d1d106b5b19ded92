// End-to-end tests of `defocus render`: its image files, metadata and statistics, and its behaviour on a full disk.

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

#include "cli/gl_program.h"
#include "cli/two_quads.h"
#include "defocus/renderer.h"
#include "frame/program_facts.h"
#include "frame/settings/settings.h"
#include "image/image_io.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Render : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        writeTwoQuads(folder() / "quads.gltf");
    }

    Outcome render(std::vector<std::string> arguments, std::size_t maxFileBytes = 0) const {
        arguments.insert(arguments.begin(), {"render", "quads.gltf", "--size", "128x96", "--samples", "4"});
        return run(arguments, maxFileBytes);
    }
};

TEST_F(Render, writesEachOutputAndOneLineOfSummary) {
    const Outcome outcome = render({"-o", "a.exr", "-o", "b ❤.png", "-o", "c.jpg", "--tonemap", "agx"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("128x96, 4 samples"), std::string::npos) << outcome.err;
    EXPECT_EQ(fileCount(), 4u);
    for (const char* name : {"a.exr", "b ❤.png", "c.jpg"}) {
        const Image image = readImage(folder() / name);
        EXPECT_EQ(image.width, 128) << name;
        EXPECT_EQ(image.height, 96) << name;
    }
    EXPECT_EQ(run({"render", "quads.gltf", "--size", "8x8", "--quiet"}).err, "");
    EXPECT_TRUE(fs::exists(folder() / "out.exr"));
}

TEST_F(Render, theSummaryTellsOfSamplesLeftOut) {
    const std::vector<std::string> sharp = {"render", "quads.gltf", "--size", "32x24", "--samples", "100", "--no-dof"};
    EXPECT_NE(run(sharp).err.find("16 samples (of 100: nothing is blurred, so fewer suffice; --keep-all draws all)"),
              std::string::npos);
    std::vector<std::string> all = sharp;
    all.emplace_back("--keep-all");
    EXPECT_NE(run(all).err.find("100 samples in"), std::string::npos);
}

TEST_F(Render, theSummaryOfAMethodWithoutSamplesCountsPinholeImages) {
    const auto summaryWith = [&](const char* method) {
        const Outcome outcome = run({"render", "quads.gltf", "--size", "32x24", "--method", method});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.err;
    };
    EXPECT_NE(summaryWith("circular").find("32x24, 4 pinhole images in"), std::string::npos);
    EXPECT_NE(summaryWith("scheuermann:pinholes=1").find("32x24, 1 pinhole image in"), std::string::npos);
}

// The public API and the program render bit-identical images for each of these sets of options.
TEST_F(Render, isWhatTheLibraryRenders) {
    const auto expectSame = [&](const std::vector<std::pair<std::string, std::string>>& values) {
        std::vector<std::string> arguments = {"render", "--no-cache", "-o", "a.exr"};
        Request request;
        request.noCache = true;
        for (const auto& [name, value] : values) {
            const std::string option = settingNamed(name)->option;
            if (option != "SCENE") arguments.push_back(option);
            arguments.push_back(value);
            setSetting(request, name, name == "scene" ? (folder() / value).string() : value);
        }
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(readImage(folder() / "a.exr").pixels, defocus::render(request).pixels) << outcome.err;
    };
    expectSame({{"scene", "quads.gltf"}, {"size", "64x48"}});  // with the default number of samples
    expectSame({{"scene", "quads.gltf"}, {"samples", "4"}});   // with the default size
    expectSame({{"fishCount", "3"}, {"trianglesPerFish", "1000"}, {"size", "80x60"}});
    expectSame({{"scene", "quads.gltf"},
                {"size", "128x96"},
                {"samples", "70"},
                {"fStop", "1"},
                {"focusNode", "Far"},
                {"bladeCount", "7"},
                {"sequence", "halton"},
                {"background", "none"}});
    expectSame({{"scene", "quads.gltf"}, {"size", "128x96"}, {"method", "circular:far-components=5"}, {"fStop", "1"}});
}

// With --target-error, the printed line, the metadata and --stats report the number of samples, the remaining error and
// the reason for stopping.
TEST_F(Render, targetErrorSaysWhatBecameOfIt) {
    const auto rendered = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"render", "quads.gltf", "--size", "128x96", "--fstop", "1", "-o", "a.exr",
                                             "--stats", "stats.json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        return outcome.err;
    };
    const auto facts = [&] { return json::parse(textOf(folder() / "stats.json")); };
    Metadata metadata;

    std::string line = rendered({"--target-error", "0.2"});
    EXPECT_NE(line.find("128 samples (RMSE about 0.0"), std::string::npos) << line;
    EXPECT_NE(line.find("the estimated error is below the target)"), std::string::npos) << line;
    readImage(folder() / "a.exr", metadata);
    EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 128);
    EXPECT_NEAR(std::get<double>(metadata.at("defocus:targetError")), 0.2, 1e-7);
    EXPECT_NEAR(std::get<double>(metadata.at("defocus:estimatedError")), facts().at("estimatedError").get<double>(),
                1e-7);
    EXPECT_EQ(std::get<std::string>(metadata.at("defocus:stopped")), "the estimated error is below the target");
    EXPECT_EQ(facts().at("samples"), 128);

    line = rendered({"--target-error", "1e-6", "--samples", "200"});
    EXPECT_NE(line.find("200 samples (RMSE about"), std::string::npos) << line;
    EXPECT_EQ(facts().at("stopped"), "all requested samples are drawn");

    line = rendered({"--time-limit", "0.001"});
    EXPECT_NE(line.find("64 samples (RMSE not estimated; the time limit is reached)"), std::string::npos) << line;
    EXPECT_TRUE(facts().at("estimatedError").is_null());

    line = rendered({"--samples", "64"});
    readImage(folder() / "a.exr", metadata);
    EXPECT_FALSE(metadata.contains("defocus:stopped"));
    EXPECT_FALSE(facts().contains("stopped"));
}

TEST_F(Render, exrCarriesCameraLensSamplesAndProgram) {
    ASSERT_EQ(render({"-o", "a.exr", "--fstop", "1.4", "--seed", "7", "--focus-node", "Far"}).exitCode, 0);
    Metadata metadata;
    readImage(folder() / "a.exr", metadata);
    const auto number = [&](const char* name) {
        const MetadataValue& value = metadata.at(name);
        return std::holds_alternative<int>(value) ? std::get<int>(value) : std::get<double>(value);
    };
    EXPECT_NEAR(number("aperture"), 1.4, 1e-6);
    EXPECT_NEAR(number("focus"), 8, 1e-6);
    EXPECT_NEAR(number("nominalFocalLength"), 50, 1e-4);
    EXPECT_EQ(number("defocus:horizontalAperture"), 36);
    EXPECT_EQ(number("defocus:samples"), 4);
    EXPECT_EQ(number("defocus:seed"), 7);
    EXPECT_EQ(std::get<std::string>(metadata.at("defocus:sequence")), "sobol");
    EXPECT_GT(number("defocus:seconds"), 0);
    EXPECT_EQ(std::get<std::string>(metadata.at("cameraLabel")), "Main");
    EXPECT_TRUE(std::get<std::string>(metadata.at("software")).starts_with("defocus "));
}

// --exposure-time and --iso set the exposure. For f/2, 1/8 s and ISO 200: EV100 = log2(4·8/2) = 4, and white is 1.2·2^4
// cd/m².
TEST_F(Render, exposureTimeAndIsoAreAnExposure) {
    const std::vector<std::string> photographic = {"--fstop", "2", "--exposure-time", "1/8", "--iso", "200"};
    std::vector<std::string> arguments = {"-o", "a.exr", "-o", "a.png"};
    arguments.insert(arguments.end(), photographic.begin(), photographic.end());
    ASSERT_EQ(render(arguments).exitCode, 0);
    const std::string stops = fmt::format("--exposure={}", -4 - std::log2(1.2));
    ASSERT_EQ(render({"-o", "b.png", "--fstop", "2", stops}).exitCode, 0);
    EXPECT_EQ(readImage(folder() / "a.png").pixels, readImage(folder() / "b.png").pixels);
    Metadata metadata;
    readImage(folder() / "a.exr", metadata);
    EXPECT_NEAR(std::get<double>(metadata.at("expTime")), 0.125, 1e-6);
    EXPECT_NEAR(std::get<double>(metadata.at("isoSpeed")), 200, 1e-4);

    // The exposure stored in the scene file applies unless --exposure overrides it.
    json scene = json::parse(textOf(folder() / "quads.gltf"));
    scene["cameras"][0]["extras"] = {{"fStop", 2}, {"exposureTime", 0.125}, {"iso", 200}};
    std::ofstream(folder() / "own.gltf") << scene.dump();
    const auto own = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", "own.gltf", "--size", "128x96", "--samples", "4", "-o", "c.png"};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(run(words).exitCode, 0);
        return readImage(folder() / "c.png").pixels;
    };
    EXPECT_EQ(own({}), readImage(folder() / "a.png").pixels);
    EXPECT_NE(own({"--exposure", "0"}), readImage(folder() / "a.png").pixels);
}

// The path of a camera's aperture image is relative to the scene file, and the image has the same effect as
// --aperture-image. An unreadable image is ignored with a warning.
TEST_F(Render, apertureImageOfTheCameraLiesBesideTheScene) {
    Image image(8, 8, 1);
    *image.at(6, 3) = 1;
    writeImage(folder() / "hole.exr", image);
    json scene = json::parse(textOf(folder() / "quads.gltf"));
    scene["cameras"][0]["extras"] = {{"apertureImage", "hole.exr"}};
    std::ofstream(folder() / "own.gltf") << scene.dump();
    scene["cameras"][0]["extras"] = {{"apertureImage", "missing.exr"}};
    std::ofstream(folder() / "missing.gltf") << scene.dump();
    const auto rendered = [&](const char* name, std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"render", name, "-o", "out.exr", "--size", "64x48", "--samples", "8", "--fstop", "0.2"});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find("missing.exr") != std::string::npos, std::string(name) == "missing.gltf");
        return readImage(folder() / "out.exr").pixels;
    };
    const std::vector<float> plain = rendered("quads.gltf", {});
    const std::vector<float> own = rendered("own.gltf", {});
    EXPECT_EQ(own, rendered("quads.gltf", {"--aperture-image", "hole.exr"}));
    EXPECT_NE(own, plain);
    EXPECT_EQ(rendered("missing.gltf", {}), plain);
}

TEST_F(Render, methodAndItsSettingsStandInTheMetadata) {
    ASSERT_EQ(render({"-o", "a.exr", "--method", "circular", "--far-components", "3", "--pinholes", "2"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--method", "circular:far-components=3,pinholes=2"}).exitCode, 0);
    Metadata metadata;
    const Image a = readImage(folder() / "a.exr", metadata);
    EXPECT_EQ(std::get<std::string>(metadata.at("defocus:method")), "circular:far-components=3,pinholes=2");
    EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 2);
    EXPECT_EQ(a.pixels, readImage(folder() / "b.exr").pixels);
}

// The matrices in EXR metadata map a point to the pixel that shows it. In OpenEXR, camera space is left-handed and
// looks along +z; (0, 0) in NDC is the upper left corner of the image.
TEST_F(Render, matricesOfTheMetadataPlaceAPointWhereTheImageShowsIt) {
    ASSERT_EQ(render({"-o", "a.exr", "--aov", "depth"}).exitCode, 0);
    Metadata metadata;
    readImage(folder() / "a.exr", metadata);
    const Image depth = readImage(folder() / "a.depth.exr");
    // Points just inside and just outside the left edge of the square named "Near".
    const glm::vec4 inside = {-0.18f, 0.3f, -2, 1};
    const glm::vec4 outside = {-0.22f, 0.3f, -2, 1};
    const glm::vec4 camera = std::get<glm::mat4>(metadata.at("worldToCamera")) * inside;
    EXPECT_NEAR(camera.z, 2, 1e-5);
    const auto depthAt = [&](const glm::vec4& point) {
        const glm::vec4 ndc = std::get<glm::mat4>(metadata.at("worldToNDC")) * point;
        return *depth.at(static_cast<int>(ndc.x / ndc.w * 128), static_cast<int>(ndc.y / ndc.w * 96));
    };
    EXPECT_NEAR(depthAt(inside), 2, 1e-5);
    EXPECT_TRUE(std::isinf(depthAt(outside)));
}

TEST_F(Render, aDashIsStandardOutput) {
    const Outcome run = render({"--stats", "-"});
    ASSERT_EQ(run.exitCode, 0);
    EXPECT_TRUE(json::parse(run.out).contains("renderMilliseconds")) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder() / "-"));
}

// With `-o -`, standard output receives the same image as a file; only times in the metadata differ.
TEST_F(Render, aDashIsStandardOutputForImages) {
    ASSERT_EQ(render({"-o", "a.png", "-o", "a.exr"}).exitCode, 0);
    const auto pixels = [&](const char* name) { return readImage(folder() / name).pixels; };
    for (const auto& [output, file] : {std::pair{"-", "a.png"}, std::pair{"png:-", "a.png"}, {"exr:-", "a.exr"}}) {
        const Outcome outcome = render({"-o", output});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("standard output: 128x96"), std::string::npos) << outcome.err;
        const std::string copy = std::string("copy") + fs::path(file).extension().string();
        std::ofstream(folder() / copy, std::ios::binary) << outcome.out;
        EXPECT_TRUE(pixels(copy.c_str()) == pixels(file)) << output;
    }
    EXPECT_FALSE(fs::exists(folder() / "-"));
    expectOneLine(render({"-o", "-", "--stats", "-"}), 1);
    expectOneLine(render({"-o", "gif:-"}), 1);
    expectOneLine(render({"-o", "-", "--aov", "depth"}), 1);
}

// Without --samples, the blur determines the number of samples: few for small blur, more for strong blur, and the same
// number in each run.
TEST_F(Render, theNumberOfSamplesIsAutomatic) {
    const auto rendered = [&](const std::string& name, std::vector<std::string> options) {
        options.insert(options.begin(),
                       {"render", "quads.gltf", "--size", "128x96", "--stats", "stats.json", "-o", name});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        const json stats = json::parse(textOf(folder() / "stats.json"));
        const auto samples = stats.at("samples").get<int>();
        const std::string positions = stats.at("positions") == 4 ? " with 4 positions" : "";
        EXPECT_NE(outcome.err.find(fmt::format("{} samples{} (automatic", samples, positions)), std::string::npos)
            << outcome.err;
        return samples;
    };
    EXPECT_EQ(rendered("sharp.exr", {"--no-dof"}), 16) << "pinhole samples only smooth edges";
    EXPECT_TRUE(json::parse(textOf(folder() / "stats.json")).value("estimatedError", json()).is_null()) << "no trial";
    EXPECT_EQ(rendered("little.exr", {"--fstop", "4"}), 16);
    EXPECT_EQ(rendered("little4.exr", {"--fstop", "4", "--positions", "4"}), 4) << "with 4 positions each";
    const int many = rendered("much.exr", {"--fstop", "0.3", "--focus-distance", "1"});
    EXPECT_GE(many, 64);
    EXPECT_EQ(rendered("again.exr", {"--fstop", "0.3", "--focus-distance", "1", "--samples", "auto", "--wave", "5"}),
              many);
    EXPECT_TRUE(readImage(folder() / "much.exr").pixels == readImage(folder() / "again.exr").pixels);
    Metadata metadata;
    static_cast<void>(readImage(folder() / "much.exr", metadata));
    EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), many);

    // The library and the program have the same default number of samples.
    Request request;
    request.scene = folder() / "quads.gltf";
    request.size.width = 128;
    request.size.height = 96;
    request.lens.fStop = 0.3;
    request.focus = FocusDistance{1};
    EXPECT_TRUE(defocus::render(request).pixels == readImage(folder() / "much.exr").pixels);

    // --sample-range requires --samples.
    const Outcome part = run({"render", "quads.gltf", "--sample-range", "0:64"});
    expectOneLine(part, 2);
    EXPECT_NE(part.err.find("give --samples"), std::string::npos) << part.err;

    const Outcome other = run({"render", "quads.gltf", "--samples", "128", "--sample-range", "0:64", "--method",
                               "stochastic", "-o", "other.exr"});
    expectOneLine(other, 2);
    EXPECT_NE(other.err.find("'stochastic' cannot add"), std::string::npos) << other.err;
}

TEST_F(Render, statsHaveTheStatedKeys) {
    ASSERT_EQ(render({"--stats", "stats.json", "--lod", "off", "--wave", "2"}).exitCode, 0);
    const json stats = json::parse(textOf(folder() / "stats.json"));
    for (const char* key : {"renderMilliseconds", "setupMilliseconds", "gpuMilliseconds", "pyramidMilliseconds",
                            "loadMilliseconds", "peakBytes", "gpuBytes", "largestBlur"})
        EXPECT_GE(stats.at(key).get<double>(), 0) << key;
    for (const char* key : {"device", "driver", "gpuMillisecondsNote", "layerFormat", "version"})
        EXPECT_NE(stats.at(key).get<std::string>(), "") << key;
    EXPECT_TRUE(stats.at("command").get<std::string>().ends_with(
        " render quads.gltf --size 128x96 --samples 4 --stats stats.json --lod off --wave 2"))
        << stats.at("command");
    EXPECT_EQ(stats.at("commit"), programCommit());
    EXPECT_TRUE(std::regex_match(stats.at("date").get<std::string>(), std::regex("20\\d\\d-\\d\\d-\\d\\dT[0-9:]{8}Z")));
    EXPECT_EQ(stats.at("samples"), 4);
    EXPECT_EQ(stats.at("wave"), 2);
    EXPECT_EQ(stats.at("trianglesDrawn"), 2 * 2 * 4);  // two squares of two triangles each, drawn in four samples
    EXPECT_GT(stats.at("peakBytes").get<double>(), 1e6);
}

TEST_F(Render, aovsHoldDepthBlurAndLevel) {
    ASSERT_EQ(render({"-o", "a.png", "--aov", "depth,coc,level", "--focus-distance", "4"}).exitCode, 0);
    for (const char* name : {"a.png", "a.depth.exr", "a.coc.exr", "a.level.exr", "a.level.png"})
        EXPECT_TRUE(fs::exists(folder() / name)) << name;
    const Image coc = readImage(folder() / "a.coc.exr");
    const Image level = readImage(folder() / "a.level.exr");
    // CoC = A·(1/s − 1/z)·W/(2 tan(θx/2)), with the aperture diameter A = 50/2.8 mm, the focus distance s = 4 m, the
    // depth z, the image width W in px and the horizontal field of view θx. The CoC is negative at z = 2 m and positive
    // at z = 8 m.
    const double aperture = 0.05 / 2.8;
    EXPECT_NEAR(*coc.at(63, 21), aperture * (1 / 4.0 - 1 / 2.0) * 128 / 0.72, 1e-4);
    EXPECT_NEAR(*coc.at(126, 48), aperture * (1 / 4.0 - 1 / 8.0) * 128 / 0.72, 1e-4);
    EXPECT_EQ(*level.at(63, 21), 0);
    EXPECT_EQ(*level.at(10, 80), -1);
}

TEST_F(Render, workIsThatOfAllSamplesHoweverManyAreDrawnAtOnce) {
    Image images[2];
    for (int i = 0; i < 2; ++i) {
        const Outcome outcome = render({"-o", "a.png", "--aov", "work", "--wave", i == 0 ? "1" : "3"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("triangles per pixel and lens sample"), std::string::npos) << outcome.err;
        EXPECT_TRUE(fs::exists(folder() / "a.work.png"));
        images[i] = readImage(folder() / "a.work.exr");
    }
    EXPECT_EQ(images[0].channels, 1);
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(*images[0].at(63, 21), 4);  // one triangle of the square "Near", in each of four samples
    EXPECT_EQ(*images[0].at(10, 80), 0);
}

TEST_F(Render, transparentBackgroundHasNoCoverage) {
    ASSERT_EQ(render({"-o", "a.exr", "--background", "none", "--no-dof"}).exitCode, 0);
    const Image image = readImage(folder() / "a.exr");
    ASSERT_EQ(image.channels, 4);
    EXPECT_EQ(image.at(10, 80)[3], 0);
    EXPECT_EQ(image.at(63, 21)[3], 1);
}

TEST_F(Render, uniformBackgroundIsThatColour) {
    ASSERT_EQ(render({"-o", "a.exr", "--background", "0.25,0.5,2"}).exitCode, 0);
    const Image image = readImage(folder() / "a.exr");
    EXPECT_EQ(image.at(10, 80)[0], 0.25f);
    EXPECT_EQ(image.at(10, 80)[1], 0.5f);
    EXPECT_EQ(image.at(10, 80)[2], 2.0f);
}

TEST_F(Render, fullDiskIsOneLineAndKeepsTheFileThatWasThere) {
    std::ofstream(folder() / "a.exr") << "kept";
    const Outcome outcome = render({"-o", "a.exr"}, 512);
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("cannot write a.exr"), std::string::npos) << outcome.err;
    EXPECT_EQ(textOf(folder() / "a.exr"), "kept");
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(Render, shaderFaultsNameTheShader) {
    fs::create_directories(folder() / "shaders" / "accumulation");
    std::ofstream(folder() / "shaders" / "accumulation" / "object.frag") << "#version 450\nnot a shader\n";
    const Outcome outcome = render({"--shader-dir", "shaders"});
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("accumulation/object.frag"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace defocus::engine
