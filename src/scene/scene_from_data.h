#pragma once
// Builds a Scene from data in memory (defocus/scene_data.h), as the glTF loader does from a file.

#include <string>
#include <string_view>

#include "defocus/scene_data.h"
#include "scene/scene.h"

namespace defocus::engine {

// Returns the scene with Scene::ownMetresPerUnit set. CameraData::lens is ignored. Throws UsageError, with the label of
// the faulty item, for sizes that don't match, indices or values out of range, NaN, infinity, or a scene without
// instances.
Scene sceneFromData(const SceneData& data);

// Returns a label for messages, such as "mesh 'Body' (0)", or "mesh 0" without a name.
std::string partLabel(std::string_view kind, std::size_t index, const std::string& name);

}  // namespace defocus::engine
