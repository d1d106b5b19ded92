#include "view/state/view_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "core/error.h"
#include "core/message.h"
#include "frame/setup/focus.h"
#include "frame/setup/moment.h"
#include "lens/photographic_exposure.h"
#include "scene/animation.h"
#include "scene/pick.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxMessages = 4;
constexpr double maxTimeStep = 0.25;  // max time by which a frame advances the animation, s

void addMessage(ViewState& state, std::string text, bool fault, double seconds) {
    state.messages.push_back({std::move(text), fault, state.now + seconds});
    if (state.messages.size() > maxMessages) state.messages.pop_front();
}

void frameBounds(const Bounds& bounds, ViewState& state) {
    const glm::dvec2 tangents = tanHalfFov(state.lens, state.area);
    state.camera = framed(state.camera, bounds, tangents.x, tangents.y);
    state.followsCamera = false;
    pullFocus(state, state.camera.pivotDistance);
}

}  // namespace

glm::dvec2 PictureArea::normalized(const glm::dvec2& position) const {
    const glm::dvec2 share = position / size;
    return {2 * share.x - 1, 1 - 2 * share.y};
}

bool PictureArea::contains(const glm::dvec2& position) const {
    return position.x >= 0 && position.x < size.x && position.y >= 0 && position.y < size.y;
}

glm::dvec2 tanHalfFov(const Lens& lens, const PictureArea& area) {
    const double horizontal = tanHalfHorizontalFov(lens);
    return {horizontal, horizontal * area.size.y / area.size.x};
}

std::optional<PickedSurface> pickedSurface(const PreparedFrame& frame, const ViewCamera& camera, const Lens& lens,
                                           const PictureArea& area, const glm::dvec2& position) {
    const glm::dvec2 tangents = tanHalfFov(lens, area);
    const glm::dvec3 ray = rayThrough(camera, area.normalized(position), tangents.x, tangents.y);
    const auto hit = firstHit(*frame.scene, frame.world.pose, camera.position(), ray);
    if (!hit || !(hit->distance > 0)) return std::nullopt;
    const double depth = hit->distance / glm::length(ray);
    return PickedSurface{hit->object, depth, camera.position() + depth * ray};
}

double shownExposure(const ViewState& state) {
    return state.lens.exposureTime > 0 ? photographicExposure(state.lens) : state.exposure;
}

WriteOptions writeOptions(const ViewState& state) {
    return {state.options.toneMap, shownExposure(state)};
}

void say(ViewState& state, std::string text) {
    addMessage(state, std::move(text), false, 3);
}

void sayFault(ViewState& state, std::string text) {
    state.fault = text;
    if (state.printsFaults) printMessage("defocus: {}\n", text);
    addMessage(state, std::move(text), true, 9);
}

void compare(ViewState& state, Comparison comparison) {
    state.comparison = comparison;
    if (comparison != Comparison::none && state.display.divider >= 1) state.display.divider = 0.5;
}

void pullFocus(ViewState& state, double distance, double seconds) {
    state.pull = FocusPull{state.lens.focusDistance, distance, state.now, seconds};
}

void tiltFocus(ViewState& state) {
    const glm::dmat4 viewFromWorld = glm::inverse(state.camera.worldFromCamera);
    std::array<glm::dvec3, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = viewFromWorld * glm::dvec4(state.focusPoints.at(i), 1);
    state.focusPoints.clear();
    Lens lens = state.lens;
    try {
        focusThrough(points, lens, "focus plane");
        checkLens(lens);
    } catch (const Error& error) {
        sayFault(state, error.what());
        return;
    }
    state.lens = lens;
    state.pull.reset();
    say(state, "The focus plane passes through the three points.");
}

void frameSelection(const PreparedFrame& frame, ViewState& state) {
    if (state.selected < 0) return frameScene(frame, state);
    const Object& object = frame.world.pose.objects[static_cast<std::size_t>(state.selected)];
    const Pyramid& pyramid = frame.world.pyramids[static_cast<std::size_t>(object.mesh)];
    frameBounds(transformed(pyramid.bounds, object.worldFromObject), state);
}

void frameScene(const PreparedFrame& frame, ViewState& state) {
    frameBounds(frame.world.pose.bounds, state);
}

void togglePoppingTest(ViewState& state) {
    state.poppingSince = state.poppingSince ? std::nullopt : std::optional(state.now);
}

void advance(const Scene& scene, ViewState& state, double seconds) {
    if (state.pull) {
        state.lens.focusDistance = state.pull->distanceAt(state.now);
        if (state.pull->over(state.now)) state.pull.reset();
    }
    if (state.poppingSince && state.now - *state.poppingSince > poppingDuration) state.poppingSince.reset();
    state.playing = state.playing && !scene.clips.empty();
    double& time = state.options.time;
    if (state.playing) time += state.animationSpeed * std::min(seconds, maxTimeStep);
    if (scene.clips.empty() || !(state.playing || time < 0)) return;
    const auto clip = static_cast<std::size_t>(clipOf(state.options, scene));
    time = loopedTime(scene.clips[clip], time);
}

std::string clipText(const Scene& scene, int clip) {
    if (clip == 0) return "";
    const std::string& name = scene.clips[static_cast<std::size_t>(clip)].name;
    return !name.empty() && clipNamed(scene, name) == clip ? name : std::to_string(clip);
}

}  // namespace defocus::engine
