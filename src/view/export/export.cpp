#include "view/export/export.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/stopwatch.h"
#include "frame/report/render_command_text.h"
#include "view/export/shot.h"

namespace defocus::engine {

namespace {

constexpr double exportSlice = 60;  // time per frame that is spent on rendering the still image, ms

// Returns the window's view at the size of the still image to export.
View exportView(const Document& document, const ViewState& state) {
    View view = currentView(document, state);
    const glm::ivec2 size = state.exportSize.value_or(state.pictureSize);
    view.width = size.x;
    view.height = size.y;
    return view;
}

void startStill(std::optional<StillExport>& still, const Document& document, ViewState& state) {
    if (document.draft) {
        sayFault(state, "The simplified meshes are still being built; export the still again in a moment.");
        return;
    }
    state.playing = false;
    Request request = state.options;
    request.exposure = ExposureValue{writeOptions(state).exposure};
    still.emplace(*document.frame, exportView(document, state), request, state.exportPath, document.shaderFolder);
}

// Writes the recorded shot to a file. Returns the command that renders the shot.
std::string writeShot(const Document& document, ViewState& state) {
    const PreparedFrame& frame = *document.frame;
    writeFile(state.shotPath, shotJson({state.options, frame.cameraLens, state.shotKeys, state.animationSpeed,
                                        writeOptions(state), frame.scene->metresPerUnit}));
    std::string command = captureCommand(state.shotPath, state.options);
    say(state,
        fmt::format("{} written. Render it with this command (copied to the clipboard): {}", state.shotPath, command));
    return command;
}

}  // namespace

std::string pictureCommand(const Document& document, const ViewState& state) {
    const View view = exportView(document, state);
    return renderCommand(
        {state.options, *document.frame, view, state.camera.pivotDistance, writeOptions(state), state.exportPath});
}

std::optional<std::string> actOnExport(std::optional<StillExport>& still, const Document& document, ViewState& state,
                                       const ViewActions& actions) {
    if (!document.frame) return std::nullopt;
    if (actions.recordKey) {
        state.shotKeys.push_back({exportView(document, state), state.camera.pivotDistance, state.options.time});
        say(state, fmt::format("Keyframe {} recorded. Save the shot in the Export panel.", state.shotKeys.size()));
    }
    if (actions.cancelExport && still) {
        still.reset();
        say(state, "Export cancelled; no file was written.");
    }
    if (actions.askExport && still) say(state, "A still is being rendered; Esc cancels it.");
    if (actions.askExport && !still && !state.exportDialog) state.exportDialog.emplace();
    if (actions.exportStill && !still) startStill(still, document, state);
    if (actions.saveShot && !state.shotKeys.empty()) return writeShot(document, state);
    if (!actions.copyCommand) return std::nullopt;
    say(state, "Command copied.");
    return pictureCommand(document, state);
}

void stepExport(std::optional<StillExport>& still, ViewState& state) {
    if (!still) return;
    try {
        const Clock::time_point begin = Clock::now();
        bool more = true;
        while (more && millisecondsSince(begin) < exportSlice) more = still->step();
        if (more) return;
        say(state, "Written: " + still->output().string());
    } catch (const Error& error) {
        sayFault(state, error.what());
    }
    still.reset();
}

}  // namespace defocus::engine
