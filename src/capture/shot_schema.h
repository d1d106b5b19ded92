#pragma once
// The JSON schema of shots (docs/shot.schema.json) where it is about settings: types, ranges, defaults and descriptions
// are those of frame/settings.h.

#include <nlohmann/json_fwd.hpp>

namespace defocus::engine {

// `schema` with everything that stands for a setting made anew; the rest (cameras, focus, frames, outputs) stays.
nlohmann::ordered_json withSettings(nlohmann::ordered_json schema);

}  // namespace defocus::engine
