// Sources: glTF 2.0 specification, cameras (3.10) and animations (3.11); KHR_animation_pointer.

#include "scene/camera_files/camera_gltf.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/base64.h"

namespace defocus::engine {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and are copied from memory");

using Json = nlohmann::ordered_json;
using Values = std::vector<double>;

double yfovOf(const CameraTake& take, const CameraSample& sample) {
    return 2 * std::atan(tanHalfHorizontal(sample) / take.aspect);
}

// Returns the names of the lens values that are written as glTF extras. The focal length is left out, because it
// follows from the field of view.
std::vector<std::string> extraNames(const CameraTake& take) {
    std::vector<std::string> names = lensNames(take);
    std::erase(names, "focalLength");
    return names;
}

// Collects the animation's channels, and the buffer that holds its key frames.
class Keys {
public:
    explicit Keys(const CameraTake& take) : take_(take) {
        std::vector<float> times;
        for (const CameraSample& sample : take.samples) times.push_back(static_cast<float>(sample.time));
        append(times, "SCALAR", 1);
        json["accessors"][0]["min"] = {times.front()};
        json["accessors"][0]["max"] = {times.back()};
    }

    // Adds a channel, unless its value is the same in all samples.
    void add(const Json& target, const char* type, const std::function<Values(const CameraSample&)>& valueOf) {
        const Values first = valueOf(take_.samples.front());
        std::vector<float> values;
        bool changes = false;
        for (const CameraSample& sample : take_.samples) {
            const Values value = valueOf(sample);
            changes = changes || value != first;
            values.insert(values.end(), value.begin(), value.end());
        }
        if (!changes) return;
        const int output = append(values, type, first.size());
        animation["samplers"].push_back({{"input", 0}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1}, {"target", target}});
    }

    void addPointer(const std::string& pointer, const std::function<double(const CameraSample&)>& valueOf) {
        add({{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}, "SCALAR",
            [&](const CameraSample& sample) { return Values{valueOf(sample)}; });
    }

    // Adds the buffer and the animation to the file, unless all samples have the same values.
    void finish(Json& file) {
        if (animation.empty()) return;
        file["extensionsUsed"] = {"KHR_animation_pointer"};
        file["animations"] = {animation};
        file["accessors"] = json["accessors"];
        file["bufferViews"] = json["bufferViews"];
        file["buffers"] = {
            {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
    }

    Json json;
    Json animation;

private:
    int append(const std::vector<float>& values, const char* type, std::size_t components) {
        const std::size_t begin = bytes_.size();
        bytes_.resize(begin + values.size() * sizeof(float));
        std::memcpy(bytes_.data() + begin, values.data(), bytes_.size() - begin);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    const CameraTake& take_;
    std::vector<std::byte> bytes_;
};

Values translationOf(const CameraSample& sample) {
    const glm::dvec4& position = sample.worldFromCamera[3];
    return {position.x, position.y, position.z};
}

glm::dquat rotationOf(const CameraSample& sample) {
    return glm::normalize(glm::quat_cast(glm::dmat3(sample.worldFromCamera)));
}

Values components(const glm::dquat& rotation) {
    return {rotation.x, rotation.y, rotation.z, rotation.w};
}

}  // namespace

std::string cameraGltfText(const CameraTake& take) {
    const CameraSample& first = take.samples.front();
    Json extras = Json::object();
    for (const std::string& name : extraNames(take)) extras[name] = lensValueOf(first, name, 0);
    Json file = {
        {"asset", {{"version", "2.0"}, {"generator", "defocus"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes",
         {{{"name", take.name},
           {"camera", 0},
           {"translation", translationOf(first)},
           {"rotation", components(rotationOf(first))}}}},
        {"cameras",
         {{{"name", take.name},
           {"type", "perspective"},
           {"perspective", {{"yfov", yfovOf(take, first)}, {"aspectRatio", take.aspect}, {"znear", first.nearPlane}}},
           {"extras", extras}}}}};
    Keys keys(take);
    keys.add({{"node", 0}, {"path", "translation"}}, "VEC3", translationOf);
    keys.add({{"node", 0}, {"path", "rotation"}}, "VEC4",
             [](const CameraSample& sample) { return components(rotationOf(sample)); });
    keys.addPointer("/cameras/0/perspective/yfov", [&](const CameraSample& sample) { return yfovOf(take, sample); });
    keys.addPointer("/cameras/0/perspective/znear", [](const CameraSample& sample) { return sample.nearPlane; });
    for (const std::string& name : extraNames(take))
        keys.addPointer("/cameras/0/extras/" + name,
                        [&](const CameraSample& sample) { return lensValueOf(sample, name, 0); });
    keys.finish(file);
    return file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace defocus::engine
