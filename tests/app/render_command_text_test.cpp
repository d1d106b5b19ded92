// The command of a view, read back by the command line, is the same view.

#include "app/render_command_text.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "app/camera_controls.h"
#include "lens/lens_fields.h"

namespace defocus {
namespace {

SceneOptions smallSchool() {
    SceneOptions options;
    options.fishCount = 2;
    options.trianglesPerFish = 300;
    options.noCache = true;
    return options;
}

// What `defocus render` would make of it.
PreparedFrame placedBy(const std::string& command) {
    CLI::App program;
    CLI::App* render = program.add_subcommand("render");
    SceneOptions options;
    std::string output;
    std::string toneMap;
    double exposure = 0;
    render->add_option("-o", output);
    render->add_option("--tonemap", toneMap);
    render->add_option("--exposure", exposure);
    addSceneOptions(*render, options);
    program.parse(command, true);
    return placeFrame(options);
}

struct ShotRequest {
    SceneOptions options = smallSchool();
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
            EXPECT_NEAR(a.worldFromCamera[column][row], b.worldFromCamera[column][row], 1e-12);
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
        const double before = lensFieldValue(shot.view.lens, field);
        const bool flag = std::holds_alternative<bool Lens::*>(field.member);
        const bool count = std::holds_alternative<int Lens::*>(field.member);
        const double value = flag    ? 1 - before
                             : count ? 6
                                     : std::min(field.most, std::isfinite(before) ? before + 0.25 : 9.5);
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

TEST(RenderCommandText, namesWhatDiffersFromTheStandard) {
    ShotRequest shot;
    shot.options.lod = LodMode::nearest;
    shot.options.samples = 12;
    shot.options.method = "circular:far-components=5";
    const std::string command = shot.command();
    for (const char* part :
         {"defocus render", "--fish 2", "--fish-triangles 300", "-o 'a picture.png'", "--lod nearest", "--samples 12",
          "--method circular:far-components=5", "--exposure=-1.5", "--tonemap agx"})
        EXPECT_NE(command.find(part), std::string::npos) << part << " in " << command;
    EXPECT_EQ(command.find("--seed"), std::string::npos);
    EXPECT_EQ(command.find("--blades"), std::string::npos);
}

TEST(ShellWord, quotesWhatAShellWouldRead) {
    EXPECT_EQ(shellWord("out-1.png"), "out-1.png");
    EXPECT_EQ(shellWord("my file"), "'my file'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    EXPECT_EQ(shellWord("$(rm)"), "'$(rm)'");
    EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace defocus
