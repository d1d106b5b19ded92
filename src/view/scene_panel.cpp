#include "view/scene_panel.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <set>

#include "core/number_text.h"
#include "frame/plan_warnings.h"
#include "scene/hidden_nodes.h"

namespace defocus {

namespace {

// ---- the tree -----------------------------------------------------------------------------------

struct TreeRow {
    int node = -1;
    int depth = 0;
    bool shown = true;    // neither it nor anything above it is switched off
    bool parent = false;  // rows follow below it where it is open
};

// The rows of all nodes below open ones that lead to a mesh. Without recursion: hierarchies may be deeper than a stack.
std::vector<TreeRow> treeRows(const Scene& scene, const std::vector<bool>& hidden, const std::set<int>& closed) {
    std::vector<bool> leads(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].mesh < 0) continue;
        for (int node = static_cast<int>(i); node >= 0 && !leads[static_cast<std::size_t>(node)];
             node = scene.nodes[static_cast<std::size_t>(node)].parent)
            leads[static_cast<std::size_t>(node)] = true;
    }
    std::vector<TreeRow> stack, rows;
    const auto push = [&](const std::vector<int>& nodes, int depth, bool shown) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
            if (leads[static_cast<std::size_t>(*node)])
                stack.push_back({*node, depth, shown && !hidden[static_cast<std::size_t>(*node)], false});
    };
    push(scene.roots, 0, true);
    while (!stack.empty()) {
        TreeRow row = stack.back();
        stack.pop_back();
        const std::vector<int>& children = scene.nodes[static_cast<std::size_t>(row.node)].children;
        row.parent = std::ranges::any_of(children, [&](int child) { return leads[static_cast<std::size_t>(child)]; });
        rows.push_back(row);
        if (!closed.contains(row.node)) push(children, row.depth + 1, row.shown);
    }
    return rows;
}

std::string rowName(const Scene& scene, int index) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    if (!node.name.empty()) return node.name;
    if (node.mesh >= 0 && !scene.meshes[static_cast<std::size_t>(node.mesh)].name.empty())
        return scene.meshes[static_cast<std::size_t>(node.mesh)].name;
    return fmt::format("node {}", index);
}

// The first object of the node, or of what is below it: into Pose::objects, −1 without any.
int objectOf(const Scene& scene, const Pose& pose, int node) {
    for (std::size_t i = 0; i < pose.objects.size(); ++i)
        for (int above = pose.objects[i].node; above >= 0; above = scene.nodes[static_cast<std::size_t>(above)].parent)
            if (above == node) return static_cast<int>(i);
    return -1;
}

void toggleNode(const Scene& scene, int node, const Request& options, ViewActions& actions) {
    Request changed = options;
    const auto erased =
        std::erase_if(changed.hidden, [&](const std::string& text) { return nodeCalled(scene, text) == node; });
    if (erased == 0) changed.hidden.push_back(callingOf(scene, node));
    actions.changed = changed;
}

void treeRow(const PanelContext& context, const TreeRow& row, bool hidden, std::set<int>& closed, ViewState& state,
             ViewActions& actions) {
    const Scene& scene = *context.frame->scene;
    const Pose& pose = context.frame->world.pose;
    const std::string name = rowName(scene, row.node);
    ImGui::PushID(row.node);
    bool on = !hidden;
    if (ImGui::Checkbox("##shown", &on)) toggleNode(scene, row.node, state.options, actions);
    notePlace("show " + name);
    tooltip(hidden ? "Show it (--hide leaves it out)" : "Leave it out, with all below it (--hide)");
    ImGui::SameLine();
    ImGui::Dummy({static_cast<float>(row.depth) * 12 * context.scale, 1});
    ImGui::SameLine(0, 0);
    if (row.parent) {
        const bool open = !closed.contains(row.node);
        if (ImGui::ArrowButton("##open", open ? ImGuiDir_Down : ImGuiDir_Right)) {
            if (open)
                closed.insert(row.node);
            else
                closed.erase(row.node);
        }
        ImGui::SameLine();
    }
    const int object = state.selected;
    const bool selected = object >= 0 && pose.objects[static_cast<std::size_t>(object)].node == row.node;
    if (!row.shown) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (ImGui::Selectable(name.c_str(), selected)) state.selected = objectOf(scene, pose, row.node);
    if (!row.shown) ImGui::PopStyleColor();
    notePlace("node " + name);
    ImGui::PopID();
}

