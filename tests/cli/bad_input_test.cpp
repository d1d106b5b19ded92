// Tests that each input error prints one line on stderr, gives a nonzero exit code and leaves no file behind.

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/two_quads.h"
#include "core/file.h"
#include "image/image_io.h"
#include "models.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class BadInput : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        writeTwoQuads(folder() / "quads.gltf");
    }

    // Expects that `defocus render` with `arguments` fails before it writes a file, and prints one line that contains
    // `part`.
    void expectFault(int exitCode, const std::string& part, std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"render", "quads.gltf"});
        const Outcome outcome = run(arguments);
        SCOPED_TRACE(arguments.back());
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(fileCount(), 1u);
    }

    // Expects that `plan` and `info` either reject the file with one line that contains its name, or succeed and print
    // output. Returns whether `info` rejects the file.
    bool expectRefusedOrLoaded(const fs::path& model) const {
        SCOPED_TRACE(model);
        bool refused = false;
        for (const char* command : {"plan", "info"}) {
            const Outcome outcome = run({"--quiet", command, model.string()});
            refused = outcome.exitCode != 0;
            if (!refused) {
                EXPECT_EQ(outcome.err, "");
                EXPECT_NE(outcome.out, "");
                continue;
            }
            expectOneLine(outcome, 1);
            EXPECT_NE(outcome.err.find(model.stem().string()), std::string::npos) << outcome.err;
        }
        return refused;
    }
};

TEST_F(BadInput, valuesOutOfRange) {
    expectFault(2, "1 to 65536", {"--samples", "0"});
    expectFault(2, "1 to 65536", {"--samples", "10000000"});
    expectFault(2, "1 to 65536", {"--samples", "-4"});
    expectFault(2, "1 to 65536", {"--samples", "1.5"});
    expectFault(2, "1 to 65536, or auto", {"--samples", "-1"});
    expectFault(2, "-60 to 60, or auto", {"--exposure", "foo"});
    expectFault(2, "--fstop", {"--fstop", "0"});
    expectFault(2, "--fstop", {"--fstop", "-1"});
    expectFault(2, "--focus-distance", {"--focus-distance", "0"});
    expectFault(2, "--focus-distance", {"--focus-distance", "-2"});
    expectFault(2, "--focal-length", {"--focal-length", "0"});
    expectFault(2, "--horizontal-aperture", {"--horizontal-aperture", "0"});
    expectFault(2, "--anamorphic-ratio", {"--anamorphic-ratio", "0"});
    expectFault(2, "--blur-scale", {"--blur-scale", "-1"});
    expectFault(2, "--blades", {"--blades", "1"});
    expectFault(2, "--blades", {"--blades", "2"});
    // A focus plane that is tilted by 90° contains the view axis.
    expectFault(2, "--focus-tilt", {"--focus-tilt", "90"});
    expectFault(2, "--focus-swing", {"--focus-swing=-90"});
    expectFault(2, "--exposure-time", {"--exposure-time=-1"});
    expectFault(2, "--exposure-time", {"--exposure-time", "1/0"});
    expectFault(2, "--iso", {"--iso", "0"});
    expectFault(2, "excludes", {"--exposure-time", "1", "--exposure", "2"});
    expectFault(2, "--wave", {"--wave", "65"});
    expectFault(2, "--threads", {"--threads", "0"});
    expectFault(2, "--seed", {"--seed", "4294967296"});
    expectFault(2, "--target-error", {"--target-error", "0"});
    expectFault(2, "--target-error", {"--target-error=-0.1"});
    expectFault(2, "--target-error", {"--target-error", "2"});
    expectFault(2, "--time-limit", {"--time-limit", "0"});
    expectFault(2, "--time-limit", {"--time-limit=-5"});
    expectFault(2, "--background", {"--background", "1,2"});
    expectFault(2, "--background", {"--background", "1,-2,3"});
}

