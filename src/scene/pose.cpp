#include "scene/pose.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "scene/animation.h"

namespace defocus {

namespace {

constexpr std::size_t namesListed = 40;  // in an error message

struct LocalTransform {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
};

glm::dmat4 matrixOf(const LocalTransform& local) {
    return glm::scale(glm::translate(glm::dmat4(1.0), local.translation) * glm::mat4_cast(local.rotation), local.scale);
}

void animate(const AnimationClip& clip, double time, std::vector<LocalTransform>& locals) {
    for (const AnimationChannel& channel : clip.channels) {
        LocalTransform& local = locals[static_cast<std::size_t>(channel.node)];
        if (channel.path == ChannelPath::rotation) {
            local.rotation = sampleRotation(channel, time);
        } else if (channel.path != ChannelPath::weights) {
            const std::vector<double> value = sampleValues(channel, 3, time);
            (channel.path == ChannelPath::translation ? local.translation : local.scale) = {value[0], value[1],
                                                                                            value[2]};
        }
    }
}

std::vector<glm::dmat4> localMatrices(const Scene& scene, double time, int clip) {
    std::vector<LocalTransform> locals;
    locals.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) locals.push_back({node.translation, node.rotation, node.scale});
    if (clip >= 0 && !scene.clips.empty()) {
        if (static_cast<std::size_t>(clip) >= scene.clips.size())
            fail("there is no animation clip {}: the scene has {} (0 to {})", clip, scene.clips.size(),
                 scene.clips.size() - 1);
        animate(scene.clips[static_cast<std::size_t>(clip)], time, locals);
    }
    std::vector<glm::dmat4> matrices;
    matrices.reserve(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        matrices.push_back(scene.nodes[i].matrix ? *scene.nodes[i].matrix : matrixOf(locals[i]));
    return matrices;
}

// Walks down from `start` (without recursion: a hierarchy may be deeper than the stack) and calls `visit(node,
// parent)`.
template <typename Visit>
void walkDown(const Scene& scene, int start, std::vector<bool>& visited, const Visit& visit) {
    struct Step {
        int node;
        int parent;
    };
    std::vector<Step> stack{{start, -1}};
    while (!stack.empty()) {
        const Step step = stack.back();
        stack.pop_back();
        const auto index = static_cast<std::size_t>(step.node);
        if (visited[index]) continue;
        visited[index] = true;
        visit(step.node, step.parent);
        for (const int child : scene.nodes[index].children) stack.push_back({child, step.node});
    }
}

// A skin's vertices are placed by its joints, not by the node that draws them; in the bind pose all joints agree, so
// the first stands for all.
glm::dmat4 worldFromSkin(const Skin& skin, const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& otherwise) {
    if (skin.joints.empty() || skin.inverseBindMatrices.empty()) return otherwise;
    return worldFromNode[static_cast<std::size_t>(skin.joints.front())] * glm::dmat4(skin.inverseBindMatrices.front());
}

void placeObjects(const Scene& scene, int nodeIndex, Pose& pose) {
    const Node& node = scene.nodes[static_cast<std::size_t>(nodeIndex)];
    if (node.mesh < 0) return;
    const glm::dmat4& worldFromNode = pose.worldFromNode[static_cast<std::size_t>(nodeIndex)];
    const std::string& name = !node.name.empty() ? node.name : scene.meshes[static_cast<std::size_t>(node.mesh)].name;
    double cocScale = 1;  // that of the ancestors too: a group is scaled as a whole
    for (int i = nodeIndex; i >= 0; i = scene.nodes[static_cast<std::size_t>(i)].parent)
        cocScale *= scene.nodes[static_cast<std::size_t>(i)].cocScale;
    if (node.instances.empty()) {
        const glm::dmat4 world = node.skin < 0 ? worldFromNode
                                               : worldFromSkin(scene.skins[static_cast<std::size_t>(node.skin)],
                                                               pose.worldFromNode, worldFromNode);
        pose.objects.push_back({node.mesh, nodeIndex, name, world, cocScale});
    }
    for (std::size_t i = 0; i < node.instances.size(); ++i)
        pose.objects.push_back(
            {node.mesh, nodeIndex, fmt::format("{}#{}", name, i), worldFromNode * node.instances[i], cocScale});
}

void placeLight(const Scene& scene, int nodeIndex, Pose& pose) {
    const Node& node = scene.nodes[static_cast<std::size_t>(nodeIndex)];
    if (node.light < 0) return;
    const glm::dmat4& world = pose.worldFromNode[static_cast<std::size_t>(nodeIndex)];
    PlacedLight placed{scene.lights[static_cast<std::size_t>(node.light)], glm::dvec3(world[3]), {0, 0, -1}};
    const glm::dvec3 direction = -glm::dvec3(world[2]);
    const double length = glm::length(direction);
    if (length > 0) placed.direction = direction / length;
    pose.lights.push_back(placed);
}

}  // namespace

Pose poseAt(const Scene& scene, double time, int clip) {
    // Local matrices of the moment, multiplied down the hierarchy: first the scene, then what only joints need.
    const std::vector<glm::dmat4> locals = localMatrices(scene, time, clip);
    Pose pose;
    pose.worldFromNode.assign(scene.nodes.size(), glm::dmat4(1.0));
    std::vector<bool> visited(scene.nodes.size());
    const auto place = [&](int node, int parent) {
        const auto index = static_cast<std::size_t>(node);
        pose.worldFromNode[index] =
            parent < 0 ? locals[index] : pose.worldFromNode[static_cast<std::size_t>(parent)] * locals[index];
    };
    for (const int root : scene.roots) walkDown(scene, root, visited, place);
    const std::vector<bool> drawn = visited;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent < 0) walkDown(scene, static_cast<int>(i), visited, place);

    // Objects and lights in the order of their nodes.
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!drawn[i]) continue;
        placeObjects(scene, static_cast<int>(i), pose);
        placeLight(scene, static_cast<int>(i), pose);
    }

    // The box around all objects; each mesh is measured once.
    std::vector<std::optional<Bounds>> meshBounds(scene.meshes.size());
    for (const Object& object : pose.objects) {
        std::optional<Bounds>& bounds = meshBounds[static_cast<std::size_t>(object.mesh)];
        if (!bounds) bounds = scene.meshes[static_cast<std::size_t>(object.mesh)].bounds();
        pose.bounds.extend(transformed(*bounds, object.worldFromObject));
    }
    return pose;
}

int nodeNamed(const Scene& scene, std::string_view name) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == name) return static_cast<int>(i);

    std::vector<std::string> names;
    for (const Node& node : scene.nodes)
        if (!node.name.empty()) names.push_back(node.name);
    if (names.empty()) fail("there is no node '{}': the scene's nodes have no names", name);
    const std::size_t listed = std::min(names.size(), namesListed);
    fail("there is no node '{}'; the scene has: {}{}", name,
         fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(listed), ", "),
         listed < names.size() ? fmt::format(", … and {} more", names.size() - listed) : "");
}

glm::dvec3 nodeCentre(const Scene& scene, const Pose& pose, int node) {
    Bounds bounds;
    for (const Object& object : pose.objects)
        if (object.node == node)
            bounds.extend(
                transformed(scene.meshes[static_cast<std::size_t>(object.mesh)].bounds(), object.worldFromObject));
    if (!bounds.empty()) return bounds.centre();
    return glm::dvec3(pose.worldFromNode[static_cast<std::size_t>(node)][3]);
}

}  // namespace defocus
