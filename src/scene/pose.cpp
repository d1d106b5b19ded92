#include "scene/pose.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/luminance.h"
#include "core/suggestion.h"
#include "scene/animation.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

constexpr std::size_t namesListed = 40;  // max names in an error message

// Animatable properties of a node at one instant.
struct NodeState {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
    std::vector<double> morphWeights;
    bool visible;  // the node's own visibility; a hidden ancestor may still hide it
    bool hides;    // true: an animation hides the node at some times
};

// Animatable properties of a scene at one instant.
struct SceneState {
    std::vector<NodeState> nodes;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
};

glm::dmat4 matrixOf(const NodeState& node) {
    return glm::scale(glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation), node.scale);
}

// Returns the morph weights without animation: the node's weights if it has any, else those of its mesh.
std::vector<double> restWeights(const Scene& scene, const Node& node) {
    if (node.mesh < 0) return {};
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    const std::vector<float>& given = node.morphWeights.empty() ? mesh.morphWeights : node.morphWeights;
    std::vector<double> weights(given.begin(), given.end());
    weights.resize(mesh.morphTargets.size());
    return weights;
}

void animateNode(const AnimationChannel& channel, double time, NodeState& node) {
    if (channel.path == ChannelPath::rotation) {
        node.rotation = sampleRotation(channel, time);
    } else if (channel.path == ChannelPath::visible) {
        node.visible = sampleValues(channel, 1, time)[0] >= 0.5;
        node.hides = true;
    } else if (channel.path == ChannelPath::weights) {
        node.morphWeights = sampleValues(channel, node.morphWeights.size(), time);
    } else {
        const std::vector<double> value = sampleValues(channel, 3, time);
        (channel.path == ChannelPath::translation ? node.translation : node.scale) = {value[0], value[1], value[2]};
    }
}

// Sets the camera property that `channel` drives. Values are clamped to the valid range, because splines may overshoot.
void animateCamera(const AnimationChannel& channel, double time, Camera& camera) {
    constexpr double minAngle = 1e-4;
    const double value = sampleValues(channel, 1, time)[0];
    if (channel.path == ChannelPath::cameraYfov)
        camera.yfov = std::clamp(value, minAngle, std::numbers::pi - minAngle);
    else if (channel.path == ChannelPath::cameraZnear)
        camera.znear = std::max(value, 1e-6);
    else
        camera.lens[channel.lensValue] = value;
}

void animateLight(const AnimationChannel& channel, double time, Light& light) {
    const std::vector<double> value = sampleValues(channel, channel.path == ChannelPath::lightColor ? 3 : 1, time);
    const auto positive = [](double number) { return static_cast<float>(std::max(number, 0.0)); };
    if (channel.path == ChannelPath::lightColor)
        light.color = {positive(value[0]), positive(value[1]), positive(value[2])};
    else
        (channel.path == ChannelPath::lightIntensity ? light.intensity : light.range) = positive(value[0]);
}

void animate(const AnimationClip& clip, double time, SceneState& state) {
    for (const AnimationChannel& channel : clip.channels) {
        const auto target = static_cast<std::size_t>(channel.target);
        switch (channel.path) {
            case ChannelPath::translation:
            case ChannelPath::rotation:
            case ChannelPath::scale:
            case ChannelPath::weights:
            case ChannelPath::visible:
                animateNode(channel, time, state.nodes[target]);
                break;
            case ChannelPath::cameraYfov:
            case ChannelPath::cameraZnear:
            case ChannelPath::cameraLens:
                animateCamera(channel, time, state.cameras[target]);
                break;
            case ChannelPath::lightColor:
            case ChannelPath::lightIntensity:
            case ChannelPath::lightRange:
                animateLight(channel, time, state.lights[target]);
                break;
        }
    }
}

SceneState stateAt(const Scene& scene, double time, int clip) {
    SceneState state{{}, scene.cameras, scene.lights};
    state.nodes.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes)
        state.nodes.push_back(
            {node.translation, node.rotation, node.scale, restWeights(scene, node), node.visible, false});
    if (clip >= 0 && !scene.clips.empty()) {
        if (static_cast<std::size_t>(clip) >= scene.clips.size())
            fail("there is no animation {}; the scene has {} animations (0 to {})", clip, scene.clips.size(),
                 scene.clips.size() - 1);
        animate(scene.clips[static_cast<std::size_t>(clip)], time, state);
    }
    return state;
}

