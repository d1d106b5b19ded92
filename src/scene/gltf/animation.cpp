// Source: glTF 2.0 specification, 3.7.3 (skins) and 3.11 (animations); KHR_animation_pointer, KHR_node_visibility.
#include "scene/gltf/animation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "core/parse.h"
#include "scene/gltf/accessor.h"

namespace defocus::engine::gltf {

namespace {

// Target of an animation channel: a node, camera or light, and the property that the channel drives.
struct Target {
    ChannelPath path = ChannelPath::translation;
    std::uint64_t index = 0;  // index of the node, camera or light in the file
    std::string lensValue;
};

std::optional<ChannelPath> nodePathNamed(const std::string& name) {
    if (name == "translation") return ChannelPath::translation;
    if (name == "rotation") return ChannelPath::rotation;
    if (name == "scale") return ChannelPath::scale;
    if (name == "weights") return ChannelPath::weights;
    return std::nullopt;
}

std::optional<ChannelPath> lightPathNamed(const std::string& name) {
    if (name == "color") return ChannelPath::lightColor;
    if (name == "intensity") return ChannelPath::lightIntensity;
    if (name == "range") return ChannelPath::lightRange;
    return std::nullopt;
}

// Splits a JSON pointer: "/nodes/3/scale" → nodes, 3, scale.
std::vector<std::string> pointerParts(const std::string& pointer) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        parts.push_back(pointer.substr(at + 1, end - at - 1));
        at = end;
    }
    return parts;
}

// Parses a pointer of KHR_animation_pointer to a node, camera or light property. Returns nullopt for other pointers.
std::optional<Target> pointedTarget(const std::string& pointer) {
    std::vector<std::string> parts = pointerParts(pointer);
    if (parts.size() == 5 && parts[0] == "extensions" && parts[1] == "KHR_lights_punctual" && parts[2] == "lights")
        parts.erase(parts.begin(), parts.begin() + 2);
    const std::optional<std::uint64_t> index = parts.size() > 1 ? parsedNumber<std::uint64_t>(parts[1]) : std::nullopt;
    if (!index) return std::nullopt;
    std::optional<ChannelPath> path;
    if (parts.size() == 3 && parts[0] == "nodes") path = nodePathNamed(parts[2]);
    if (parts.size() == 5 && parts[0] == "nodes" && parts[3] == "KHR_node_visibility" && parts[4] == "visible")
        path = ChannelPath::visible;
    if (parts.size() == 3 && parts[0] == "lights") path = lightPathNamed(parts[2]);
    if (parts.size() == 4 && parts[0] == "cameras") {
        if (parts[2] == "perspective" && parts[3] == "yfov") path = ChannelPath::cameraYfov;
        if (parts[2] == "perspective" && parts[3] == "znear") path = ChannelPath::cameraZnear;
        if (parts[2] == "extras") return Target{ChannelPath::cameraLens, *index, parts[3]};
    }
    return path ? std::optional(Target{*path, *index, ""}) : std::nullopt;
}

// Returns the property that a channel drives. If the property cannot be animated, adds an entry to Source::ignored and
// returns nullopt.
std::optional<Target> targetOf(Source& source, const nlohmann::json& json) {
    const auto path = json["path"].get<std::string>();
    if (path == "pointer") {
        const nlohmann::json* extension = findExtension(json, "KHR_animation_pointer");
        const std::string pointer = extension != nullptr ? (*extension)["pointer"].get<std::string>() : "";
        std::optional<Target> target = pointedTarget(pointer);
        if (!target) ignore(source, "animation channel", fmt::format("'{}' cannot be animated", pointer));
        return target;
    }
    const std::optional<ChannelPath> nodePath = nodePathNamed(path);
    if (!nodePath)
        ignore(source, "animation channel", fmt::format("'{}' cannot be animated", path));
    else if (!json.contains("node"))
        ignore(source, "animation channel", "it has no target node");
    else
        return Target{*nodePath, json["node"].get<std::uint64_t>(), ""};
    return std::nullopt;
}

