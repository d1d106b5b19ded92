// glTF 2.0 specification, 3.7.3 (skins) and 3.11 (animations).
#include "scene/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scene/gltf_accessor.h"

namespace defocus::gltf {

namespace {

std::optional<ChannelPath> pathNamed(const std::string& name) {
    if (name == "translation") return ChannelPath::translation;
    if (name == "rotation") return ChannelPath::rotation;
    if (name == "scale") return ChannelPath::scale;
    if (name == "weights") return ChannelPath::weights;
    return std::nullopt;
}

Interpolation interpolationNamed(const Source& source, const std::string& name, const std::string& what) {
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    fault(source.document, "{}: unknown interpolation '{}'", what, name);
}

std::vector<float> readTimes(Source& source, int accessor, const std::string& what) {
    std::vector<float> times = readFloats(source, accessor, 1, what + ": times");
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && times[i] < times[i - 1]))
            fault(source.document, "{}: its times do not increase", what);
    return times;
}

// Values a key, by what the channel drives.
std::size_t valuesPerKey(const AnimationChannel& channel, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes) {
    if (channel.path == ChannelPath::rotation) return 4;
    if (channel.path != ChannelPath::weights) return 3;
    const int mesh = hierarchy.nodes[static_cast<std::size_t>(channel.node)].mesh;
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
        fault(source.document, "{}: {} keys need {} values, not {}", what, channel.times.size(),
              channel.times.size() * perKey * sets, channel.values.size());
    if (!std::all_of(channel.values.begin(), channel.values.end(), [](float value) { return std::isfinite(value); }))
        fault(source.document, "{}: its values are not finite", what);
    if (channel.path != ChannelPath::rotation || channel.interpolation == Interpolation::cubicSpline) return;
    for (std::size_t i = 0; i < channel.values.size(); i += 4) {
        // A rotation of no length means none.
        float* value = &channel.values[i];
        if (value[0] == 0 && value[1] == 0 && value[2] == 0 && value[3] == 0) value[3] = 1;
    }
}

AnimationClip readClip(Source& source, const tinygltf::Animation& from, std::size_t index, const Hierarchy& hierarchy,
                       const std::vector<Mesh>& meshes) {
    AnimationClip clip;
    clip.name = from.name;
    const std::size_t listed = source.document.json["animations"][index]["channels"].size();
    if (listed > from.channels.size())
        ignore(source, "animation channel", "it drives no node", listed - from.channels.size());
    for (std::size_t c = 0; c < from.channels.size(); ++c) {
        const tinygltf::AnimationChannel& fromChannel = from.channels[c];
        const std::string what = fmt::format("{}, channel {}", labelOf("animation", index, from.name), c);
        if (static_cast<std::size_t>(fromChannel.sampler) >= from.samplers.size())
            fault(source.document, "{}: sampler {} does not exist", what, fromChannel.sampler);
        const std::optional<ChannelPath> path = pathNamed(fromChannel.target_path);
        const int node = hierarchy.kept[static_cast<std::size_t>(fromChannel.target_node)];
        if (!path) ignore(source, "animation channel", fmt::format("'{}' cannot be animated", fromChannel.target_path));
        if (!path || node < 0) continue;

        AnimationChannel channel;
        channel.node = node;
        channel.path = *path;
        if (channel.path != ChannelPath::weights && hierarchy.nodes[static_cast<std::size_t>(node)].matrix) {
            ignore(source, "animation channel", "its node has a matrix, which cannot be animated");
            continue;
        }
        const std::size_t perKey = valuesPerKey(channel, hierarchy, meshes);
        if (perKey == 0) {
            ignore(source, "animation channel", "its node has no morph targets");
            continue;
        }
        readKeys(source, from.samplers[static_cast<std::size_t>(fromChannel.sampler)], perKey, what, channel);
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
    // The largest joint index that counts, by mesh.
    std::vector<std::size_t> largest(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::size_t v = 0; v < meshes[m].vertices.joints.size(); ++v)
            for (int i = 0; i < 4; ++i)
                if (meshes[m].vertices.weights[v][i] > 0)
                    largest[m] = std::max<std::size_t>(largest[m], meshes[m].vertices.joints[v][i]);
    for (const Node& node : hierarchy.nodes) {
        if (node.skin < 0) continue;
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::size_t joints = skins[static_cast<std::size_t>(node.skin)].joints.size();
        if (largest[mesh] >= joints)
            fault(source.document, "{} uses joint {} of skin {}, which has {}",
                  labelOf("mesh", mesh, meshes[mesh].name), largest[mesh], node.skin, joints);
    }
}

}  // namespace defocus::gltf
