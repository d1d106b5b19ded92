#include "view/window/input.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lens/circle_of_confusion.h"
#include "view/state/key_commands.h"
#include "view/state/photographic_stops.h"

namespace defocus::engine {

namespace {

constexpr double clickRadius = 4;     // max mouse movement of a click, window units
constexpr double doubleClick = 0.35;  // max time between the clicks of a double click, s
constexpr double dividerReach = 7;    // max distance from the divider at which a drag moves it, window units
constexpr double zoomNotch = 0.88;    // factor by which a notch of the wheel scales the pivot distance
constexpr double rackTime = 0.15;     // duration of the focus pull per notch, s

// Returns the focus distance divided by the depth in focus at a position of the picture: 1 unless the surface of focus
// is tilted or curved (q in lens/circle_of_confusion.h).
double focusTerm(const ViewState& state, const glm::dvec2& position) {
    const glm::ivec2 size(glm::max(state.area.size, glm::dvec2(1)));
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(state.lens, size.x, size.y);
    const glm::dvec2 ndc = state.area.normalized(position);
    const double radius2 = ndc.x * ndc.x + ndc.y * ndc.y / (coc.aspect * coc.aspect);
    return std::max(1e-3, 1 + coc.curvature * radius2 + glm::dot(coc.tilt, ndc));
}

void scroll(const WindowEvent& event, ViewState& state) {
    if (event.control) {
        const double focus = state.pull ? state.pull->to : state.lens.focusDistance;
        pullFocus(state, rackedFocus(focus, event.scroll.y), rackTime);
    } else if (event.shift) {  // some systems turn Shift + wheel into horizontal scrolling
        state.lens.fStop = steppedStop(state.lens.fStop, event.scroll.y + event.scroll.x > 0 ? -1 : 1);
    } else {
        state.followsCamera = false;
        state.camera = zoomed(state.camera, std::pow(zoomNotch, event.scroll.y));
    }
}

void placeMarker(ViewState& state, const glm::dvec3& point, const std::string& name, double distance) {
    state.marker = {true, state.marker.number + 1, point, state.now, name, distance};
}

// Selects the object of the surface, makes its depth the pivot distance, and pulls the focus to the surface.
void focusOn(const PickedSurface& surface, const Pose& pose, const glm::dvec2& position, ViewState& state) {
    const double distance = surface.depth * focusTerm(state, position);
    const std::string& name = pose.objects[static_cast<std::size_t>(surface.object)].name;
    state.selected = surface.object;
    state.camera.pivotDistance = surface.depth;
    pullFocus(state, distance);
    placeMarker(state, surface.point, name.empty() ? "a surface" : name, distance);
}

}  // namespace

void ViewInput::handle(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions) {
    switch (event.type) {
        case WindowEvent::Type::button:
            if (event.pressed)
                press(event, context, state);
            else
                release(event, context, state);
            break;
        case WindowEvent::Type::move:
            drag(event, state);
            break;
        case WindowEvent::Type::scroll:
            if (!context.mouseOnInterface && state.area.contains(event.position)) scroll(event, state);
            break;
        case WindowEvent::Type::key:
            pressKey(event, context, state, actions);
            break;
        case WindowEvent::Type::text:  // text fields handle this event
            break;
        case WindowEvent::Type::drop:
            if (!event.paths.empty()) actions.open = event.paths.front();
            break;
    }
}

void ViewInput::press(const WindowEvent& event, const InputContext& context, const ViewState& state) {
    if (context.mouseOnInterface || !state.area.contains(event.position) || drag_ != Drag::none) return;
    pressedAt_ = last_ = event.position;
    moved_ = false;
    const double divider = state.display.divider * state.area.size.x;
    const bool compares = state.comparison != Comparison::none || state.poppingSince;
    if (compares && event.button == MouseButton::left && std::abs(event.position.x - divider) < dividerReach)
        drag_ = Drag::divider;
    else
        drag_ = event.button == MouseButton::left && !event.shift ? Drag::orbit : Drag::pan;
}

void ViewInput::release(const WindowEvent& event, const InputContext& context, ViewState& state) {
    const bool clicked = drag_ == Drag::orbit && !moved_ && event.button == MouseButton::left;
    drag_ = Drag::none;
    if (!clicked || context.frame == nullptr) return;
    const auto surface = pickedSurface(*context.frame, state.camera, state.lens, state.area, event.position);
    if (!surface) {
        const glm::dvec2 tangents = tanHalfFov(state.lens, state.area);
        const glm::dvec3 ray = rayThrough(state.camera, state.area.normalized(event.position), tangents.x, tangents.y);
        if (!event.control) placeMarker(state, state.camera.position() + state.camera.pivotDistance * ray, "", 0);
        return;
    }
    if (event.control) {
        state.focusPoints.push_back(surface->point);
        if (state.focusPoints.size() == 3) tiltFocus(state);
        return;
    }
    focusOn(*surface, context.frame->world.pose, event.position, state);
    const bool samePlace = glm::length(event.position - lastClickAt_) < clickRadius;
    if (lastClick_ >= 0 && state.now - lastClick_ < doubleClick && samePlace) frameSelection(*context.frame, state);
    lastClick_ = state.now;
    lastClickAt_ = event.position;
}

void ViewInput::drag(const WindowEvent& event, ViewState& state) {
    if (drag_ == Drag::none) return;
    if (!moved_ && glm::length(event.position - pressedAt_) < clickRadius) return;
    moved_ = true;
    const glm::dvec2 step = event.position - last_;
    last_ = event.position;
    const glm::dvec2 size = state.area.size;
    if (drag_ == Drag::divider) {
        state.display.divider = std::clamp(event.position.x / size.x, 0.0, 1.0);
        return;
    }
    state.followsCamera = false;
    if (drag_ == Drag::pan) {
        const double metres = 2 * tanHalfFov(state.lens, state.area).x * state.camera.pivotDistance / size.x;
        state.camera = panned(state.camera, -step.x * metres, step.y * metres);
        return;
    }
    // A drag over the length of the picture's shorter side orbits by half a turn.
    const glm::dvec2 angle = step / std::min(size.x, size.y) * std::numbers::pi;
    state.camera = state.navigation == Navigation::orbit ? orbited(state.camera, -angle.x, -angle.y)
                                                         : turned(state.camera, -0.5 * angle.x, -0.5 * angle.y);
}

void ViewInput::pressKey(const WindowEvent& event, const InputContext& context, ViewState& state,
                         ViewActions& actions) {
    if (!event.pressed)
        held_.erase(event.key);
    else if (!event.control && !context.typing)
        held_.insert(event.key);
    const bool always = event.key == key::f11 || event.key == key::f12;
    if (!event.pressed || (context.typing && !always)) return;
    if (!event.control && (event.alt || event.repeated)) return;
    if (event.key == ' ' && context.navigating) return;
    runKeyCommand(event.control ? withControl(event.key) : event.key, {context.frame, state, actions, event.shift});
}

void ViewInput::fly(const InputContext& context, double seconds, ViewState& state) const {
    const auto axis = [&](int positive, int negative) {
        return static_cast<double>(held_.count(positive)) - static_cast<double>(held_.count(negative));
    };
    const glm::dvec3 direction(axis('D', 'A'), axis('E', 'Q'), axis('W', 'S'));
    if (context.typing || direction == glm::dvec3(0)) return;
    const bool fast = held_.count(key::leftShift) + held_.count(key::rightShift) > 0;
    const double speed = 0.5 * state.camera.pivotDistance * (fast ? 4 : 1);  // m/s
    state.followsCamera = false;
    state.camera = flown(state.camera, direction * (speed * std::min(seconds, 0.1)));
}

}  // namespace defocus::engine
