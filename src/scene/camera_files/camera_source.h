#pragma once
// Opens a camera that is stored in a separate file.

#include <filesystem>
#include <string>

#include "scene/camera_track.h"

namespace defocus::engine {

// Parts of a camera reference such as "shot.usda:/World/cam": the file, and the camera within the file.
struct CameraSource {
    std::filesystem::path file;
    std::string camera;  // path or name of the camera; empty: the file's only or first camera
};

// Splits a camera reference at the first colon after the file's extension. Throws Error for an extension other than
// .usda, .gltf, .glb and .json; the message says how to convert other USD files.
CameraSource cameraSourceOf(const std::string& text);

// Reads the camera that a camera reference such as "shot.usda:/World/cam" names. Throws Error, with the file's name, if
// the file or the camera can't be used.
CameraTrack openCamera(const std::string& source);

}  // namespace defocus::engine
