#include "scene/camera_files/camera_source.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "scene/camera_files/camera_json.h"
#include "scene/camera_files/usda_camera.h"
#include "scene/defaults.h"
#include "scene/gltf/gltf.h"

namespace defocus::engine {

namespace {

constexpr std::array<std::string_view, 4> extensions = {".usda", ".gltf", ".glb", ".json"};
constexpr std::array<std::string_view, 3> otherUsd = {".usdc", ".usdz", ".usd"};

// Returns the camera of a glTF scene, animated by the scene's first animation.
CameraTrack gltfCamera(const CameraSource& source) {
    const auto scene = std::make_shared<Scene>(loadGltf(source.file));
    scene->metresPerUnit = scene->ownMetresPerUnit.value_or(1);
    const CameraChoice choice = source.camera.empty() ? CameraChoice(FirstCamera{}) : NamedCamera{source.camera};
    const auto at = [scene, choice](double seconds) {
        const Pose pose = unmeasuredPoseAt(*scene, seconds);
        const PlacedCamera placed = chooseCamera(*scene, pose, choice, 1);
        return TrackedCamera{placed.camera, placed.worldFromCamera, false};
    };
    if (chooseCamera(*scene, unmeasuredPoseAt(*scene, 0), choice, 1).node < 0)
        fail("{}: the file has no perspective camera", source.file.string());
    CameraTrack track;
    track.at = at;
    track.moves = !scene->clips.empty();
    return track;
}

}  // namespace

CameraSource cameraSourceOf(const std::string& text) {
    std::size_t end = std::string::npos;
    for (const std::string_view extension : extensions) {
        const std::size_t found = text.find(std::string(extension) + ":");
        if (text.ends_with(extension)) end = std::min(end, text.size());
        if (found != std::string::npos) end = std::min(end, found + extension.size());
    }
    if (end != std::string::npos)
        return {text.substr(0, end), end < text.size() ? text.substr(end + 1) : std::string()};
    for (const std::string_view extension : otherUsd)
        if (text.find(extension) != std::string::npos)
            fail("'{}': USD cameras are read from .usda text only; convert the file with: usdcat FILE -o shot.usda",
                 text);
    fail("'{}' is not a camera file; give a .usda, .gltf, .glb or .json file, such as shot.usda:/World/cam", text);
}

CameraTrack openCamera(const std::string& text) {
    const CameraSource source = cameraSourceOf(text);
    const std::string extension = source.file.extension().string();
    CameraTrack track;
    if (extension == ".usda")
        track = usdCamera(parseUsda(readText(source.file), source.file.string()), source.camera, source.file.string());
    else if (extension == ".json")
        track = jsonCamera(readText(source.file), source.camera, source.file.string());
    else
        track = gltfCamera(source);
    track.source = text;
    return track;
}

}  // namespace defocus::engine
