#pragma once
// Multi-layer EXR files: a picture with its data layers.

#include <filesystem>
#include <string>
#include <vector>

#include "defocus/layers.h"
#include "image/image_io.h"
#include "render/layer_images.h"
#include "scene/pose.h"

namespace defocus::engine {

// Returns the picture and its layers with the channel names of `names`, and adds the metadata of Cryptomattes. Object
// indices refer to `pose`, material indices to `scene`.
std::vector<NamedChannels> layerChannels(const ImageView& picture, const LayerImages& layers, const Scene& scene,
                                         const Pose& pose, ExrNames names, Metadata& metadata);

// Returns whether files with this name can hold layers.
bool holdsLayers(const std::filesystem::path& path);

// Writes a picture like writeImage. A file that holds layers also gets `layers` unless they are null.
void writePicture(const std::filesystem::path& path, const ImageView& picture, const LayerImages* layers,
                  const Scene& scene, const Pose& pose, ExrNames names, Metadata metadata, const WriteOptions& options);

}  // namespace defocus::engine