bool ofTransform(ChannelPath path) {
    return path == ChannelPath::translation || path == ChannelPath::rotation || path == ChannelPath::scale;
}

bool ofNode(ChannelPath path) {
    return ofTransform(path) || path == ChannelPath::weights || path == ChannelPath::visible;
}

Interpolation interpolationNamed(const Source& source, const std::string& name, const std::string& what) {
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    fault(source.document, "{}: unknown interpolation '{}'", what, name);
}

std::vector<float> readTimes(Source& source, int accessor, const std::string& what) {
    std::vector<float> times = readFloats(source, accessor, 1, what + ": times");
    if (times.empty()) fault(source.document, "{}: it has no keyframes", what);
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && times[i] < times[i - 1]))
            fault(source.document, "{}: the keyframe times do not increase", what);
    return times;
}

// Returns the number of floats per key for the property that the channel drives.
std::size_t valuesPerKey(const AnimationChannel& channel, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes) {
    switch (channel.path) {
        case ChannelPath::rotation:
            return 4;
        case ChannelPath::translation:
        case ChannelPath::scale:
        case ChannelPath::lightColor:
            return 3;
        case ChannelPath::weights:
            break;
        default:
            return 1;
    }
    const int mesh = hierarchy.nodes[static_cast<std::size_t>(channel.target)].mesh;
    return mesh >= 0 ? meshes[static_cast<std::size_t>(mesh)].morphTargets.size() : 0;
}

void readKeys(Source& source, const tinygltf::AnimationSampler& sampler, std::size_t perKey, const std::string& what,
              AnimationChannel& channel) {
    channel.interpolation = interpolationNamed(source, sampler.interpolation, what);
    channel.times = readTimes(source, sampler.input, what);
    const int components = channel.path == ChannelPath::weights ? 1 : static_cast<int>(perKey);
    channel.values = readFloats(source, sampler.output, components, what + ": values");
    const std::size_t sets = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
    if (channel.values.size() != channel.times.size() * perKey * sets)
        fault(source.document, "{}: {} keyframes need {} values, not {}", what, channel.times.size(),
              channel.times.size() * perKey * sets, channel.values.size());
    if (!std::all_of(channel.values.begin(), channel.values.end(), [](float value) { return std::isfinite(value); }))
        fault(source.document, "{}: a value is NaN or infinite", what);
    if (channel.path != ChannelPath::rotation || channel.interpolation == Interpolation::cubicSpline) return;
    for (std::size_t i = 0; i < channel.values.size(); i += 4) {
        // Replace a zero quaternion by the identity rotation.
        float* value = &channel.values[i];
        if (value[0] == 0 && value[1] == 0 && value[2] == 0 && value[3] == 0) value[3] = 1;
    }
}

// Returns the target's index in Scene::nodes, cameras or lights; −1 if the target is a node outside the chosen glTF
// scene.
int keptTarget(const Source& source, const Target& target, const Hierarchy& hierarchy, const std::string& what) {
    const bool node = ofNode(target.path);
    const bool light = target.path == ChannelPath::lightColor || target.path == ChannelPath::lightIntensity ||
                       target.path == ChannelPath::lightRange;
    const std::size_t count = node    ? hierarchy.kept.size()
                              : light ? source.model.lights.size()
                                      : source.model.cameras.size();
    if (target.index >= count)
        fault(source.document, "{}: target {} {} does not exist; the file has {}", what,
              node    ? "node"
              : light ? "light"
                      : "camera",
              target.index, count);
    return node ? hierarchy.kept[target.index] : static_cast<int>(target.index);
}