// ---- materials ----------------------------------------------------------------------------------

void valueRow(const char* label, const std::string& text, const TextureUse* texture = nullptr) {
    rowLabel(label);
    ImGui::TextUnformatted((text + (texture != nullptr && texture->used() ? " × texture" : "")).c_str());
}

void colorRow(const char* label, const glm::vec3& color, const TextureUse& texture) {
    rowLabel(label, "Linear");
    const ImVec4 shown(srgbEncode(std::min(color.r, 1.0f)), srgbEncode(std::min(color.g, 1.0f)),
                       srgbEncode(std::min(color.b, 1.0f)), 1);
    ImGui::ColorButton(label, shown, ImGuiColorEditFlags_NoTooltip, {ImGui::GetFrameHeight(), ImGui::GetFrameHeight()});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(
        fmt::format("{:.3g}, {:.3g}, {:.3g}{}", color.r, color.g, color.b, texture.used() ? " × texture" : "").c_str());
}

void materialRows(const Material& material) {
    colorRow("Base colour", material.baseColorFactor, material.baseColor);
    if (material.unlit) {
        valueRow("Shading", "unlit");
    } else {
        valueRow("Metallic", fmt::format("{:.3g}", material.metallicFactor), &material.metallicRoughness);
        valueRow("Roughness", fmt::format("{:.3g}", material.roughnessFactor), &material.metallicRoughness);
    }
    if (material.emissiveFactor != glm::vec3(0)) colorRow("Emission", material.emissiveFactor, material.emissive);
    if (material.normal.used()) valueRow("Normals", fmt::format("texture × {:.3g}", material.normalScale));
    if (material.occlusion.used()) valueRow("Occlusion", fmt::format("texture × {:.3g}", material.occlusionStrength));
    if (material.alphaMode == AlphaMode::mask)
        valueRow("Alpha", fmt::format("cut out at {:.3g}", material.alphaCutoff));
    if (material.alphaMode == AlphaMode::blend)
        valueRow("Alpha", fmt::format("{:.3g}, blended", material.baseColorFactor.a));
    if (material.transmits()) {
        valueRow("Transmission", fmt::format("{:.3g}", material.transmissionFactor), &material.transmission);
        valueRow("Thickness", fmt::format("{:.3g}", material.thicknessFactor), &material.thickness);
    }
    if (material.hasOwnReflectance()) {
        valueRow("Index of refraction", fmt::format("{:.3g}", material.ior));
        valueRow("Specular", fmt::format("{:.3g}", material.specularFactor), &material.specular);
    }
    if (material.hasClearcoat()) {
        valueRow("Clearcoat", fmt::format("{:.3g}", material.clearcoatFactor), &material.clearcoat);
        valueRow("Coat's roughness", fmt::format("{:.3g}", material.clearcoatRoughnessFactor),
                 &material.clearcoatRoughness);
    }
    if (material.hasSheen()) colorRow("Sheen", material.sheenColorFactor, material.sheenColor);
    if (material.doubleSided) valueRow("Sides", "both");
}

}  // namespace

