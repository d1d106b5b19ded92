#pragma once
// Splits a glTF file into JSON and the binary chunk of a .glb file, and reads the files and data URIs that the JSON
// refers to. Internal to the glTF loader.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/message.h"

namespace defocus::engine::gltf {

struct Document {
    std::string file;                                   // path as given by the user, for error messages
    std::filesystem::path folder;                       // base folder of relative URIs
    nlohmann::json json;                                // always a JSON object
    std::optional<std::vector<std::byte>> binaryChunk;  // binary chunk; only for .glb files
    std::uint64_t fileBytes = 0;
};

// Reads a .gltf or .glb file. Throws Error if the JSON or the GLB container is invalid: length, magic number, version,
// byte order mark or nesting depth.
Document readDocument(const std::filesystem::path& path);

// Returns the number of entries in the JSON's top-level array `name`; 0 if the array does not exist.
std::size_t entryCount(const Document& document, std::string_view name);

// Returns whether the URI contains its data ("data:…"); the scheme may be in upper case and preceded by white space.
bool isDataUri(const std::string& uri);

// Returns the path of the file that a URI refers to, relative to the document's folder; nullopt for data URIs. A
// backslash, which some exporters write on Windows, counts as a slash if there is no file with a backslash in its name.
// Throws Error if there is no such regular file. `what` describes the object with the URI in error messages.
std::optional<std::filesystem::path> uriFile(const Document& document, const std::string& uri, const std::string& what);

// Returns the bytes of a data URI or of the file that a URI refers to. Data URIs may have any media
// type, and may be encoded as base64 (also with line breaks) or percent-encoded.
std::vector<std::byte> readUri(const Document& document, const std::string& uri, const std::string& what);

// Throws Error with the one-line message "FILE: message".
template <typename... Args>
[[noreturn]] void fault(const Document& document, fmt::format_string<Args...> format, Args&&... args) {
    throw Error(document.file + ": " + shortLine(fmt::format(format, std::forward<Args>(args)...)));
}

// Returns an error's message without the "FILE: " that fault() puts in front.
std::string withoutFile(const Document& document, const std::string& message);

}  // namespace defocus::engine::gltf