TEST_F(BadInput, settingsThatTheMethodDoesNotTake) {
    expectFault(2, "did you mean 'circular'", {"--method", "circulr"});
    // --taps belongs to the method scheuermann, but the method is accumulation
    expectFault(2, "no settings", {"--taps", "16"});
    expectFault(2, "far-components must be an integer from 1 to 9", {"--method", "circular", "--far-components", "10"});
    expectFault(2, "storage must be one of", {"--method", "circular:storage=double"});
    expectFault(2, "no setting 'taps'", {"--method", "circular:taps=8"});
    expectFault(2, "SETTING=VALUE", {"--method", "circular:half"});
    expectFault(2, "in blocks, which a target error requires", {"--method", "circular", "--target-error", "0.01"});
    expectFault(2, "in blocks, which a time limit requires", {"--method", "scheuermann", "--time-limit", "1"});
    expectFault(2, "exact motion", {"--target-error", "0.01", "--shutter", "1", "--motion-segments", "exact"});
    expectFault(2, "--sample-range", {"--target-error", "0.01", "--sample-range", "0:64", "-o", "a.exr"});
    expectFault(1, "--lod-metric measured accepts only --light-threshold",
                {"--lod-metric", "measured", "--blur-threshold", "0.1"});
    expectFault(1, "--lod-metric size accepts only --blur-threshold and --size-threshold",
                {"--light-threshold", "0.1", "--size-threshold", "2"});
    expectFault(1, "--lod-metric error accepts only --blur-threshold and --size-threshold",
                {"--lod-metric", "error", "--light-threshold", "0.1"});
}

TEST_F(BadInput, numbersThatAreNoneOrInfinite) {
    for (const char* option : {"--fstop", "--focal-length", "--horizontal-aperture", "--focus-distance",
                               "--blade-rotation", "--anamorphic-ratio", "--blur-scale", "--time", "--blur-threshold",
                               "--size-threshold", "--light-threshold", "--exposure", "--target-error", "--time-limit"})
        expectFault(2, option, {std::string(option) + "=nan"});
    expectFault(2, "--focus-distance", {"--focus-distance=inf"});
    expectFault(2, "--exposure", {"--exposure=-inf"});
}

TEST_F(BadInput, sizes) {
    for (const char* size : {"0x768", "100000x100000", "1024x16385", "1024"})
        expectFault(2, "--size", {"--size", size});
}

TEST_F(BadInput, wordsThatAreNotKnown) {
    expectFault(2, "did you mean '--samples'", {"--smaples", "10"});
    expectFault(2, "did you mean 'fractional'", {"--lod", "fractoinal"});
    expectFault(2, "did you mean 'halton'", {"--sequence", "haltno"});
    expectFault(2, "size, error, measured, proportional, score", {"--lod-metric", "speed"});
    expectFault(2, "did you mean 'accumulation'", {"--method", "acumulation"});
    expectFault(2, "none, aces, agx", {"--tonemap", "filmic"});
    expectFault(2, "depth, coc, level, work", {"--aov", "depth,normal"});
    expectFault(2, "another.gltf", {"another.gltf"});
    expectOneLine(run({"render", ""}), 2);
    expectFault(2, "excludes", {"--fish", "3"});
    expectFault(2, "excludes", {"--focus-distance", "1", "--focus-node", "Near"});
}

TEST_F(BadInput, wrongCommands) {
    expectOneLine(run({}), 2);
    const Outcome mistyped = run({"rendr", "quads.gltf"});
    expectOneLine(mistyped, 2);
    EXPECT_NE(mistyped.err.find("did you mean 'render'"), std::string::npos) << mistyped.err;
    const Outcome unknown = run({"xyzzy"});
    expectOneLine(unknown, 2);
    for (const char* name : {"render", "plan", "info", "pyramid", "compare", "bench", "cache"})
        EXPECT_NE(unknown.err.find(name), std::string::npos) << unknown.err;
}

TEST_F(BadInput, wrongCommandsWithinACommand) {
    const Outcome none = run({"bench"});
    expectOneLine(none, 2);
    EXPECT_NE(none.err.find("speedup"), std::string::npos) << none.err;
    const Outcome mistyped = run({"bench", "speedip"});
    expectOneLine(mistyped, 2);
    EXPECT_NE(mistyped.err.find("did you mean 'speedup'"), std::string::npos) << mistyped.err;
    expectOneLine(run({"bench", "speedup", "--counts", "0"}), 2);
    expectOneLine(run({"bench", "speedup", "--runs", "0"}), 2);
    expectOneLine(run({"bench", "speedup", "--fstops", "-1"}), 2);
}

