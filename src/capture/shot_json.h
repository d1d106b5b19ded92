#pragma once
// Reads shot files: JSON after docs/shot.schema.json. Error messages name the file, the place in it and the expected
// value:
//   shots/x.json: /camera/keys/2/position: expected three numbers or the name of a node, not "a"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/shot.h"
#include "core/error.h"

namespace defocus::engine {

// Replaces a value of the shot file: "/lens/fStop=1.4", "/focus={\"node\": \"Fish 3\"}". The place is a JSON pointer
// (RFC 6901). The value is JSON; any other text is taken as a string.
struct ShotOverride {
    std::string pointer;
    std::string value;
};

// Parses an override. Throws Error unless `text` is /PLACE=VALUE.
ShotOverride parseShotOverride(std::string_view text);

Shot loadShot(const std::filesystem::path& path, const std::vector<ShotOverride>& overrides = {});

// Parses a shot from text. `file` is used for messages and as the base of relative paths.
Shot parseShot(std::string_view text, const std::filesystem::path& file,
               const std::vector<ShotOverride>& overrides = {});

// Parses "0:240", or "12" for one frame. Throws Error that names the allowed values.
FrameRange parseFrameRange(std::string_view text);

// Throws Error for a name that the scene doesn't have. A name from the shot is reported with its place: "shot.json:
// /focus/node: there is no node …". A name from an option is reported without a place.
[[noreturn]] void failForName(const Shot& shot, const MissingName& missing);

}  // namespace defocus::engine
