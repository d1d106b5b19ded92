#pragma once
// Fills the JSON schema of shot files (docs/shot.schema.json) with the types, ranges, defaults and descriptions from
// the settings table.

#include <nlohmann/json_fwd.hpp>

namespace defocus::engine {

// Returns `schema` with all entries for settings replaced by entries generated from the settings table. Other entries
// (cameras, focus, frames, outputs) stay unchanged.
nlohmann::ordered_json withSettings(nlohmann::ordered_json schema);

}  // namespace defocus::engine