TEST_F(BadInput, namesThatAreNotInTheFileListThoseThatAre) {
    expectFault(1, "Main", {"--camera", "Second"});
    expectFault(1, "Near, Far, Tripod", {"--focus-node", "Middle"});
    const Outcome inTheSchool = run({"plan", "--fish", "1", "--fish-triangles", "200", "--camera", "Second"});
    expectOneLine(inTheSchool, 1);
    EXPECT_NE(inTheSchool.err.find("Camera"), std::string::npos) << inTheSchool.err;
}

TEST_F(BadInput, focusThatTheSceneDoesNotHave) {
    expectFault(1, "no surface", {"--focus-pixel", "0,767"});
    expectFault(1, "outside", {"--focus-pixel", "1024,0"});
    expectFault(2, "--focus-pixel", {"--focus-pixel", "-1,0"});
    expectFault(1, "behind the camera", {"--focus-node", "Tripod"});
    expectFault(1, "focus breathing", {"--focus-breathing", "--focal-length", "50", "--focus-distance", "0.05"});
}

TEST_F(BadInput, focusPlanesThatNoLensHas) {
    expectFault(1, "line", {"--focus-points", "512,160,512,170,512,180"});
    expectFault(1, "no surface", {"--focus-points", "0,767,512,170,512,180"});
    // All three pixels show points 0.3 m above the view axis: one on the near quad and two on the far quad. The plane
    // through these points is parallel to the axis.
    expectFault(1, "view axis", {"--focus-points", "512,170,956,330,832,330"});
    expectFault(2, "--focus-points", {"--focus-points", "1,2,3,4"});
}

TEST_F(BadInput, whatOnlyMakesLittleSenseIsALine) {
    const auto warning = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"info", "quads.gltf", "--camera"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        return outcome.err;
    };
    EXPECT_NE(
        warning({"--focal-length", "50", "--focus-distance", "0.05"}).find("does not exceed the focal length of 50 mm"),
        std::string::npos);
    EXPECT_NE(warning({"--iso", "400"}).find("--exposure-time"), std::string::npos);
}

TEST_F(BadInput, questionsAboutACamera) {
    const auto expectInfoFault = [&](int exitCode, const std::string& part, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"info", "quads.gltf"});
        const Outcome outcome = run(arguments);
        SCOPED_TRACE(arguments.back());
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    };
    expectInfoFault(2, "--camera", {"--depths", "1"});
    expectInfoFault(2, "--camera", {"--fstop", "2"});
    expectInfoFault(2, "--depths", {"--camera", "--depths", "1,,2"});
    expectInfoFault(2, "--depths", {"--camera", "--depths", "0"});
    expectInfoFault(2, "--acceptable-coc", {"--camera", "--acceptable-coc", "0"});
    expectInfoFault(1, "Main", {"--camera=Second"});
    expectInfoFault(1, "focus breathing",
                    {"--camera", "--focus-breathing", "--focal-length", "50", "--focus-distance", "0.05"});
}

TEST_F(BadInput, outputsThatCannotBeWritten) {
    expectFault(1, "missing/out.exr", {"-o", "missing/out.exr"});
    expectFault(1, "quads.gltf/out.exr", {"-o", "quads.gltf/out.exr"});
    expectFault(1, ".exr, .png", {"-o", "out.gif"});
    expectFault(1, ".exr, .png", {"-o", "out"});
    expectFault(1, "missing/stats.json", {"--stats", "missing/stats.json"});
    fs::create_directory(folder() / "images.png");
    const Outcome outcome = run({"render", "quads.gltf", "-o", "images.png"});
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("is a folder"), std::string::npos) << outcome.err;
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(BadInput, filesThatAreNoScene) {
    std::ofstream(folder() / "text.gltf") << "not JSON";
    std::ofstream(folder() / "picture.png") << "not a picture";
    for (const char* command : {"render", "plan", "info"})
        for (const char* name : {"missing.glb", ".", "text.gltf", "picture.png"}) {
            const Outcome outcome = run({command, name});
            SCOPED_TRACE(name);
            expectOneLine(outcome, 1);
            EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        }
    EXPECT_EQ(fileCount(), 3u);
}

TEST_F(BadInput, environmentsThatAreNone) {
    expectFault(1, "missing.hdr", {"--environment", "missing.hdr"});
    expectFault(1, "quads.gltf", {"--environment", "quads.gltf"});
}

