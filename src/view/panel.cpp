#include "view/panel.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <functional>

#include "view/export_panel.h"
#include "view/input.h"
#include "view/lens_rows.h"
#include "view/method_panel.h"
#include "view/scene_panel.h"
#include "view/setting_rows.h"
#include "view/surroundings_panel.h"

namespace defocus {

namespace {

using Names = std::vector<std::string_view>;

const Names focusFields = {"focusDistance", "focusRangeFront", "focusRangeBehind", "focusRangeRefocuses",
                           "focusTilt",     "focusSwing",      "fieldCurvature"};
const Names apertureFields = {
    "bladeCount",          "bladeRotation", "bladeCurvature",           "anamorphicRatio", "obstruction",
    "sphericalAberration", "catEye",        "axialChromaticAberration", "astigmatism",     "coma"};

bool holds(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void fieldRows(ViewState& state, const std::function<bool(std::string_view)>& wanted) {
    for (const LensField& field : lensFields()) {
        if (!wanted(field.name)) continue;
        const bool changed = lensFieldRow(state.lens, field);
        if (changed && field.name == std::string_view("focusDistance")) state.pull.reset();
    }
}

// A path to type, the dialog, and the scenes that were opened last.
void openRow(ViewState& state, ViewActions& actions) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float arrow = ImGui::GetFrameHeight();
    const float button = ImGui::CalcTextSize("Open…").x + 2 * style.FramePadding.x;
    ImGui::SetNextItemWidth(-button - arrow - style.ItemSpacing.x - 1);
    const bool entered = ImGui::InputTextWithHint("##open", "a .glb or .gltf, or drop it here", &state.openPath,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("open path");
    if (entered && !state.openPath.empty()) actions.open = state.openPath;
    ImGui::SameLine();
    if (ImGui::Button("Open…")) actions.openDialog = true;
    notePlace("open");
    tooltip("Chooses a file (Ctrl O)");
    ImGui::SameLine(0, 1);
    if (ImGui::ArrowButton("##recent", ImGuiDir_Down)) ImGui::OpenPopup("recent");
    notePlace("recent");
    tooltip("Scenes that were opened last");
    if (!ImGui::BeginPopup("recent")) return;
    if (state.recent.empty()) ImGui::TextDisabled("none yet");
    for (const std::filesystem::path& path : state.recent) {
        if (ImGui::MenuItem(path.filename().c_str())) actions.open = path;
        notePlace("recent " + path.filename().string());
        tooltip(path.string());
    }
    ImGui::EndPopup();
}

void stepsRow(const PanelContext& context, ViewActions& actions) {
    const auto step = [](const char* name, const char* help, bool possible, bool& wanted) {
        ImGui::BeginDisabled(!possible);
        if (ImGui::Button(name)) wanted = true;
        ImGui::EndDisabled();
        notePlace(name);
        tooltip(help);
        ImGui::SameLine();
    };
    step("Undo", "Ctrl Z: camera, lens, surroundings, levels, exposure", context.undoSteps > 0, actions.undo);
    step("Redo", "Ctrl Shift Z", context.redoSteps > 0, actions.redo);
    step("Reset all", "All settings, camera and lens as the scene was opened; Undo brings them back",
         context.undoSteps > 0, actions.resetAll);
    ImGui::NewLine();
}

void sceneSection(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!section("Scene", true)) return;
    openRow(state, actions);
    if (context.frame == nullptr) return;
    ignoredRows(context);

    std::vector<std::string> cameras = cameraNames(*context.frame->scene);
    cameras.insert(cameras.begin(), "auto");
    rowLabel("Camera", "Of the file, or 'auto' to frame the scene; 0 and 1 … 9 choose too");
    const int camera =
        combo("##camera", cameras, state.options.camera.empty() ? context.frame->cameraName : state.options.camera);
    if (camera >= 0) actions.chooseCamera = cameras[static_cast<std::size_t>(camera)];
    rowLabel("Mouse", "Orbit around what was focused on, or look around from where you stand (V)");
    int navigation = static_cast<int>(state.navigation);
    ImGui::RadioButton("orbit", &navigation, 0);
    ImGui::SameLine();
    ImGui::RadioButton("fly", &navigation, 1);
    state.navigation = static_cast<Navigation>(navigation);
    if (ImGui::Button("Frame all")) actions.frameAll = true;
    ImGui::SameLine();
    if (ImGui::Button("Frame selection")) actions.frameSelection = true;
    stepsRow(context, actions);
}

// Motion blur.
void shutterRows(Request& request) {
    ShutterSettings& shutter = request.shutter;
    rowLabel("Shutter", "How long it stays open: what moves meanwhile is blurred (--shutter)");
    const double shut = 0;
    const double longest = 10;
    const std::string format = shutter.seconds > 0 ? secondsFormat(shutter.seconds) : "one moment";
    ImGui::DragScalar("##shutter", ImGuiDataType_Double, &shutter.seconds, 0.0005f, &shut, &longest, format.c_str(),
                      ImGuiSliderFlags_AlwaysClamp);
    if (!(shutter.seconds > 0)) return;
    settingRow(request, "shutterPosition");
    rowLabel("Motion segments", "Straight lines that a vertex's way is cut into (--motion-segments)");
    int segments = static_cast<int>(shutter.motionSegments);
    if (ImGui::SliderInt("##segments", &segments, 1, 64, "%d", ImGuiSliderFlags_AlwaysClamp))
        shutter.motionSegments = static_cast<std::uint32_t>(segments);
}

void animationSection(const PanelContext& context, ViewState& state) {
    const std::vector<AnimationClip>& clips = context.frame->scene->clips;
    if (clips.empty() || !section("Animation", true)) return;
    AnimationState& animation = state.animation;
    const auto index = static_cast<std::size_t>(std::clamp(animation.clip, 0, static_cast<int>(clips.size()) - 1));
    if (clips.size() > 1) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < clips.size(); ++i)
            names.push_back(clips[i].name.empty() ? fmt::format("clip {}", i + 1) : clips[i].name);
        rowLabel("Clip");
        const int chosen = combo("##clip", names, names[index]);
        if (chosen >= 0) animation.clip = chosen;
    }
    if (ImGui::Button(animation.playing ? "Pause" : "Play")) animation.playing = !animation.playing;
    tooltip("Space");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    const double begin = 0;
    const double end = std::max(1e-3, static_cast<double>(clips[index].duration));
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &animation.time, &begin, &end, "%.2f s"))
        animation.playing = false;
    rowLabel("Speed");
    const double slowest = 0.1;
    const double fastest = 4;
    ImGui::SliderScalar("##speed", ImGuiDataType_Double, &animation.speed, &slowest, &fastest, "%.2f");
    shutterRows(state.options);
}

