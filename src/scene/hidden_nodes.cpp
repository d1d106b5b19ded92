#include "scene/hidden_nodes.h"

#include <algorithm>
#include <string_view>

#include "core/parse.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

// Returns whether the node or one of its ancestors is in `hidden`.
bool isBelow(const Scene& scene, int node, const std::vector<bool>& hidden) {
    for (; node >= 0; node = scene.nodes[static_cast<std::size_t>(node)].parent)
        if (hidden[static_cast<std::size_t>(node)]) return true;
    return false;
}

}  // namespace

int nodeCalled(const Scene& scene, const std::string& nameOrNumber) {
    if (std::ranges::find(scene.nodes, nameOrNumber, &Node::name) != scene.nodes.end())
        return nodeNamed(scene, nameOrNumber);
    const std::string_view digits = std::string_view(nameOrNumber).substr(nameOrNumber.starts_with('#') ? 1 : 0);
    const std::optional<std::size_t> number = parsedNumber<std::size_t>(digits);
    return number && *number < scene.nodes.size() ? static_cast<int>(*number) : nodeNamed(scene, nameOrNumber);
}

std::string callingOf(const Scene& scene, int node) {
    const std::string& name = scene.nodes[static_cast<std::size_t>(node)].name;
    const bool ownName = !name.empty() && std::ranges::count(scene.nodes, name, &Node::name) == 1;
    if (ownName && nodeCalled(scene, name) == node) return name;
    const std::string number = std::to_string(node);
    return nodeCalled(scene, number) == node ? number : '#' + number;
}

void hideNodes(const Scene& scene, std::span<const std::string> namesOrNumbers, Pose& pose) {
    if (namesOrNumbers.empty()) return;
    std::vector<bool> hidden(scene.nodes.size());
    for (const std::string& text : namesOrNumbers) hidden[static_cast<std::size_t>(nodeCalled(scene, text))] = true;
    const std::size_t left =
        std::erase_if(pose.objects, [&](const Object& object) { return isBelow(scene, object.node, hidden); });
    if (left > 0 && !pose.bounds.empty()) pose.bounds = posedBounds(scene, pose);
}

}  // namespace defocus::engine