AnimationClip readClip(Source& source, const tinygltf::Animation& from, std::size_t index, const Hierarchy& hierarchy,
                       const std::vector<Mesh>& meshes) {
    AnimationClip clip;
    clip.name = from.name;
    const nlohmann::json channels = source.document.json["animations"][index]["channels"];
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::string what = fmt::format("{}, channel {}", labelOf("animation", index, from.name), c);
        const auto sampler = channels[c]["sampler"].get<std::uint64_t>();
        if (sampler >= from.samplers.size()) fault(source.document, "{}: sampler {} does not exist", what, sampler);
        const std::optional<Target> target = targetOf(source, channels[c]["target"]);
        const int kept = target ? keptTarget(source, *target, hierarchy, what) : -1;
        if (kept < 0) continue;

        AnimationChannel channel;
        channel.target = kept;
        channel.path = target->path;
        channel.lensValue = target->lensValue;
        if (ofTransform(channel.path) && hierarchy.nodes[static_cast<std::size_t>(kept)].matrix) {
            ignore(source, "animation channel", "its node has a matrix, which cannot be animated");
            continue;
        }
        const std::size_t perKey = valuesPerKey(channel, hierarchy, meshes);
        if (perKey == 0) {
            ignore(source, "animation channel", "its node has no morph targets");
            continue;
        }
        readKeys(source, from.samplers[sampler], perKey, what, channel);
        clip.duration = std::max(clip.duration, channel.times.back());
        clip.channels.push_back(std::move(channel));
    }
    return clip;
}

}  // namespace

std::vector<AnimationClip> readAnimations(Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes) {
    std::vector<AnimationClip> clips;
    for (std::size_t i = 0; i < source.model.animations.size(); ++i)
        clips.push_back(readClip(source, source.model.animations[i], i, hierarchy, meshes));
    return clips;
}

std::vector<Skin> readSkins(Source& source, const Hierarchy& hierarchy) {
    std::vector<Skin> skins;
    for (std::size_t s = 0; s < source.model.skins.size(); ++s) {
        const tinygltf::Skin& from = source.model.skins[s];
        const std::string label = labelOf("skin", s, from.name);
        Skin skin;
        skin.name = from.name;
        for (const int joint : from.joints) skin.joints.push_back(hierarchy.kept[static_cast<std::size_t>(joint)]);
        if (skin.joints.empty()) fault(source.document, "{}: it has no joints", label);
        skin.inverseBindMatrices.assign(skin.joints.size(), glm::mat4(1.0f));
        if (from.inverseBindMatrices >= 0) {
            const std::vector<float> floats =
                readFloats(source, from.inverseBindMatrices, 16, label + ": inverseBindMatrices");
            if (floats.size() / 16 < skin.joints.size())
                fault(source.document, "{}: {} joints, but {} inverse bind matrices", label, skin.joints.size(),
                      floats.size() / 16);
            for (std::size_t j = 0; j < skin.joints.size(); ++j)
                skin.inverseBindMatrices[j] = glm::make_mat4(&floats[16 * j]);
        }
        skins.push_back(std::move(skin));
    }
    return skins;
}

void checkSkinnedMeshes(const Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes,
                        const std::vector<Skin>& skins) {
    // For each mesh, find the largest joint index that has a positive weight.
    std::vector<std::size_t> largest(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const auto look = [&](const std::vector<glm::u16vec4>& joints, const std::vector<glm::vec4>& weights) {
            for (std::size_t v = 0; v < joints.size(); ++v)
                for (int i = 0; i < 4; ++i)
                    if (weights[v][i] > 0) largest[m] = std::max<std::size_t>(largest[m], joints[v][i]);
        };
        look(meshes[m].vertices.joints, meshes[m].vertices.weights);
        look(meshes[m].vertices.joints1, meshes[m].vertices.weights1);
    }
    for (const Node& node : hierarchy.nodes) {
        if (node.skin < 0) continue;
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::size_t joints = skins[static_cast<std::size_t>(node.skin)].joints.size();
        if (largest[mesh] >= joints)
            fault(source.document, "{} uses joint {} of skin {}, which has {} joints",
                  labelOf("mesh", mesh, meshes[mesh].name), largest[mesh], node.skin, joints);
    }
}

}  // namespace defocus::engine::gltf