void focusPointsRow(ViewState& state) {
    rowLabel("Focus points",
             "Ctrl click three points of the picture: the focus plane goes through them (--focus-points)");
    if (state.focusPoints.empty())
        ImGui::TextDisabled("Ctrl click three");
    else
        ImGui::Text("%d of 3", static_cast<int>(state.focusPoints.size()));
    const bool tilted = state.lens.focusTilt != 0 || state.lens.focusSwing != 0;
    if (state.focusPoints.empty() && !tilted) return;
    ImGui::SameLine();
    if (!ImGui::SmallButton("Reset")) return;
    state.focusPoints.clear();
    state.lens.focusTilt = state.lens.focusSwing = 0;
}

void lensSections(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (section("Focus", true)) {
        if (context.picture != nullptr) depthDiagram(context.picture->plan(), context.colors, context.scale);
        fieldRows(state, [](std::string_view name) { return holds(focusFields, name); });
        focusPointsRow(state);
        nodeBlurRow(context, state, actions);
        ImGui::Checkbox("Peaking", &state.display.focusPeaking);
        tooltip("Marks sharp contours that are in focus (P)");
        ImGui::SameLine();
        ImGui::Checkbox("Focus plane", &state.display.focusPlane);
        tooltip("Tints what is in focus (O)");
    }
    if (section("Lens", true)) {
        stopRing(state.lens.fStop, context.colors, context.scale);
        fieldRows(state,
                  [](std::string_view name) { return !holds(focusFields, name) && !holds(apertureFields, name); });
    }
    if (section("Aperture", false)) {
        aperturePreview(state.lens, context.scale);
        apertureImageRow(context, state, actions);
        fieldRows(state, [](std::string_view name) { return holds(apertureFields, name); });
    }
}

