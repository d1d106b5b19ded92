#pragma once
// Shot files: JSON as docs/shot.schema.json has it. Faults name the file, the place in it and what was expected:
//   shots/x.json: /camera/keys/2/position: expected three numbers or the name of a node, not "a"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/shot.h"
#include "core/error.h"

namespace defocus::engine {

// A value that replaces one of the file: "/lens/fStop=1.4", "/focus={\"node\": \"Fish 3\"}". The place is a JSON
// pointer (RFC 6901), the value JSON, or text where it is none.
struct ShotOverride {
    std::string pointer;
    std::string value;
};

// Throws Error unless `text` is /PLACE=VALUE.
ShotOverride parseShotOverride(std::string_view text);

Shot loadShot(const std::filesystem::path& path, const std::vector<ShotOverride>& overrides = {});

// The same from text; `file` is for messages and the base of relative paths.
Shot parseShot(std::string_view text, const std::filesystem::path& file,
               const std::vector<ShotOverride>& overrides = {});

// "0:240", or "12" for one frame. Throws Error saying what is allowed.
FrameRange parseFrameRange(std::string_view text);

// Throws Error for a name that the scene doesn't have: with its place in the shot, "shot.json: /focus/node: there is no
// node …", where it stands there; as it is, where an option gave it.
[[noreturn]] void failForName(const Shot& shot, const MissingName& missing);

}  // namespace defocus::engine