// Converts lengths of cameras and lights from scene units to metres. Intensities of point and spot lights are scaled so
// that the illuminance of surfaces does not change.
void toMetres(double metresPerUnit, SceneState& state) {
    constexpr std::string_view lengths[] = {"focusDistance", "focusRangeFront", "focusRangeBehind"};
    for (Camera& camera : state.cameras) {
        camera.znear *= metresPerUnit;
        for (const std::string_view name : lengths)
            if (const auto found = camera.lens.find(name); found != camera.lens.end()) found->second *= metresPerUnit;
    }
    for (Light& light : state.lights) {
        light.range *= static_cast<float>(metresPerUnit);
        if (light.type != LightType::directional) light.intensity *= static_cast<float>(metresPerUnit * metresPerUnit);
    }
}

// Calls `visit(node, parent)` for `start` and its descendants, parents first. Iterative, because a hierarchy may be too
// deep for recursion.
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

// Returns, for each joint of the skin, the matrix from mesh space to world space.
std::vector<glm::dmat4> jointMatrices(const Skin& skin, const std::vector<glm::dmat4>& worldFromNode) {
    std::vector<glm::dmat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        matrices.push_back(worldFromNode[static_cast<std::size_t>(skin.joints[j])] *
                           glm::dmat4(skin.inverseBindMatrices[j]));
    return matrices;
}

void placeObjects(const Scene& scene, const SceneState& state, int nodeIndex, double cocScale, Pose& pose) {
    const Node& node = scene.nodes[static_cast<std::size_t>(nodeIndex)];
    if (node.mesh < 0) return;
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    const glm::dmat4& worldFromNode = pose.worldFromNode[static_cast<std::size_t>(nodeIndex)];
    Object object;
    object.mesh = node.mesh;
    object.node = nodeIndex;
    object.name = !node.name.empty() ? node.name : mesh.name;
    object.worldFromObject = worldFromNode;
    object.morphWeights = state.nodes[static_cast<std::size_t>(nodeIndex)].morphWeights;
    object.cocScale = cocScale;
    object.ground = node.ground;
    if (node.instances.empty()) {
        if (node.skin >= 0 && !mesh.vertices.joints.empty()) {
            object.worldFromJoint = jointMatrices(scene.skins[static_cast<std::size_t>(node.skin)], pose.worldFromNode);
            if (object.skinned()) object.worldFromObject = object.worldFromJoint.front();
        }
        pose.objects.push_back(std::move(object));
        return;
    }
    const std::string name = object.name;
    for (std::size_t i = 0; i < node.instances.size(); ++i) {
        object.name = fmt::format("{}#{}", name, i);
        object.worldFromObject = worldFromNode * node.instances[i];
        pose.objects.push_back(object);
    }
}

void placeLight(const Scene& scene, const SceneState& state, int nodeIndex, bool visible, Pose& pose) {
    const Node& node = scene.nodes[static_cast<std::size_t>(nodeIndex)];
    if (node.light < 0) return;
    const glm::dmat4& world = pose.worldFromNode[static_cast<std::size_t>(nodeIndex)];
    PlacedLight placed{state.lights[static_cast<std::size_t>(node.light)], glm::dvec3(world[3]), {0, 0, -1}};
    if (!visible) placed.light.intensity = 0;
    const glm::dvec3 direction = -glm::dvec3(world[2]);
    const double length = glm::length(direction);
    if (length > 0) placed.direction = direction / length;
    pose.lights.push_back(placed);
}

// Keeps the maxLights brightest lights, in their original order. Directional lights count as brighter than all others.
void leaveOutFaintLights(Pose& pose) {
    if (pose.lights.size() <= maxLights) return;
    const auto brightness = [&](std::size_t light) {
        const Light& from = pose.lights[light].light;
        if (from.type == LightType::directional) return std::numeric_limits<double>::infinity();
        const double candela = from.intensity * luminance(glm::dvec3(from.color));
        return std::max(0.0, candela);  // this order of arguments maps NaN to 0
    };
    std::vector<std::size_t> order(pose.lights.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(), brightness);
    pose.faintLights = order.size() - maxLights;
    order.resize(maxLights);
    std::ranges::sort(order);
    std::vector<PlacedLight> kept;
    for (const std::size_t light : order) kept.push_back(pose.lights[light]);
    pose.lights = std::move(kept);
}

// Visibility of a node, including the visibility of its ancestors.
struct Visibility {
    bool now = true;
    bool everShown = true;  // false: the node is hidden at all times
};

// Returns which nodes have an object in the pose.
std::vector<bool> nodesOf(const Scene& scene, const Pose& pose) {
    std::vector<bool> nodes(scene.nodes.size());
    for (const Object& object : pose.objects) nodes[static_cast<std::size_t>(object.node)] = true;
    return nodes;
}

