#include "view/state/key_commands.h"

#include <algorithm>

#include "gl/window.h"
#include "view/state/photographic_stops.h"

namespace defocus::engine {

namespace {

using K = KeyContext;
using Overlay = DisplayOverlay;

constexpr double frameTime = 1.0 / 24;  // time by which a key advances the animation, s
constexpr double minScale = 0.5;        // limits of the interface's scale
constexpr double maxScale = 3;
constexpr double scaleStep = 1.1;

void flip(bool& value) {
    value = !value;
}

void stepStop(K k, int steps) {
    k.state.lens.fStop = steppedStop(k.state.lens.fStop, steps);
}

void stepTime(K k, double seconds) {
    k.state.playing = false;
    k.state.options.time += seconds;
}

void scaleInterface(K k, double factor) {
    k.state.interfaceScale = std::clamp(k.state.interfaceScale * factor, minScale, maxScale);
}

void switchNavigation(K k) {
    k.state.navigation = k.state.navigation == Navigation::orbit ? Navigation::fly : Navigation::orbit;
}

void frameWith(K k, void (*function)(const PreparedFrame&, ViewState&)) {
    if (k.frame != nullptr) function(*k.frame, k.state);
}

void toggle(K k, Overlay overlay) {
    k.state.display.overlay = k.state.display.overlay == overlay ? Overlay::none : overlay;
}

void nextComparison(K k) {
    const int next = static_cast<int>(k.state.comparison) + 1;
    compare(k.state, next > static_cast<int>(Comparison::method) ? Comparison::none : static_cast<Comparison>(next));
}

void escape(K k) {
    k.state.poppingSince.reset();
    k.state.focusPoints.clear();
    k.state.help = false;
    k.actions.cancelExport = true;
}

constexpr int ctrl(int key) {
    return withControl(key);
}

constexpr KeyCommand commands[] = {
    {"Drag", "orbit, or look around in fly mode"},
    {"Right or Shift drag", "pan"},
    {"Wheel", "zoom"},
    {"Click", "focus on the surface under the cursor"},
    {"Double click", "focus on the object and frame it"},
    {"Ctrl click", "tilt the focus plane through three points"},
    {"Ctrl wheel", "move the focus"},
    {"Shift wheel, [ ]", "open or close the aperture", '[', [](K k) { stepStop(k, -1); }},
    {{}, {}, ']', [](K k) { stepStop(k, 1); }},
    {"W A S D Q E", "fly (Shift: faster)"},
    {"V", "orbit or fly mode", 'V', switchNavigation},
    {"F, Home", "frame the selection, frame all", 'F', [](K k) { frameWith(k, frameSelection); }},
    {{}, {}, key::home, [](K k) { frameWith(k, frameScene); }},
    {"0, 1 … 9", "automatic camera, cameras of the file", '0', [](K k) { k.actions.chooseCamera = "auto"; }},
    {"Space", "play or pause the animation", ' ', [](K k) { flip(k.state.playing); }},
    {", .", "one frame back, one frame ahead", ',', [](K k) { stepTime(k, -frameTime); }},
    {{}, {}, '.', [](K k) { stepTime(k, frameTime); }},
    {"P, O", "focus peaking, focus plane", 'P', [](K k) { flip(k.state.display.focusPeaking); }},
    {{}, {}, 'O', [](K k) { flip(k.state.display.focusPlane); }},
    {"C, L, N, Z", "overlay: blur, level, work, wireframe", 'C', [](K k) { toggle(k, Overlay::coc); }},
    {{}, {}, 'L', [](K k) { toggle(k, Overlay::level); }},
    {{}, {}, 'N', [](K k) { toggle(k, Overlay::work); }},
    {{}, {}, 'Z', [](K k) { flip(k.state.display.wireframe); }},
    {"X", "compare: next image on the right", 'X', nextComparison},
    {"M", "compare: difference on the right", 'M', [](K k) { flip(k.state.display.difference); }},
    {"B", "popping test", 'B', [](K k) { togglePoppingTest(k.state); }},
    {"Ctrl O", "open a scene", ctrl('O'), [](K k) { k.actions.openDialog = true; }},
    {"Ctrl Z, Ctrl Shift Z", "undo, redo", ctrl('Z'), [](K k) { (k.shift ? k.actions.redo : k.actions.undo) = true; }},
    {{}, {}, ctrl('Y'), [](K k) { k.actions.redo = true; }},
    {"Ctrl C", "copy the command for this image", ctrl('C'), [](K k) { k.actions.copyCommand = true; }},
    {"Ctrl E", "export a still", ctrl('E'), [](K k) { k.actions.askExport = true; }},
    {"Esc", "cancel an export or a popping test", key::escape, escape},
    {"K", "record a keyframe of a shot", 'K', [](K k) { k.actions.recordKey = true; }},
    {"F12", "screenshot of the window", key::f12, [](K k) { k.actions.screenshot = true; }},
    {"F11", "full screen", key::f11, [](K k) { k.actions.toggleFullscreen = true; }},
    {"H, T", "hide the panel, change to the light or dark theme", 'H', [](K k) { flip(k.state.panel); }},
    {{}, {}, 'T', [](K k) { flip(k.state.dark); }},
    {"Ctrl + −", "larger or smaller interface", ctrl('='), [](K k) { scaleInterface(k, scaleStep); }},
    {{}, {}, ctrl('-'), [](K k) { scaleInterface(k, 1 / scaleStep); }},
    {{}, {}, ctrl('0'), [](K k) { k.state.interfaceScale = 1; }},
    {"?, F1", "list of keys", '/', [](K k) { k.state.help ^= k.shift; }},
    {{}, {}, key::f1, [](K k) { flip(k.state.help); }},
    {"Ctrl Q", "quit", ctrl('Q'), [](K k) { k.actions.quit = true; }},
};

}  // namespace

std::span<const KeyCommand> keyCommands() {
    return commands;
}

void runKeyCommand(int key, const KeyContext& context) {
    for (const KeyCommand& command : commands)
        if (command.run != nullptr && command.key == key) command.run(context);
    if (context.frame == nullptr || key < '1' || key > '9') return;
    const std::vector<std::string> cameras = cameraNames(*context.frame->scene);
    const auto index = static_cast<std::size_t>(key - '1');
    if (index < cameras.size()) context.actions.chooseCamera = cameras[index];
}

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

}  // namespace defocus::engine
