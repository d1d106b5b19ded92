// Tests that the `defocus render` command that the viewer writes for its view gives the same view when it is parsed.

#include "frame/report/render_command_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "cli/commands/render.h"
#include "frame/program_facts.h"
#include "frame/settings/presets.h"
#include "frame/settings/settings.h"
#include "frame/setup/exposure.h"
#include "lens/lens_fields.h"
#include "lens/photographic_exposure.h"
#include "view/random_view.h"
#include "view/state/camera_controls.h"

namespace defocus::engine {
namespace {

Request smallSchool() {
    Request options;
    options.fishCount = 2;
    options.trianglesPerFish = 300;
    options.noCache = true;
    return options;
}

// Splits a command into words as a shell does.
std::vector<std::string> shellWords(const std::string& command) {
    const std::string line = "for word in " + command + "; do printf '%s\\n' \"$word\"; done";
    std::FILE* shell = ::popen(line.c_str(), "r");
    std::vector<std::string> words(1);
    for (int letter = std::fgetc(shell); letter != EOF; letter = std::fgetc(shell)) {
        if (letter == '\n')
            words.emplace_back();
        else
            words.back() += static_cast<char>(letter);
    }
    words.pop_back();
    EXPECT_EQ(::pclose(shell), 0) << command;
    return words;
}

// Parses the arguments of a `defocus render` command.
RenderArguments argumentsOf(const std::string& command) {
    CLI::App program;
    RenderArguments arguments;
    addRenderOptions(*program.add_subcommand("render"), arguments);
    std::vector<std::string> words = shellWords(command);
    std::reverse(words.begin() + 1, words.end());  // CLI11 expects reversed arguments without the program's name
    words.erase(words.begin());
    program.parse(words);
    return arguments;
}

PreparedFrame placedBy(const std::string& command) {
    return placeFrame(argumentsOf(command).request);
}

struct ShotRequest {
    Request options = smallSchool();
    PreparedFrame frame = placeFrame(options);
    View view = frame.view;
    double pivotDistance = 2;
    [[nodiscard]] std::string command() const {
        return renderCommand({options, frame, view, pivotDistance, {ToneMap::agx, -1.5}, "a picture.png"});
    }
};

void expectSameView(const View& a, const View& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(a.worldFromCamera[column][row], b.worldFromCamera[column][row], 1e-11);
    for (const LensField& field : lensFields())
        EXPECT_DOUBLE_EQ(lensFieldValue(a.lens, field), lensFieldValue(b.lens, field)) << field.name;
}

TEST(RenderCommandText, isTheViewAgain) {
    ShotRequest shot;
    const ViewCamera camera = orbited(panned({shot.view.worldFromCamera, 2}, -0.4, 0.1), 0.7, -0.2);
    shot.view.worldFromCamera = camera.worldFromCamera;
    shot.view.width = 320;
    shot.view.height = 200;
    shot.view.lens.fStop = 1.4;
    shot.view.lens.focusDistance = 1.2345678901234567;
    shot.view.lens.bladeCount = 7;
    shot.view.lens.bladeRotation = 0.3;
    shot.view.lens.foregroundLimit = 12.5;
    shot.view.lens.focusTilt = -0.2;
    shot.view.lens.focusBreathing = true;
    expectSameView(placedBy(shot.command()).view, shot.view);
}

TEST(RenderCommandText, everyLensFieldArrives) {
    for (const LensField& field : lensFields()) {
        ShotRequest shot;
        shot.view.lens.focusDistance = 3;
        // ISO has no effect without an exposure time
        if (field.name == std::string_view("iso")) shot.view.lens.exposureTime = 0.01;
        const double before = lensFieldValue(shot.view.lens, field);
        const bool flag = std::holds_alternative<bool Lens::*>(field.member);
        const bool count = std::holds_alternative<int Lens::*>(field.member);
        const double value = flag    ? 1 - before
                             : count ? 6
                                     : std::min(field.max, std::isfinite(before) ? before + 0.25 : 9.5);
        setLensField(shot.view.lens, field, value);
        SCOPED_TRACE(field.name);
        expectSameView(placedBy(shot.command()).view, shot.view);
    }
}

TEST(RenderCommandText, aRolledCameraStaysRolled) {
    ShotRequest shot;
    shot.view.worldFromCamera = shot.view.worldFromCamera * glm::rotate(glm::dmat4(1.0), 2.5, glm::dvec3(0, 0, 1));
    expectSameView(placedBy(shot.command()).view, shot.view);
}

TEST(RenderCommandText, aCameraThatLooksStraightDownStaysSo) {
    ShotRequest shot;
    shot.view.worldFromCamera = glm::inverse(glm::lookAt(glm::dvec3(0, 4, 1), glm::dvec3(0, 1, 1), {0, 0, -1}));
    expectSameView(placedBy(shot.command()).view, shot.view);
}

// The command overrides boolean lens settings in a camera's extras, both from on to off and from off to on.
TEST(RenderCommandText, switchesBackWhatTheCameraSwitched) {
    ShotRequest shot;
    shot.frame.cameraLens.dofEnabled = false;
    shot.frame.cameraLens.focusBreathing = true;
    const std::string command = shot.command();
    EXPECT_NE(command.find(" --dof"), std::string::npos) << command;
    EXPECT_NE(command.find(" --no-focus-breathing"), std::string::npos) << command;
    const Lens lens = placedBy(command).view.lens;
    EXPECT_TRUE(lens.dofEnabled);
    EXPECT_FALSE(lens.focusBreathing);
}

// If the camera moves while the shutter is open, the command names the camera of the scene file instead of a position.
TEST(RenderCommandText, aCameraThatMovesDuringTheExposureIsTheFiles) {
    ShotRequest shot;
    shot.view.shutterCameras = {shot.view.worldFromCamera, shot.view.worldFromCamera};
    shot.options.camera = NamedCamera{"Flying camera"};
    const RenderArguments arguments = argumentsOf(shot.command());
    EXPECT_FALSE(arguments.request.cameraPosition);
    EXPECT_EQ(arguments.request.camera, CameraChoice(NamedCamera{"Flying camera"}));
}

TEST(RenderCommandText, namesWhatDiffersFromTheStandard) {
    ShotRequest shot;
    shot.options.lod = LodMode::nearest;
    shot.options.samples = 12;
    setByName(shot.options, "method", "circular:far-components=5");
    const std::string command = shot.command();
    for (const char* part :
         {"defocus render", "--fish 2", "--fish-triangles 300", "-o 'a picture.png'", "--lod nearest", "--samples 12",
          "--method circular:far-components=5", "--exposure=-1.5", "--tonemap agx"})
        EXPECT_NE(command.find(part), std::string::npos) << part << " in " << command;
    EXPECT_EQ(command.find("--seed"), std::string::npos);
    EXPECT_EQ(command.find("--blades"), std::string::npos);
}

// Expects equal options, except options of camera, lens and exposure, which the command takes from the view.
void expectSameOptions(const Request& a, const Request& b) {
    for (const Setting& setting : settings()) {
        if (setting.group == SettingGroup::camera || setting.group == SettingGroup::lens ||
            setting.group == SettingGroup::display)
            continue;
        if (setting.kind == SettingKind::path)  // the command writes the path -x as ./-x
            EXPECT_EQ(std::filesystem::path(setting.text(a).value_or("")).lexically_normal(),
                      setting.text(b).value_or(""));
        else
            EXPECT_EQ(setting.text(a), setting.text(b)) << setting.name;
    }
    EXPECT_EQ(a.lens.apertureImage.lexically_normal(), b.lens.apertureImage);
    EXPECT_EQ(a.nodeBlur, b.nodeBlur);
    EXPECT_EQ(a.camera, b.camera);
}

TEST(RenderCommandText, ofAnyViewIsReadBackAsThatView) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        Dice dice(seed);
        const Request options = randomOptions(dice);
        PreparedFrame frame;
        frame.scene = std::make_shared<Scene>();
        changeFields(frame.cameraLens, dice);
        View view;
        view.lens = frame.cameraLens;
        changeFields(view.lens, dice);
        view.width = dice.integer(1, 4000);
        view.height = dice.integer(1, 4000);
        view.worldFromCamera = randomCamera(dice);
        WriteOptions write{static_cast<ToneMap>(dice.integer(0, 3)), dice.coin() ? dice.number(-5, 5) : 0};
        if (view.lens.exposureTime > 0) write.exposure = photographicExposure(view.lens);
        const std::string command = renderCommand({options, frame, view, dice.number(0.1, 20), write, "-out.png"});
        SCOPED_TRACE(command);