void treeSection(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!section("Objects", false)) return;
    const Scene& scene = *context.frame->scene;
    std::vector<bool> hidden(scene.nodes.size());
    for (const std::string& text : state.options.hidden)
        hidden[static_cast<std::size_t>(nodeCalled(scene, text))] = true;
    static std::set<int> closed;
    static std::weak_ptr<Scene> seen;
    if (seen.lock() != context.frame->scene) closed.clear();
    seen = context.frame->scene;
    const std::vector<TreeRow> rows = treeRows(scene, hidden, closed);
    ImGui::BeginDisabled(context.exporting);
    const float rowHeight = ImGui::GetFrameHeightWithSpacing();
    const float height = rowHeight * static_cast<float>(std::clamp<std::size_t>(rows.size(), 1, 9));
    ImGui::BeginChild("tree", {0, height + 12 * context.scale}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), rowHeight);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const TreeRow& row = rows[static_cast<std::size_t>(i)];
            treeRow(context, row, hidden[static_cast<std::size_t>(row.node)], closed, state, actions);
        }
    ImGui::EndChild();
    if (!state.options.hidden.empty() && ImGui::Button("Show all")) {
        actions.changed = state.options;
        actions.changed->hidden.clear();
    }
    ImGui::EndDisabled();
}

void materialSection(const PanelContext& context, const ViewState& state) {
    if (!section("Material", false)) return;
    if (state.selected < 0) {
        ImGui::TextDisabled("Click something to see what it is made of");
        return;
    }
    const Scene& scene = *context.frame->scene;
    const Object& object = context.frame->world.pose.objects[static_cast<std::size_t>(state.selected)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
    rowLabel("Selected");
    ImGui::TextUnformatted(object.name.c_str());
    rowLabel("Mesh");
    ImGui::TextUnformatted(fmt::format("{} triangles{}", grouped(mesh.triangleCount()),
                                       mesh.name.empty() || mesh.name == object.name ? "" : ", " + mesh.name)
                               .c_str());
    std::vector<int> materials;
    for (const Primitive& primitive : mesh.primitives)
        if (std::ranges::find(materials, primitive.material) == materials.end())
            materials.push_back(primitive.material);
    for (const int index : materials) {
        static const Material standard;
        const Material& material = index < 0 ? standard : scene.materials[static_cast<std::size_t>(index)];
        const std::string name = !material.name.empty() ? material.name
                                 : index < 0            ? "glTF's default"
                                                        : fmt::format("material {}", index);
        ImGui::PushID(index);
        ImGui::Separator();
        rowLabel("Name");
        ImGui::TextUnformatted(name.c_str());
        materialRows(material);
        ImGui::PopID();
    }
}

void viewsSection(ViewState& state, ViewActions& actions) {
    if (!section("Views", false)) return;
    if (pathRow("view", "a name for this view", "Save", state.viewName) && !state.viewName.empty())
        actions.saveView = state.viewName;
    notePlace("save view");
    if (state.savedViews.empty()) ImGui::TextDisabled("Camera and lens are kept with the scene");
    for (std::size_t i = 0; i < state.savedViews.size(); ++i) {
        const SavedView& view = state.savedViews[i];
        ImGui::PushID(static_cast<int>(i));
        const float button = ImGui::GetFrameHeight();
        const float width = ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x;
        if (ImGui::Button(view.name.c_str(), {width, 0})) actions.goToView = i;
        notePlace("view " + view.name);
        tooltip(fmt::format("{:.3g} mm, f/{:.3g}, focused at {:.3g} m", view.lens.focalLength, view.lens.fStop,
                            view.lens.focusDistance));
        ImGui::SameLine();
        if (ImGui::Button("×", {button, 0})) actions.forgetView = i;
        tooltip("Forget it");
        ImGui::PopID();
    }
}

void ignoredRows(const PanelContext& context) {
    std::vector<std::string> lines = ignoredWarnings(*context.frame->scene);
    const std::vector<std::string> damage = damageWarnings(*context.frame->scene);
    lines.insert(lines.end(), damage.begin(), damage.end());
    if (lines.empty()) return;
    const bool open = ImGui::TreeNode("ignored", "Not drawn of this file (%d)", static_cast<int>(lines.size()));
    notePlace("ignored");
    if (!open) return;
    for (const std::string& line : lines) ImGui::TextWrapped("%s", line.c_str());
    ImGui::TreePop();
}

}  // namespace defocus
