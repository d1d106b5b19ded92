#include "scene/hidden_nodes.h"

#include <algorithm>
#include <charconv>

#include "scene/posed_mesh.h"

namespace defocus {

namespace {

// Whether the node or one above it is in `hidden`.
bool isBelow(const Scene& scene, int node, const std::vector<bool>& hidden) {
    for (; node >= 0; node = scene.nodes[static_cast<std::size_t>(node)].parent)
        if (hidden[static_cast<std::size_t>(node)]) return true;
    return false;
}

// As poseAt (scene/pose.h) measures it: each mesh once.
Bounds boundsOf(const Scene& scene, const Pose& pose) {
    Bounds result;
    std::vector<std::optional<Bounds>> meshBounds(scene.meshes.size());
    for (const Object& object : pose.objects) {
        if (object.ground) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        std::optional<Bounds>& bounds = meshBounds[static_cast<std::size_t>(object.mesh)];
        if (!bounds) bounds = mesh.bounds();
        result.extend(posedBounds(mesh, *bounds, object));
    }
    return result;
}

}  // namespace

int nodeCalled(const Scene& scene, const std::string& nameOrNumber) {
    const auto named = [&](const Node& node) { return node.name == nameOrNumber; };
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [stop, fault] = std::from_chars(nameOrNumber.data(), end, number);
    const bool isNumber = fault == std::errc() && stop == end && number < scene.nodes.size();
    if (isNumber && std::ranges::none_of(scene.nodes, named)) return static_cast<int>(number);
    return nodeNamed(scene, nameOrNumber);
}

std::string callingOf(const Scene& scene, int node) {
    const std::string& name = scene.nodes[static_cast<std::size_t>(node)].name;
    const auto namesakes = std::ranges::count(scene.nodes, name, &Node::name);
    return !name.empty() && namesakes == 1 && nodeCalled(scene, name) == node ? name : std::to_string(node);
}

void hideNodes(const Scene& scene, std::span<const std::string> namesOrNumbers, Pose& pose) {
    if (namesOrNumbers.empty()) return;
    std::vector<bool> hidden(scene.nodes.size());
    for (const std::string& text : namesOrNumbers) hidden[static_cast<std::size_t>(nodeCalled(scene, text))] = true;
    const std::size_t left =
        std::erase_if(pose.objects, [&](const Object& object) { return isBelow(scene, object.node, hidden); });
    if (left > 0 && !pose.bounds.empty()) pose.bounds = boundsOf(scene, pose);
}

}  // namespace defocus