        const RenderArguments read = argumentsOf(command);
        expectSameOptions(read.request, options);
        EXPECT_EQ(read.outputs, std::vector<std::filesystem::path>{"./-out.png"});
        EXPECT_EQ(read.request.toneMap, write.toneMap);
        Lens lens = frame.cameraLens;
        EXPECT_TRUE(setLensFields(lens, givenLensValues(read.request)).empty());
        EXPECT_DOUBLE_EQ(unmeteredExposure(read.request, lens), write.exposure);
        if (!(view.lens.exposureTime > 0)) {  // with an exposure time, the exposure value does not apply
            lens.exposureTime = view.lens.exposureTime;
            lens.iso = view.lens.iso;
        }
        View again;
        again.lens = lens;
        again.width = read.request.size.width;
        again.height = read.request.size.height;
        again.worldFromCamera = glm::inverse(glm::lookAt(asVector(read.request.cameraPosition.value()),
                                                         asVector(read.request.cameraTarget.value()),
                                                         asVector(read.request.cameraUp.value_or(Vector3{0, 1, 0}))));
        expectSameView(again, view);
    }
}

// The command names a preset instead of its settings. Once one of these settings changes, the command lists all of
// them.
TEST(RenderCommandText, namesAPresetOrItsSettings) {
    Request options;
    applyPreset(presetNamed("jeong2011"), options);
    PreparedFrame frame;
    frame.scene = std::make_shared<Scene>();
    View view;
    const auto command = [&] { return renderCommand({options, frame, view, 1, {}, "out.png"}); };
    EXPECT_NE(command().find(" --preset jeong2011"), std::string::npos) << command();
    EXPECT_EQ(command().find("--lod-"), std::string::npos) << command();
    EXPECT_EQ(command().find("--sequence"), std::string::npos) << command();
    expectSameOptions(argumentsOf(command()).request, options);

    options.sequence = Sequence::r2;
    EXPECT_EQ(command().find("--preset"), std::string::npos) << command();
    EXPECT_NE(command().find(" --level-vertices surviving"), std::string::npos) << command();
    expectSameOptions(argumentsOf(command()).request, options);
}

TEST(CaptureCommand, saysWhatNoShotFileSays) {
    Request options;
    options.lens.apertureImage = "my star.png";
    options.nodeBlur = {{"Fish 3", 0}};
    options.samples = 9;  // not in the command, because the shot contains the number of samples
    EXPECT_EQ(captureCommand("-a shot.json", options),
              "defocus capture './-a shot.json' --aperture-image 'my star.png' --node-blur 'Fish 3=0'");
    EXPECT_EQ(captureCommand("shot.json", {}), "defocus capture shot.json");
}

TEST(ShellWord, quotesWhatAShellWouldRead) {
    EXPECT_EQ(shellWord("out-1.png"), "out-1.png");
    EXPECT_EQ(shellWord("my file"), "'my file'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    EXPECT_EQ(shellWord("$(rm)"), "'$(rm)'");
    EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace defocus::engine
