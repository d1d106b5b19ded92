#pragma once
// A glTF file split into its parts, before anything in it is interpreted: the JSON, a .glb's binary chunk, and the way
// to what lies in other files. Internal to the loader.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace defocus::engine::gltf {

struct Document {
    std::string file;                                   // as given, for messages
    std::filesystem::path folder;                       // URIs are relative to it
    nlohmann::json json;                                // an object
    std::optional<std::vector<std::byte>> binaryChunk;  // .glb only
    std::uint64_t fileBytes = 0;
};

// Reads `path`; a container or JSON that breaks the standard (length, magic, version, byte order mark, nesting) is an
// Error.
Document readDocument(const std::filesystem::path& path);

// How many entries the JSON's array `name` has.
std::size_t entryCount(const Document& document, std::string_view name);

// Whether a URI holds its data itself.
bool isDataUri(const std::string& uri);

// The regular file, relative to the document, that a URI stands for; none for data: of its own. Throws Error where
// there is no such file. `what` names the user in messages.
std::optional<std::filesystem::path> uriFile(const Document& document, const std::string& uri, const std::string& what);

// The bytes behind a URI: data: of any media type (base64, also with line breaks, or percent-coded), or its file.
std::vector<std::byte> readUri(const Document& document, const std::string& uri, const std::string& what);

// `text` with control characters as spaces and cut after a few hundred bytes: names from a file must not break an error
// into lines or bury it.
std::string oneLine(std::string text);

// Throws Error "file: …", one line.
template <typename... Args>
[[noreturn]] void fault(const Document& document, fmt::format_string<Args...> format, Args&&... args) {
    throw Error(document.file + ": " + oneLine(fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace defocus::engine::gltf