// Returns a pose without bounds. The pose has the objects of the same nodes as `exposed`, the pose at the frame's own
// time. If `exposed` is null, the pose has the objects of the nodes that are visible at `time`.
Pose posed(const Scene& scene, double time, int clip, const Pose* exposed) {
    // Compute world matrices from parents to children: first the nodes of the drawn scene, then nodes outside it that
    // skins use as joints.
    SceneState state = stateAt(scene, time, clip);
    toMetres(scene.metresPerUnit, state);
    const glm::dmat4 metresFromUnits = glm::scale(glm::dmat4(1.0), glm::dvec3(scene.metresPerUnit));
    Pose pose;
    pose.worldFromNode.assign(scene.nodes.size(), glm::dmat4(1.0));
    std::vector<double> cocScales(scene.nodes.size(), 1.0);  // blur factors: product over a node and its ancestors
    std::vector<Visibility> visible(scene.nodes.size());
    std::vector<bool> visited(scene.nodes.size());
    const auto place = [&](int node, int parent) {
        const auto index = static_cast<std::size_t>(node);
        cocScales[index] = scene.nodes[index].cocScale * (parent < 0 ? 1 : cocScales[static_cast<std::size_t>(parent)]);
        const NodeState& own = state.nodes[index];
        const Visibility above = parent < 0 ? Visibility{} : visible[static_cast<std::size_t>(parent)];
        visible[index] = {above.now && own.visible, above.everShown && (own.visible || own.hides)};
        const glm::dmat4 local = scene.nodes[index].matrix ? *scene.nodes[index].matrix : matrixOf(state.nodes[index]);
        pose.worldFromNode[index] =
            parent < 0 ? metresFromUnits * local : pose.worldFromNode[static_cast<std::size_t>(parent)] * local;
    };
    for (const int root : scene.roots) walkDown(scene, root, visited, place);
    const std::vector<bool> drawn = visited;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent < 0) walkDown(scene, static_cast<int>(i), visited, place);

    // Add the objects of the shown nodes, and the lights, in node order.
    const std::vector<bool> shown = exposed != nullptr ? nodesOf(scene, *exposed) : std::vector<bool>();
    pose.objects.reserve(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!drawn[i]) continue;
        if (exposed != nullptr ? shown[i] : visible[i].now)
            placeObjects(scene, state, static_cast<int>(i), cocScales[i], pose);
        if (visible[i].everShown) placeLight(scene, state, static_cast<int>(i), visible[i].now, pose);
    }
    leaveOutFaintLights(pose);
    pose.cameras = std::move(state.cameras);
    if (scene.cameraTrack) pose.tracked = scene.cameraTrack->at(time);
    return pose;
}

}  // namespace

Pose unmeasuredPoseAt(const Scene& scene, double time, int clip) {
    return posed(scene, time, clip, nullptr);
}

Pose shutterPoseAt(const Scene& scene, double time, int clip, const Pose& exposed) {
    return posed(scene, time, clip, &exposed);
}

Pose poseAt(const Scene& scene, double time, int clip) {
    Pose pose = unmeasuredPoseAt(scene, time, clip);
    pose.bounds = posedBounds(scene, pose);
    return pose;
}

namespace {

std::string missingNode(std::string_view name, const std::vector<std::string>& names) {
    if (names.empty()) return fmt::format("there is no node '{}'; the scene's nodes have no names", name);
    if (const std::string nearest = nearestWord(name, names); !nearest.empty())
        return fmt::format("there is no node '{}'; did you mean '{}'?", name, nearest);
    const std::size_t listed = std::min(names.size(), namesListed);
    return fmt::format("there is no node '{}'; the scene has: {}{}", name,
                       fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(listed), ", "),
                       listed < names.size() ? fmt::format(", … and {} more", names.size() - listed) : "");
}

}  // namespace

std::vector<PlacedLight> movedLights(const std::vector<PlacedLight>& before, const Pose& pose) {
    if (pose.lights.empty()) return before;
    std::vector<PlacedLight> moved = pose.lights;
    for (std::size_t i = 0; i < std::min(moved.size(), before.size()); ++i) {
        moved[i].light.angularDiameter = before[i].light.angularDiameter;
        moved[i].light.radius = before[i].light.radius;
    }
    return moved;
}

int nodeNamed(const Scene& scene, std::string_view name) {
    std::vector<std::string> names;
    for (const Node& node : scene.nodes) names.push_back(node.name);
    if (const auto place = placeOfName(name, names)) return static_cast<int>(*place);
    std::erase(names, "");
    throw MissingName(std::string(name), missingNode(name, names));
}

glm::dvec3 nodeCentre(const Scene& scene, const Pose& pose, int node) {
    Bounds bounds;
    for (const Object& object : pose.objects)
        if (object.node == node)
            bounds.extend(posedBounds(scene.meshes[static_cast<std::size_t>(object.mesh)], object));
    if (!bounds.empty()) return bounds.centre();
    return glm::dvec3(pose.worldFromNode[static_cast<std::size_t>(node)][3]);
}

}  // namespace defocus::engine
