#pragma once
// glTF file split into its parts without interpreting them: JSON, binary chunk of a .glb, and access to external files.
// Internal to the loader.

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
    std::string file;                                   // path as given by the user, for messages
    std::filesystem::path folder;                       // base folder of relative URIs
    nlohmann::json json;                                // always a JSON object
    std::optional<std::vector<std::byte>> binaryChunk;  // only for .glb files
    std::uint64_t fileBytes = 0;
};

// Reads the file at `path`. Throws Error for an invalid container or JSON: length, magic number, version, byte order
// mark or nesting.
Document readDocument(const std::filesystem::path& path);

// Returns the number of entries in the JSON's array `name`.
std::size_t entryCount(const Document& document, std::string_view name);

// Returns whether the URI embeds its data ("data:").
bool isDataUri(const std::string& uri);

// Returns the regular file that a URI refers to, relative to the document; nullopt for data URIs. Throws Error if the
// file is missing. `what` names the URI's owner in messages.
std::optional<std::filesystem::path> uriFile(const Document& document, const std::string& uri, const std::string& what);

// Returns the bytes of a data URI or file. Data URIs may have any media type, in base64 (also with line breaks) or
// percent-encoding.
std::vector<std::byte> readUri(const Document& document, const std::string& uri, const std::string& what);

// Throws Error "FILE: message" as one line.
template <typename... Args>
[[noreturn]] void fault(const Document& document, fmt::format_string<Args...> format, Args&&... args) {
    throw Error(document.file + ": " + shortLine(fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace defocus::engine::gltf