TEST_F(BadInput, environmentsWithTexelsThatAreNoNumbers) {
    Image image(4, 2, 3);
    *image.at(1, 1) = std::numeric_limits<float>::quiet_NaN();
    writeImage(folder() / "nan.exr", image);
    // NaN texels become black. The environment map therefore loads, and the only error is the unknown node.
    const Outcome black = run({"render", "quads.gltf", "--environment", "nan.exr", "--focus-node", "None"});
    EXPECT_NE(black.err.find("None"), std::string::npos) << black.err;
    EXPECT_EQ(black.err.find("nan.exr"), std::string::npos) << black.err;
    *image.at(1, 1) = std::numeric_limits<float>::infinity();
    writeImage(folder() / "infinite.exr", image);
    const Outcome outcome = run({"render", "quads.gltf", "--environment", "infinite.exr"});
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("infinite.exr: some pixel values are infinite"), std::string::npos) << outcome.err;
}

TEST_F(BadInput, apertureImagesThatPassNoLight) {
    expectFault(1, "missing.png", {"--aperture-image", "missing.png"});
    expectFault(1, "quads.gltf", {"--aperture-image", "quads.gltf"});
    Image image(4, 4, 1);
    writeImage(folder() / "black.exr", image);
    *image.at(1, 1) = -1;
    writeImage(folder() / "negative.exr", image);
    *image.at(1, 1) = std::numeric_limits<float>::quiet_NaN();
    writeImage(folder() / "nan.exr", image);
    for (const char* name : {"black.exr", "negative.exr", "nan.exr"}) {
        const Outcome outcome = run({"render", "quads.gltf", "--aperture-image", name});
        SCOPED_TRACE(name);
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("aperture"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(fileCount(), 4u);
}

TEST_F(BadInput, devicesAndPipesAreNoFiles) {
    ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
    for (const char* name : {"pipe", "/dev/zero"}) {
        using Words = std::vector<std::string>;
        for (const Words& words : {Words{"info", name},
                                   {"render", "quads.gltf", "--environment", name},
                                   {"plan", "quads.gltf", "--aperture-image", name},
                                   {"compare", name, name},
                                   {"merge", name},
                                   {"capture", name}}) {
            const Outcome outcome = run(words);
            SCOPED_TRACE(words[0] + " " + name);
            expectOneLine(outcome, 1);
            EXPECT_NE(outcome.err.find("device or a pipe"), std::string::npos) << outcome.err;
        }
        std::ofstream(folder() / "shot.json") << nlohmann::json{{"scene", name}, {"range", {0, 1}}};
        const Outcome outcome = run({"capture", "shot.json", "--dry-run"});
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find("device or a pipe"), std::string::npos) << outcome.err;
    }
}

// An output never overwrites an input, and two outputs with the same name are rejected.
TEST_F(BadInput, outputsReplaceNeitherInputsNorEachOther) {
    const std::string scene = textOf(folder() / "quads.gltf");
    expectOneLine(run({"render", "quads.gltf", "-o", "a.png", "--stats", "quads.gltf"}), 1);
    expectOneLine(run({"render", "quads.gltf", "-o", "a.exr", "--stats", "./a.exr"}), 1);
    fs::create_hard_link(folder() / "quads.gltf", folder() / "other.exr");
    expectOneLine(run({"render", "quads.gltf", "-o", "other.exr"}), 1);
    expectOneLine(run({"merge", "other.exr", "-o", "other.exr"}), 1);
    EXPECT_EQ(textOf(folder() / "quads.gltf"), scene);
    EXPECT_FALSE(fs::exists(folder() / "a.png") || fs::exists(folder() / "a.exr"));
}

// For an option of another program, the message suggests the option with the same purpose. For a part of a name, it
// suggests the full name.
TEST_F(BadInput, foreignOptionsAndPartsOfNamesAreUnderstood) {
    const std::map<std::string, std::string> known = {{"--aperture", "--fstop"}, {"--focus", "--focus-distance"},
                                                      {"--width", "--size"},     {"--height=3", "--size"},
                                                      {"--out", "--output"},     {"--focal", "--focal-length"}};
    for (const auto& [foreign, own] : known) expectFault(2, "did you mean '" + own + "'?", {foreign, "4"});
    expectFault(1, "the built-in ones are studio, overcast, sunset", {"--environment", "park"});
    expectFault(1, "did you mean 'studio'?", {"--environment", "stdio"});
    expectFault(1, "did you mean 'Near'?", {"--focus-node", "ear"});
    expectFault(2, "0cm is 0 mm: '0' is not a number", {"--focal-length", "0cm"});
    expectFault(2, "'50 cm' is not a number", {"--focus-distance", "50 cm"});
}

TEST_F(BadInput, switchesTakeNoValue) {
    for (const char* word : {"--dof=1,2", "--ground=0x10", "--keep-all=1e999", "--ground=no"})
        expectFault(2, std::string(word).substr(0, std::string(word).find('=')), {word});
}

// An aperture image named in a scene must be a regular file inside the scene's folder. Pipes, devices and paths outside
// the folder are rejected.
TEST_F(BadInput, apertureImagesOfTheSceneThatAreNoFilesBesideIt) {
    fs::create_directory(folder() / "scenes");
    writeImage(folder() / "outside.png", Image(4, 4, 3));
    ASSERT_EQ(::mkfifo((folder() / "scenes" / "pipe").c_str(), 0600), 0);
    for (const char* name : {"pipe", "/dev/zero", "../outside.png"}) {
        GltfBuilder builder;
        builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
        builder.json["cameras"] = {{{"type", "perspective"},
                                    {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}},
                                    {"extras", {{"apertureImage", name}}}}};
        builder.add("nodes", {{"camera", 0}, {"translation", {0, 0, 3}}});
        GltfBuilder::save(folder() / "scenes" / "scene.glb", builder.glb());
        const Outcome outcome = run({"plan", "scenes/scene.glb"});
        EXPECT_EQ(outcome.exitCode, 0) << name;
        EXPECT_TRUE(outcome.err.starts_with("warning: camera")) << outcome.err;
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("the value is ignored"), std::string::npos) << outcome.err;
    }
}

