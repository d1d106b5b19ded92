#pragma once
// Fills the JSON schema of shots (docs/shot.schema.json) with the types, ranges, defaults and descriptions of the
// settings table.

#include <nlohmann/json_fwd.hpp>

namespace defocus::engine {

// Returns `schema` with all entries of settings replaced. Other entries (cameras, focus, frames, outputs) stay.
nlohmann::ordered_json withSettings(nlohmann::ordered_json schema);

}  // namespace defocus::engine
