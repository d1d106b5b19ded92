#pragma once
// Writes multi-layer EXR files: an image with its data layers.

#include <filesystem>
#include <string>
#include <vector>

#include "defocus/layers.h"
#include "image/image_io.h"
#include "render/layer_images.h"
#include "scene/pose.h"

namespace defocus::engine {

// Returns the channels of the image `picture` and of its layers, named in the style `names` (Nuke or Blender). Adds the
// metadata of Cryptomattes. Object indices refer to `pose`, material indices to `scene`.
std::vector<NamedChannels> layerChannels(const ImageView& picture, const LayerImages& layers, const Scene& scene,
                                         const Pose& pose, ExrNames names, Metadata& metadata);

// Writes an image as writeImage does, with its layers if the path is that of an EXR file and `layers` isn't null.
void writePicture(const std::filesystem::path& path, const ImageView& picture, const LayerImages* layers,
                  const Scene& scene, const Pose& pose, ExrNames names, Metadata metadata, const WriteOptions& options);

}  // namespace defocus::engine