TEST_F(BadInput, shaderFolderThatIsNone) {
    expectFault(2, "--shader-dir", {"--shader-dir", "missing"});
}

// An error message that cannot be written, because stderr is closed or its device is full, does not change the exit
// code. The program fails if stdout is closed or its device is full.
TEST_F(BadInput, outputsThatCannotBeWrittenTo) {
    const auto exitCode = [&](const std::string& words) {
        const std::string command = fmt::format("cd '{}' && '{}' {}", folder().string(), DEFOCUS_PROGRAM, words);
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    };
    for (const char* errors : {"2>/dev/full", "2>&-"}) {
        EXPECT_EQ(exitCode(fmt::format("info quads.gltf >/dev/null {}", errors)), 0) << errors;
        EXPECT_EQ(exitCode(fmt::format("info missing.gltf >/dev/null {}", errors)), 1) << errors;
        EXPECT_EQ(exitCode(fmt::format("nonsense >/dev/null {}", errors)), 2) << errors;
    }
    for (const char* words : {"info quads.gltf", "info --json quads.gltf", "--help", "--version", "plan quads.gltf"}) {
        EXPECT_EQ(exitCode(fmt::format("{} >/dev/full 2>/dev/null", words)), 1) << words;
        EXPECT_EQ(exitCode(fmt::format("{} >&- 2>/dev/null", words)), 1) << words;
    }
    EXPECT_EQ(fileCount(), 1u);
}

// The program either loads a hostile file or rejects it with a line that names the file; it never crashes.
TEST_F(BadInput, hostileModels) {
    DEFOCUS_MODEL_OR_SKIP(models, "invalid");
    for (const fs::directory_entry& entry : fs::directory_iterator(models)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".gltf" || extension == ".glb") expectRefusedOrLoaded(entry.path());
    }
    EXPECT_EQ(fileCount(), 1u);
}