void imageSection(ViewState& state) {
    if (!section("Image", false)) return;
    rowLabel("Exposure");
    const double darkest = -8;
    const double brightest = 8;
    const bool ofLens = state.lens.exposureTime > 0;
    double exposure = shownExposure(state);
    ImGui::BeginDisabled(ofLens || state.meters);  // by time, ISO and f-number, or by the meter
    if (ImGui::SliderScalar("##exposure", ImGuiDataType_Double, &exposure, &darkest, &brightest, "%+.2f EV"))
        state.display.exposure = exposure;
    ImGui::EndDisabled();
    ImGui::BeginDisabled(ofLens);
    rowLabel("Auto-exposure", "Meters the scene whenever the view comes to rest (--exposure auto)");
    ImGui::Checkbox("##meters", &state.meters);
    notePlace("auto-exposure");
    ImGui::EndDisabled();
    rowLabel("Tone map");
    int toneMap = static_cast<int>(state.display.toneMap);
    if (ImGui::Combo("##tonemap", &toneMap, "none\0ACES\0AgX\0neutral\0"))
        state.display.toneMap = static_cast<ToneMap>(toneMap);
}

std::string countText(double count) {
    if (count >= 1e6) return fmt::format("{:.2f} M", 1e-6 * count);
    return count >= 1e4 ? fmt::format("{:.0f} k", 1e-3 * count) : fmt::format("{:.0f}", count);
}

void seeSection(const PanelContext& context, ViewState& state) {
    if (!section("See why", false)) return;
    rowLabel(
        "Overlay",
        "Blur (C), level (L), rate: how many images of an object multirate draws for a lens sample (J), or work: how "
        "many triangles touch each pixel in a lens sample (N)");
    int overlay = static_cast<int>(state.display.overlay);
    if (ImGui::Combo("##overlay", &overlay, "none\0circle of confusion\0level of detail\0rate\0work\0"))
        state.display.overlay = static_cast<DisplayOverlay>(overlay);
    rowLabel("Wireframe", "The triangles that are drawn, coloured by level (Z)");
    ImGui::Checkbox("##wireframe", &state.display.wireframe);
    if (context.picture == nullptr) return;
    const FramePlan& plan = context.picture->plan();
    const double share = plan.trianglesAtFullDetail > 0 ? 100.0 * static_cast<double>(plan.trianglesDrawn) /
                                                              static_cast<double>(plan.trianglesAtFullDetail)
                                                        : 100;
    rowLabel("Objects drawn");
    ImGui::TextUnformatted(
        fmt::format("{} of {}", plan.objects.size(), context.frame->world.pose.objects.size()).c_str());
    rowLabel("Triangles", "Drawn for each lens sample, and their share of full detail");
    const double triangles =
        static_cast<double>(plan.trianglesDrawn) / static_cast<double>(std::max<std::size_t>(plan.samples.size(), 1));
    ImGui::TextUnformatted(fmt::format("{}, {:.0f} %", countText(triangles), share).c_str());
    if (!ImGui::TreeNode("left out", "Left out (%d)", static_cast<int>(plan.leftOut.size()))) return;
    for (const LeftOut& entry : plan.leftOut) ImGui::TextWrapped("%s: %s", entry.what.c_str(), entry.reason.c_str());
    ImGui::TreePop();
}

