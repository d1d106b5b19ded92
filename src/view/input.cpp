#include "view/input.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lens/circle_of_confusion.h"
#include "scene/pick.h"
#include "view/photographic_stops.h"

namespace defocus {

namespace {

constexpr double clickRadius = 4;     // window units that a click may wander
constexpr double doubleClick = 0.35;  // s
constexpr double dividerReach = 7;    // window units around the divider
constexpr double zoomNotch = 0.88;    // factor on the distance, a notch of the wheel

constexpr KeyHelp keys[] = {
    {"Drag", "orbit (fly mode: look around)"},
    {"Right or Shift drag", "pan"},
    {"Wheel", "zoom"},
    {"Click", "focus on what is under the cursor"},
    {"Double click", "focus on it and frame it"},
    {"Ctrl click", "three points: tilt the focus plane through them"},
    {"Ctrl wheel", "rack focus"},
    {"Shift wheel, [ ]", "open or close the aperture"},
    {"W A S D Q E", "fly (Shift: faster)"},
    {"V", "orbit or fly mode"},
    {"F, Home", "frame the selection, frame all"},
    {"0, 1 … 9", "auto camera, cameras of the file"},
    {"Space", "play or pause the animation"},
    {", .", "one frame back, ahead"},
    {"P, O", "focus peaking, focus plane"},
    {"C, L, J, N, Z", "blur, level, rate, work, wireframe overlay"},
    {"X", "compare: next method on the right"},
    {"M", "difference on the right"},
    {"B", "popping test"},
    {"Ctrl O", "open a scene"},
    {"Ctrl Z, Ctrl Shift Z", "undo, redo"},
    {"Ctrl C", "copy as a command"},
    {"Ctrl E", "export a still"},
    {"Esc", "stop an export or a test"},
    {"K", "key frame of a shot from this view"},
    {"F12", "screenshot of the window"},
    {"F11", "the whole screen"},
    {"H, T", "hide the panel, light or dark"},
    {"Ctrl + −", "interface larger, smaller"},
    {"?, F1", "these keys"},
    {"Ctrl Q", "quit"},
};

void cycleComparison(ViewState& state) {
    state.comparison = state.comparison == Comparison::method
                           ? Comparison::none
                           : static_cast<Comparison>(static_cast<int>(state.comparison) + 1);
    if (state.comparison != Comparison::none && state.display.divider >= 1) state.display.divider = 0.5;
}

void toggleOverlay(ViewState& state, DisplayOverlay overlay) {
    state.display.overlay = state.display.overlay == overlay ? DisplayOverlay::none : overlay;
}

// Keys that choose or switch something in the view.
void handlePlainKey(int code, const InputContext& context, ViewState& state, ViewActions& actions) {
    AnimationState& animation = state.animation;
    switch (code) {
        case '[':
            state.lens.fStop = steppedStop(state.lens.fStop, -1);
            break;
        case ']':
            state.lens.fStop = steppedStop(state.lens.fStop, 1);
            break;
        case 'V':
            state.navigation = state.navigation == Navigation::orbit ? Navigation::fly : Navigation::orbit;
            break;
        case 'F':
            actions.frameSelection = true;
            break;
        case key::home:
            actions.frameAll = true;
            break;
        case '0':
            actions.chooseCamera = "auto";
            break;
        case ',':
            animation.playing = false;
            animation.time -= 1.0 / 24;
            break;
        case '.':
            animation.playing = false;
            animation.time += 1.0 / 24;
            break;
        case 'P':
            state.display.focusPeaking = !state.display.focusPeaking;
            break;
        case 'O':
            state.display.focusPlane = !state.display.focusPlane;
            break;
        case 'C':
            toggleOverlay(state, DisplayOverlay::coc);
            break;
        case 'L':
            toggleOverlay(state, DisplayOverlay::level);
            break;
        case 'J':
            toggleOverlay(state, DisplayOverlay::rate);
            break;
        case 'N':
            toggleOverlay(state, DisplayOverlay::work);
            break;
        case 'Z':
            state.display.wireframe = !state.display.wireframe;
            break;
        case 'X':
            cycleComparison(state);
            break;
        case 'M':
            state.display.difference = !state.display.difference;
            break;
        case 'B':
            actions.togglePopping = true;
            break;
        case 'H':
            state.panel = !state.panel;
            break;
        case 'T':
            state.dark = !state.dark;
            break;
        case key::f1:
            state.help = !state.help;
            break;
        case 'K':
            actions.recordKey = true;
            break;
        case key::f11:
            actions.toggleFullscreen = true;
            break;
        case key::f12:
            actions.screenshot = true;
            break;
        case key::escape:
            if (state.poppingSince) actions.togglePopping = true;
            actions.cancelExport = true;
            state.focusPoints.clear();
            state.help = false;
            break;
        default:
            break;
    }
    if (code == ' ' && !context.navigating) animation.playing = !animation.playing;
    if (code >= '1' && code <= '9' && context.frame != nullptr) {
        const std::vector<std::string> cameras = cameraNames(*context.frame->scene);
        const auto index = static_cast<std::size_t>(code - '1');
        if (index < cameras.size()) actions.chooseCamera = cameras[index];
    }
}

void handleControlKey(const WindowEvent& event, ViewState& state, ViewActions& actions) {
    switch (event.key) {
        case 'O':
            actions.openDialog = true;
            break;
        case 'Z':
            (event.shift ? actions.redo : actions.undo) = true;
            break;
        case 'Y':
            actions.redo = true;
            break;
        case 'C':
            actions.copyCommand = true;
            break;
        case 'E':
            actions.askExport = true;
            break;
        case 'Q':
            actions.quit = true;
            break;
        case '=':
            state.interfaceScale = std::min(3.0, state.interfaceScale * 1.1);
            break;
        case '-':
            state.interfaceScale = std::max(0.5, state.interfaceScale / 1.1);
            break;
        case '0':
            state.interfaceScale = 1;
            break;
        default:
            break;
    }
}

// The focus distance over the depth that is in focus at a point of the picture: 1 but for a focus surface that is
// tilted or curved (q of lens/circle_of_confusion.h).
double focusTerm(const ViewState& state, const PictureArea& area, const glm::dvec2& position) {
    const glm::ivec2 size(glm::max(area.size, glm::dvec2(1)));
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(state.lens, size.x, size.y);
    const glm::dvec2 ndc = area.normalized(position);
    const double radius2 = ndc.x * ndc.x + ndc.y * ndc.y / (coc.aspect * coc.aspect);
    return std::max(1e-3, 1 + coc.curvature * radius2 + glm::dot(coc.tilt, ndc));
}

void zoom(ViewState& state, double notches) {
    state.followsCamera = false;
    state.camera = zoomed(state.camera, std::pow(zoomNotch, notches));
}

double farFocus(const ViewState& state) {
    return state.pull ? state.pull->to : state.lens.focusDistance;
}

}  // namespace

std::vector<std::string> cameraNames(const Scene& scene) {
    std::vector<std::string> names;
    for (const Node& node : scene.nodes) {
        if (node.camera < 0) continue;
        const Camera& camera = scene.cameras[static_cast<std::size_t>(node.camera)];
        const std::string& name = camera.name.empty() ? node.name : camera.name;
        if (!name.empty() && !camera.orthographic) names.push_back(name);
    }
    return names;
}

std::span<const KeyHelp> keyHelp() {
    return keys;
}

glm::dvec2 PictureArea::normalized(const glm::dvec2& position) const {
    const glm::dvec2 share = (position - origin) / size;
    return {2 * share.x - 1, 1 - 2 * share.y};
}

bool PictureArea::contains(const glm::dvec2& position) const {
    const glm::dvec2 share = (position - origin) / size;
    return share.x >= 0 && share.x < 1 && share.y >= 0 && share.y < 1;
}

glm::dvec2 tanHalfFov(const ViewState& state, const PictureArea& area) {
    const double horizontal = tanHalfHorizontalFov(state.lens);
    return {horizontal, horizontal * area.size.y / area.size.x};
}

std::optional<PickedSurface> pickedSurface(const PreparedFrame& frame, const ViewState& state, const PictureArea& area,
                                           const glm::dvec2& position) {
    const glm::dvec2 tangents = tanHalfFov(state, area);
    const glm::dvec3 ray = rayThrough(state.camera, area.normalized(position), tangents.x, tangents.y);
    const auto hit = firstHit(*frame.scene, frame.world.pose, state.camera.position(), ray);
    if (!hit || !(hit->distance > 0)) return std::nullopt;
    return PickedSurface{hit->object, hit->distance / glm::length(ray)};
}

void pullFocus(ViewState& state, double distance, double now, double seconds) {
    state.pull = FocusPull{state.lens.focusDistance, distance, now, seconds};
}

void ViewInput::handle(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions) {
    switch (event.type) {
        case WindowEvent::Type::button:
            if (event.pressed)
                press(event, context, state);
            else
                release(event, context, state, actions);
            break;
        case WindowEvent::Type::move:
            drag(event, context, state);
            break;
        case WindowEvent::Type::scroll:
            if (context.mouseOnInterface || !context.area.contains(event.position)) break;
            if (event.control)
                pullFocus(state, rackedFocus(farFocus(state), event.scroll.y), context.now, 0.15);
            else if (event.shift)  // some systems turn the wheel sideways with Shift
                state.lens.fStop = steppedStop(state.lens.fStop, event.scroll.y + event.scroll.x > 0 ? -1 : 1);
            else
                zoom(state, event.scroll.y);
            break;
        case WindowEvent::Type::key:
            hold(event, context);
            if (!event.pressed || (context.typing && event.key != key::f11 && event.key != key::f12)) break;
            if (event.control)
                handleControlKey(event, state, actions);
            else if (event.shift && event.key == '/')
                state.help = !state.help;
            else if (!event.alt && !event.repeated)
                handlePlainKey(event.key, context, state, actions);
            break;
        case WindowEvent::Type::text:  // fields take it, by the interface
            break;
        case WindowEvent::Type::drop:
            if (!event.paths.empty()) actions.open = event.paths.front();
            break;
    }
}

void ViewInput::press(const WindowEvent& event, const InputContext& context, ViewState& state) {
    if (context.mouseOnInterface || !context.area.contains(event.position) || drag_ != Drag::none) return;
    pressedAt_ = last_ = event.position;
    moved_ = false;
    const double divider = context.area.origin.x + state.display.divider * context.area.size.x;
    const bool compares = state.comparison != Comparison::none || state.poppingSince;
    if (compares && event.button == MouseButton::left && std::abs(event.position.x - divider) < dividerReach)
        drag_ = Drag::divider;
    else
        drag_ = event.button == MouseButton::left && !event.shift ? Drag::orbit : Drag::pan;
}

void ViewInput::release(const WindowEvent& event, const InputContext& context, ViewState& state, ViewActions& actions) {
    const bool clicked = drag_ == Drag::orbit && !moved_ && event.button == MouseButton::left;
    drag_ = Drag::none;
    if (!clicked || context.frame == nullptr) return;
    const auto surface = pickedSurface(*context.frame, state, context.area, event.position);
    const glm::dvec2 tangents = tanHalfFov(state, context.area);
    const glm::dvec3 ray = rayThrough(state.camera, context.area.normalized(event.position), tangents.x, tangents.y);
    const auto mark = [&](const glm::dvec3& point, const std::string& name, double distance) {
        state.marker = {true, state.marker.number + 1, point, context.now, name, distance};
    };
    if (!surface) {
        if (!event.control) mark(state.camera.position() + state.camera.pivotDistance * ray, "", 0);
        return;
    }
    const glm::dvec3 point = state.camera.position() + surface->depth * ray;
    if (event.control) {
        state.focusPoints.push_back(point);
        actions.focusThroughPoints = state.focusPoints.size() == 3;
        return;
    }
    state.selected = surface->object;
    const double distance = surface->depth * focusTerm(state, context.area, event.position);
    pullFocus(state, distance, context.now);
    const std::string& name = context.frame->world.pose.objects[static_cast<std::size_t>(surface->object)].name;
    mark(point, name.empty() ? "a surface" : name, distance);
    state.camera.pivotDistance = surface->depth;
    const bool samePlace = glm::length(event.position - lastClickAt_) < clickRadius;
    if (lastClick_ >= 0 && context.now - lastClick_ < doubleClick && samePlace) actions.frameSelection = true;
    lastClick_ = context.now;
    lastClickAt_ = event.position;
}

void ViewInput::drag(const WindowEvent& event, const InputContext& context, ViewState& state) {
    if (drag_ == Drag::none) return;
    if (!moved_ && glm::length(event.position - pressedAt_) < clickRadius) return;
    moved_ = true;
    const glm::dvec2 step = event.position - last_;
    last_ = event.position;
    const double whole = std::min(context.area.size.x, context.area.size.y);
    if (drag_ == Drag::divider) {
        const double share = (event.position.x - context.area.origin.x) / context.area.size.x;
        state.display.divider = std::clamp(share, 0.0, 1.0);
        return;
    }
    state.followsCamera = false;
    if (drag_ == Drag::pan) {
        const double metres = 2 * tanHalfFov(state, context.area).x * state.camera.pivotDistance / context.area.size.x;
        state.camera = panned(state.camera, -step.x * metres, step.y * metres);
        return;
    }
    // Across the picture: half a turn. The scene follows the hand.
    const glm::dvec2 angle = step / whole * std::numbers::pi;
    state.camera = state.navigation == Navigation::orbit ? orbited(state.camera, -angle.x, -angle.y)
                                                         : turned(state.camera, -0.5 * angle.x, -0.5 * angle.y);
}

void ViewInput::hold(const WindowEvent& event, const InputContext& context) {
    if (!event.pressed)
        held_.erase(event.key);
    else if (!event.control && !context.typing)
        held_.insert(event.key);
}

void ViewInput::fly(const InputContext& context, double seconds, ViewState& state) const {
    const auto axis = [&](int positive, int negative) {
        return static_cast<double>(held_.count(positive)) - static_cast<double>(held_.count(negative));
    };
    const glm::dvec3 direction(axis('D', 'A'), axis('E', 'Q'), axis('W', 'S'));
    if (context.typing || direction == glm::dvec3(0)) return;
    const bool fast = held_.count(key::leftShift) + held_.count(key::rightShift) > 0;
    const double speed = 0.5 * state.camera.pivotDistance * (fast ? 4 : 1);  // m a second
    state.followsCamera = false;
    state.camera = flown(state.camera, direction * (speed * std::min(seconds, 0.1)));
}

}  // namespace defocus
