#pragma once
// Reads shot files: JSON that follows docs/shot.schema.json. Error messages contain the file, the location in the file
// and the expected value:
//   shots/x.json: /camera/keys/2/position: expected three numbers or the name of a node, not "a"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/shot.h"
#include "core/error.h"

namespace defocus::engine {

// Replaces a value of the shot file, as in "/lens/fStop=1.4" or "/focus={\"node\": \"Fish 3\"}". The location is a JSON
// pointer (RFC 6901). A value that isn't JSON becomes a string.
struct ShotOverride {
    std::string pointer;
    std::string value;
};

// Parses an override. Throws Error unless `text` has the form /PLACE=VALUE.
ShotOverride parseShotOverride(std::string_view text);

Shot loadShot(const std::filesystem::path& path, const std::vector<ShotOverride>& overrides = {});

// Parses the text of a shot file. `file`: for messages and as the base of relative paths.
Shot parseShot(std::string_view text, const std::filesystem::path& file,
               const std::vector<ShotOverride>& overrides = {});

// Parses "0:240", or "12" for a single frame. Throws Error, with the allowed format in its message, for any other text.
FrameRange parseFrameRange(std::string_view text);

// Throws Error for a name that the scene doesn't have. If the name is from the shot, the message contains its location:
// "shot.json: /focus/node: there is no node …". If it is from an option, the message contains no location.
[[noreturn]] void failForName(const Shot& shot, const MissingName& missing);

}  // namespace defocus::engine
