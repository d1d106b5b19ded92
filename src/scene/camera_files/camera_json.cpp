#include "scene/camera_files/camera_json.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/json_text.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

double numberAt(const Json& object, const char* name, const std::string& what) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) fail("{}: {} must be a number", what, name);
    return found->get<double>();
}

CameraSample sampleOf(const Json& json, const std::string& what) {
    if (!json.is_object()) fail("{}: expected an object", what);
    CameraSample sample;
    sample.time = numberAt(json, "time", what);
    sample.nearPlane = numberAt(json, "nearPlane", what);
    if (!(sample.nearPlane > 0)) fail("{}: nearPlane must be above 0", what);
    const auto matrix = json.find("worldFromCamera");
    if (matrix == json.end() || !matrix->is_array() || matrix->size() != 16 ||
        !std::ranges::all_of(*matrix, [](const Json& value) { return value.is_number(); }))
        fail("{}: worldFromCamera must be 16 numbers", what);
    sample.worldFromCamera = glm::make_mat4(matrix->get<std::vector<double>>().data());
    if (glm::determinant(glm::dmat3(sample.worldFromCamera)) == 0) fail("{}: worldFromCamera has no inverse", what);
    const auto lens = json.find("lens");
    if (lens == json.end() || !lens->is_object()) fail("{}: 'lens' must be an object", what);
    for (const auto& [name, value] : lens->items()) {
        if (!value.is_number()) fail("{}: lens value {} must be a number", what, name);
        sample.lens[name] = value.get<double>();
    }
    for (const char* name : {"focalLength", "horizontalAperture"})
        if (!(lensValueOf(sample, name, 0) > 0)) fail("{}: lens value {} must be above 0", what, name);
    return sample;
}

// Interpolates between the rigid transforms `a` and `b`: positions linearly, rotations spherically. `share`: weight of
// `b`, 0 … 1.
glm::dmat4 mixed(const glm::dmat4& a, const glm::dmat4& b, double share) {
    const glm::dquat rotation = glm::slerp(glm::quat_cast(glm::dmat3(a)), glm::quat_cast(glm::dmat3(b)), share);
    glm::dmat4 result = glm::mat4_cast(rotation);
    result[3] = glm::mix(a[3], b[3], share);
    return result;
}

TrackedCamera stateAt(const CameraTake& take, double time) {
    const std::vector<CameraSample>& samples = take.samples;
    const auto found = std::ranges::upper_bound(samples, time, {}, &CameraSample::time);
    const CameraSample& after = found == samples.end() ? samples.back() : *found;
    const CameraSample& before = found == samples.begin() ? samples.front() : *(found - 1);
    const double span = after.time - before.time;
    const double share = span > 0 ? std::clamp((time - before.time) / span, 0.0, 1.0) : 0;
    TrackedCamera tracked;
    tracked.worldFromCamera =
        share == 0 ? before.worldFromCamera : mixed(before.worldFromCamera, after.worldFromCamera, share);
    tracked.camera.name = take.name;
    tracked.camera.aspectRatio = take.aspect;
    tracked.camera.znear = std::lerp(before.nearPlane, after.nearPlane, share);
    tracked.camera.lens = before.lens;
    for (auto& [name, value] : tracked.camera.lens) value = std::lerp(value, lensValueOf(after, name, value), share);
    tracked.camera.yfov =
        2 * std::atan(std::lerp(tanHalfHorizontal(before), tanHalfHorizontal(after), share) / take.aspect);
    return tracked;
}

}  // namespace

std::string cameraJsonText(const CameraTake& take) {
    Json json = {{"camera", take.name}, {"aspectRatio", take.aspect}, {"frameRate", take.frameRate}};
    if (take.shutter) json["shutter"] = {{"open", take.shutter->open}, {"close", take.shutter->close}};
    for (const CameraSample& sample : take.samples) {
        const double* matrix = glm::value_ptr(sample.worldFromCamera);
        json["samples"].push_back({{"time", sample.time},
                                   {"worldFromCamera", std::vector<double>(matrix, matrix + 16)},
                                   {"nearPlane", sample.nearPlane},
                                   {"lens", sample.lens}});
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

CameraTrack jsonCamera(std::string_view text, const std::string& name, const std::string& file) {
    if (jsonNesting(text) > deepestJson) fail("{}: the JSON text is nested too deeply", file);
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("camera") || !json["camera"].is_string())
        fail("{}: not a camera written by 'defocus export-camera'", file);
    auto take = std::make_shared<CameraTake>();
    take->name = json["camera"].get<std::string>();
    if (!name.empty() && name != take->name) fail("{}: the file's camera is '{}', not '{}'", file, take->name, name);
    take->aspect = numberAt(json, "aspectRatio", file);
    if (!(take->aspect > 0)) fail("{}: aspectRatio must be above 0", file);
    const auto samples = json.find("samples");
    if (samples == json.end() || !samples->is_array() || samples->empty())
        fail("{}: 'samples' must be a list of one or more cameras", file);
    for (std::size_t i = 0; i < samples->size(); ++i) {
        take->samples.push_back(sampleOf((*samples)[i], fmt::format("{}: sample {}", file, i)));
        if (i > 0 && take->samples[i].time <= take->samples[i - 1].time)
            fail("{}: the times of 'samples' must increase", file);
    }
    CameraTrack track;
    if (const auto shutter = json.find("shutter"); shutter != json.end()) {
        if (!shutter->is_object()) fail("{}: 'shutter' must be an object", file);
        track.shutter = ShutterInterval{numberAt(*shutter, "open", file), numberAt(*shutter, "close", file)};
        if (track.shutter->close < track.shutter->open) fail("{}: the shutter closes before it opens", file);
    }
    track.moves = take->samples.size() > 1;
    track.at = [take = std::shared_ptr<const CameraTake>(take)](double seconds) { return stateAt(*take, seconds); };
    return track;
}

}  // namespace defocus::engine