// No damaged model file crashes the program. The test truncates a copy of a fish at eight lengths, and changes the
// 32-bit words of the GLB header and numbers in the JSON part.
TEST_F(BadInput, damagedCopiesOfAModel) {
    const std::string full = textOf(fs::path(DEFOCUS_SOURCE_DIR) / "meshes/fish.glb");
    ASSERT_GT(full.size(), 10'000u);
    int refused = 0;
    const auto expectDamaged = [&](const std::string& bytes) {
        GltfBuilder::save(folder() / "damaged.glb", bytes);
        refused += expectRefusedOrLoaded(folder() / "damaged.glb") ? 1 : 0;
    };
    for (std::size_t part = 0; part < 8; ++part) expectDamaged(full.substr(0, part * full.size() / 8 + part % 3));
    EXPECT_EQ(refused, 8) << "every damaged copy must be refused";
    for (std::size_t word = 0; word < 5; ++word) {
        std::string changed = full;
        changed[4 * word] = static_cast<char>(changed[4 * word] ^ 0x41);
        expectDamaged(changed);
    }
    EXPECT_EQ(refused, 8 + 5);
    for (const char* name : {"count", "byteOffset", "bufferView", "componentType", "mesh", "byteLength"}) {
        std::string changed = full;
        const std::size_t at = changed.find("\"" + std::string(name) + "\":") + std::string(name).size() + 3;
        ASSERT_LT(at, changed.size()) << name;
        changed[at] = '9';
        expectDamaged(changed);
    }
}

// An empty name, which may come from an unset variable of a script, is refused instead of being read as a default.
TEST_F(BadInput, emptyNames) {
    for (const char* option : {"--environment", "--aperture-image", "--stats", "--cache-dir", "-o"})
        expectFault(2, "the name is empty; give a file or folder, or leave the option out", {option, ""});
    for (const char* command : {"capture", "merge"}) {
        const Outcome outcome = run({command, ""});
        expectOneLine(outcome, 2);
        EXPECT_NE(outcome.err.find("the name is empty"), std::string::npos) << outcome.err;
    }
}

TEST_F(BadInput, malformedSourceDate) {
    for (const char* date : {"", "yesterday", "-1", "1e9", "99999999999999"}) {
        ::setenv("SOURCE_DATE_EPOCH", date, 1);
        expectFault(1, fmt::format("SOURCE_DATE_EPOCH is '{}', not a number", date), {"-o", "a.png"});
    }
    ::unsetenv("SOURCE_DATE_EPOCH");
}

// The program draws the intact triangles of a damaged file and counts the damaged triangles in a warning.
TEST_F(BadInput, trianglesWithoutPlaceAreAWarning) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, nan})}}},
                   {"indices", builder.indices({0, 1, 2, 0, 1, 3, 1, 2, 3})}}});
    GltfBuilder::save(folder() / "damaged.glb", builder.glb());
    for (const char* command : {"plan", "pyramid"}) {
        const Outcome outcome = run({command, "damaged.glb"});
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(outcome.err, "warning: 2 triangles left out: a vertex position is NaN or infinite\n");
        EXPECT_EQ(run({"--quiet", command, "damaged.glb"}).err, "");
    }
}

// --camera-from rejects missing and damaged files, files without a camera, and files with several cameras if none is
// named.
TEST_F(BadInput, camerasOfOtherFiles) {
    const auto refuse = [&](const std::string& name, const std::string& text, const std::string& part) {
        writeFile(folder() / name, std::string_view(text));
        const Outcome outcome = run({"render", "quads.gltf", "--camera-from", name});
        fs::remove(folder() / name);
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(fileCount(), 1u);
    };
    const std::string good = "#usda 1.0\ndef Camera \"a\" { float focalLength = 50 }\n";
    refuse("shot.usda", "PXR-USDC", "usdcat");
    refuse("shot.usda", good.substr(0, good.size() - 3), "line 2");
    refuse("shot.usda", "#usda 1.0\ndef Xform \"a\" {}\n", "no camera");
    refuse("shot.usda", good + "def Camera \"b\" {}\n", "/a, /b");
    refuse("shot.json", "{}", "not a camera");
    refuse("shot.gltf", "{\"asset\": {\"version\": \"2.0\"}}", "no perspective camera");
    expectFault(1, "missing.usda", {"--camera-from", "missing.usda"});
    expectFault(1, "not a camera file", {"--camera-from", "shot.fbx"});
    expectFault(1, "usdcat", {"--camera-from", "shot.usdc:/World/cam"});
    expectFault(2, "--camera", {"--camera-from", "shot.usda", "--camera", "A"});
    expectOneLine(run({"export-camera", "quads.gltf", "-o", "shot.usdc"}), 2);
    expectOneLine(run({"export-camera", "quads.gltf", "-o", "shot.usda", "--range", "5:1"}), 2);
    EXPECT_EQ(fileCount(), 1u);
}

}  // namespace
}  // namespace defocus::engine
