// Writes the state of the window as JSON, for scripts (docs/window.md). NaN and infinity become null.

#include <nlohmann/json.hpp>

#include "core/file.h"
#include "view/window/session.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

constexpr double statsInterval = 0.05;  // seconds between two updates of the state file

std::string dialogName(const Session& session) {
    if (session.openDialog.browser.opened()) return "open";
    if (session.openDialog.desktop.running()) return "desktop";
    if (!session.state.exportDialog) return "";
    return session.state.exportDialog->asksToReplace ? "replace" : "export";
}

ordered_json pictureJson(const Session& session) {
    const LivePicture& picture = session.picture;
    const ViewPicture* const image = picture.image ? &*picture.image : nullptr;
    static const FramePlan empty;
    const FramePlan& plan = image ? image->plan() : empty;
    const KeptImages* const kept = image ? image->keptImages() : nullptr;
    return {
        {"samples", image ? image->samples() : 0},
        {"converged", image && image->converged()},
        {"moving", image && image->moving()},
        {"changes", image ? image->changes() : 0},
        {"begun", image ? image->begun() : 0},
        {"refocused", image && image->refocused()},
        {"lensImages", kept ? kept->drawn() : 0},
        {"workSamples", image ? image->workSamples() : 0},
        {"psnr", image && image->psnr() ? ordered_json(*image->psnr()) : ordered_json()},
        {"warnings", picture.warnings},
        {"drawn", {plan.view.width, plan.view.height, plan.samples.size()}},
        {"wave", image ? image->wave() : 0},
    };
}

ordered_json documentJson(const Session& session) {
    const ViewState& state = session.state;
    const Document& document = session.document;
    const PreparedFrame* const frame = document.frame.get();
    const glm::dvec3 position = state.camera.position();
    const FocusMarker& marker = state.marker;
    const auto selected = static_cast<std::size_t>(state.selected);
    return {
        {"scene", frame ? frame->sceneName : ""},
        {"loading", document.loader.busy()},
        {"draft", document.draft},
        {"cameraPosition", {position.x, position.y, position.z}},
        {"focusDistance", state.lens.focusDistance},
        {"focusTilt", state.lens.focusTilt},
        {"focusSwing", state.lens.focusSwing},
        {"fStop", state.lens.fStop},
        {"focalLength", state.lens.focalLength},
        {"selected", frame && state.selected >= 0 ? frame->world.pose.objects[selected].name : ""},
        {"time", state.options.time},
        {"marker",
         {{"shown", marker.shown}, {"number", marker.number}, {"name", marker.name}, {"distance", marker.distance}}},
        {"undoSteps", document.history.undoSteps()},
        {"redoSteps", document.history.redoSteps()},
        {"exposure", shownExposure(state)},
        {"hidden", state.options.hide},
        {"objects", frame ? frame->world.pose.objects.size() : 0},
        {"views", state.savedViews.size()},
        {"shotKeys", state.shotKeys.size()},
        {"command", frame ? pictureCommand(document, state) : ""},
    };
}

ordered_json windowJson(const Session& session) {
    const ViewState& state = session.state;
    const InputLatency::Summary latency = session.times.latency.summary();
    return {
        {"fault", state.fault},
        // Number of frames drawn. Scripts can wait for it: an input event may affect the values in this file only two
        // frames later.
        {"frames", session.framesDrawn},
        {"typing", inputContext(session).typing},
        {"openPath", state.openPath},
        {"frameMilliseconds", session.times.frame},
        {"inputMilliseconds", {{"count", latency.count}, {"median", latency.median}, {"worst", latency.worst}}},
        {"picture", {0, 0, state.area.size.x, state.area.size.y}},
        {"scale", interfaceScale(session)},
        {"overlay", static_cast<int>(state.display.overlay)},
        {"comparison", static_cast<int>(state.comparison)},
        {"divider", state.display.divider},
        {"poppingTest", state.poppingSince.has_value()},
        {"fullscreen", session.window.fullscreen()},
        {"dialog", dialogName(session)},
        {"exportPath", state.exportPath},
        {"exporting", session.still.has_value()},
        {"exportShare", session.still ? session.still->share() : 0},
        {"places", session.places},
        {"dark", state.dark},
        {"help", state.help},
        {"device", session.window.device()},
    };
}

}  // namespace

void writeStats(Session& session, bool now) {
    const bool due = now || session.statsWrittenAt < 0 || session.state.now - session.statsWrittenAt >= statsInterval;
    if (session.options.stats.empty() || !due) return;
    session.statsWrittenAt = session.state.now;
    ordered_json stats = documentJson(session);
    stats.update(pictureJson(session));
    stats.update(windowJson(session));
    writeFile(session.options.stats, stats.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace defocus::engine