void compareSection(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!section("Compare", false)) return;
    rowLabel("Right side", "What the right of the divider shows (X)");
    int comparison = static_cast<int>(state.comparison);
    if (ImGui::Combo("##comparison", &comparison, "nothing\0full detail\0nearest level\0reference\0another method\0")) {
        state.comparison = static_cast<Comparison>(comparison);
        if (state.display.divider >= 1) state.display.divider = 0.5;
    }
    if (state.comparison == Comparison::method) {
        std::vector<std::string> names;
        for (const Method& method : methods()) names.push_back(method.name);
        rowLabel("Method");
        const int chosen = combo("##compared", names, state.comparedMethod);
        if (chosen >= 0) state.comparedMethod = names[static_cast<std::size_t>(chosen)];
    }
    if (state.comparison != Comparison::none) {
        rowLabel("Difference", "Shows the difference of both sides on the right (M)");
        ImGui::Checkbox("##difference", &state.display.difference);
        if (state.display.difference) {
            ImGui::SameLine();
            ImGui::SetNextItemWidth(-1);
            const double least = 1;
            const double most = 64;
            ImGui::SliderScalar("##gain", ImGuiDataType_Double, &state.display.differenceGain, &least, &most,
                                "gain %.0f");
        }
        const auto psnr = context.picture != nullptr ? context.picture->psnr() : std::nullopt;
        rowLabel("PSNR", "Of the whole image, both sides at the same samples, once the view is still");
        ImGui::TextUnformatted(psnr ? fmt::format("{:.1f} dB", *psnr).c_str() : "once it is still");
    }
    if (ImGui::Button(state.poppingSince ? "Stop the popping test" : "Popping test")) actions.togglePopping = true;
    tooltip("A focus pull with fractional levels on the left and nearest levels on the right (B)");
}

void performanceSection(const PanelContext& context, ViewState& state) {
    if (!section("Performance", false)) return;
    const double least = 4;
    const double most = 250;
    rowLabel("Frame budget", "While things move, samples and resolution keep to this time");
    ImGui::SliderScalar("##budget", ImGuiDataType_Double, &state.budget.milliseconds, &least, &most, "%.0f ms");
    const FrameQuality& quality = state.budget.quality();
    rowLabel("While moving");
    ImGui::TextUnformatted(fmt::format("{} at {:.0f} % size",
                                       quality.samples == 1 ? "no blur" : fmt::format("{} samples", quality.samples),
                                       100 * quality.resolution)
                               .c_str());
    rowLabel("Most samples", "A still view gathers samples up to this number");
    int samples = static_cast<int>(state.mostSamples);
    if (ImGui::SliderInt("##most", &samples, 64, 16384, "%d", ImGuiSliderFlags_Logarithmic))
        state.mostSamples = static_cast<std::uint32_t>(samples + 63) / 64 * 64;
    settingRow(state.options, "targetError", "0.003");
    if (context.picture != nullptr) {
        std::vector<BarPart> parts;
        for (const PassShare& pass : context.picture->passes()) parts.push_back({pass.name, pass.milliseconds});
        parts.push_back({"interface", context.interfaceMilliseconds});
        timeBar(parts, state.budget.milliseconds, context.colors, context.scale);
    }
    timeGraph(*context.frameMilliseconds, state.budget.milliseconds, context.colors, context.scale);
    if (context.latency.count > 0) {
        rowLabel("Input to picture", "From an event to the end of the frame that shows it: median and worst");
        ImGui::TextUnformatted(
            fmt::format("{:.0f} ms, at most {:.0f} ms", context.latency.median, context.latency.worst).c_str());
    }
    ImGui::TextDisabled("%s", context.device->c_str());
}

}  // namespace

void drawPanel(const PanelContext& context, ViewState& state, ViewActions& actions) {
    ImGui::SetNextWindowPos(context.origin);
    ImGui::SetNextWindowSize(context.size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin("Panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar(2);
    sceneSection(context, state, actions);
    if (context.frame != nullptr) {
        treeSection(context, state, actions);
        materialSection(context, state);
        viewsSection(state, actions);
        animationSection(context, state);
        lensSections(context, state, actions);
        surroundingsSection(context, state, actions);
        imageSection(state);
        levelSection(state);
        methodSection(state);
        seeSection(context, state);
        compareSection(context, state, actions);
        performanceSection(context, state);
        exportSection(context, state, actions);
    }
    ImGui::Separator();
    if (ImGui::Button("? Keys")) state.help = !state.help;
    ImGui::SameLine();
    if (ImGui::Button(state.dark ? "Light" : "Dark")) state.dark = !state.dark;
    tooltip("T");
    ImGui::End();
}

}  // namespace defocus
