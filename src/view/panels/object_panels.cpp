// Draws the panel sections for the objects: the tree of nodes, and the materials of the selected object.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <set>

#include "core/number_text.h"
#include "image/tone_map.h"
#include "scene/hidden_nodes.h"
#include "view/panels/panels.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

struct TreeRow {
    int node = -1;
    int depth = 0;
    bool shown = true;    // true: neither the node nor one of its ancestors is hidden
    bool parent = false;  // true: the node has descendants with meshes
};

// Returns the rows of all nodes that have a mesh or a descendant with a mesh. Descendants of collapsed nodes are
// omitted. Iterative, because a file's hierarchy may be too deep for recursion.
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

// Returns the index of the first object that belongs to `node` or to one of its descendants; −1 if there is none.
int objectOf(const Scene& scene, const Pose& pose, int node) {
    for (std::size_t i = 0; i < pose.objects.size(); ++i)
        for (int above = pose.objects[i].node; above >= 0; above = scene.nodes[static_cast<std::size_t>(above)].parent)
            if (above == node) return static_cast<int>(i);
    return -1;
}

void toggleNode(const Scene& scene, int node, std::vector<std::string>& hidden) {
    const auto erased = std::erase_if(hidden, [&](const std::string& text) { return nodeCalled(scene, text) == node; });
    if (erased == 0) hidden.push_back(callingOf(scene, node));
}

void treeRow(const Ui& ui, const TreeRow& row, bool hidden, std::set<int>& closed) {
    const Scene& scene = ui.scene();
    const Pose& pose = ui.pose();
    ViewState& state = ui.state;
    const std::string name = rowName(scene, row.node);
    ImGui::PushID(row.node);
    bool on = !hidden;
    if (ImGui::Checkbox("##shown", &on)) toggleNode(scene, row.node, state.options.hide);
    notePlace("show " + name);
    tooltip(hidden ? "Show the node" : "Hide the node and all nodes below it (--hide)");
    ImGui::SameLine();
    ImGui::Dummy({static_cast<float>(row.depth) * 12 * ui.scale, 1});
    ImGui::SameLine(0, 0);
    if (row.parent) {
        const ImGuiDir arrow = closed.contains(row.node) ? ImGuiDir_Right : ImGuiDir_Down;
        if (ImGui::ArrowButton("##open", arrow) && closed.erase(row.node) == 0) closed.insert(row.node);
        ImGui::SameLine();
    }
    const auto object = static_cast<std::size_t>(state.selected);
    const bool selected = state.selected >= 0 && pose.objects[object].node == row.node;
    if (!row.shown) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (ImGui::Selectable(name.c_str(), selected)) state.selected = objectOf(scene, pose, row.node);
    if (!row.shown) ImGui::PopStyleColor();
    notePlace("node " + name);
    ImGui::PopID();
}

void valueRow(const char* label, const std::string& text, const TextureUse* texture = nullptr) {
    textRow(label, text + (texture != nullptr && texture->used() ? " × texture" : ""));
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
        valueRow("Coat roughness", fmt::format("{:.3g}", material.clearcoatRoughnessFactor),
                 &material.clearcoatRoughness);
    }
    if (material.hasSheen()) colorRow("Sheen", material.sheenColorFactor, material.sheenColor);
    if (material.isAnisotropic())
        valueRow("Anisotropy", fmt::format("{:.3g}", material.anisotropyStrength), &material.anisotropy);
    if (material.isIridescent())
        valueRow("Thin film",
                 fmt::format("{:.3g}, up to {:g} nm thick", material.iridescenceFactor,
                             material.iridescenceThicknessMaximum),
                 &material.iridescence);
    if (material.transmitsDiffusely())
        valueRow("Diffuse transmission", fmt::format("{:.3g}", material.diffuseTransmissionFactor),
                 &material.diffuseTransmission);
    if (material.doubleSided) valueRow("Sides", "both");
}

}  // namespace

void objectsPanel(const Ui& ui) {
    const Scene& scene = ui.scene();
    ViewState& state = ui.state;
    std::vector<bool> hidden(scene.nodes.size());
    for (const std::string& text : state.options.hide) hidden[static_cast<std::size_t>(nodeCalled(scene, text))] = true;
    static std::set<int> closed;
    static std::weak_ptr<Scene> seen;
    if (seen.lock() != ui.document.frame->scene) closed.clear();
    seen = ui.document.frame->scene;
    const std::vector<TreeRow> rows = treeRows(scene, hidden, closed);
    ImGui::BeginDisabled(ui.still.has_value());
    const float rowHeight = ImGui::GetFrameHeightWithSpacing();
    const float height = rowHeight * static_cast<float>(std::clamp<std::size_t>(rows.size(), 1, 9));
    ImGui::BeginChild("tree", {0, height + 12 * ui.scale}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), rowHeight);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const TreeRow& row = rows[static_cast<std::size_t>(i)];
            treeRow(ui, row, hidden[static_cast<std::size_t>(row.node)], closed);
        }
    ImGui::EndChild();
    if (!state.options.hide.empty() && ImGui::Button("Show all")) state.options.hide.clear();
    ImGui::EndDisabled();
}

void materialPanel(const Ui& ui) {
    if (ui.state.selected < 0) {
        ImGui::TextDisabled("Click an object to show its materials");
        return;
    }
    const Scene& scene = ui.scene();
    const Object& object = ui.pose().objects[static_cast<std::size_t>(ui.state.selected)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
    textRow("Selected", object.name);
    textRow("Mesh", fmt::format("{} triangles{}", grouped(mesh.triangleCount()),
                                mesh.name.empty() || mesh.name == object.name ? "" : ", " + mesh.name));
    std::vector<int> materials;
    for (const Primitive& primitive : mesh.primitives)
        if (std::ranges::find(materials, primitive.material) == materials.end())
            materials.push_back(primitive.material);
    for (const int index : materials) {
        const Material& material = materialAt(scene, index);
        const std::string name = !material.name.empty() ? material.name
                                 : index < 0            ? "glTF's default"
                                                        : fmt::format("material {}", index);
        ImGui::PushID(index);
        ImGui::Separator();
        textRow("Name", name);
        materialRows(material);
        ImGui::PopID();
    }
}

}  // namespace defocus::engine
