#pragma once
// Document with its buffers and its JSON as tinygltf structures; input of all readers of the loader. tinygltf parses
// only JSON that passed checkSchema, and never reads files, images or binary data. Internal to the loader.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "scene/gltf/document.h"
#include "scene/gltf/tinygltf.h"
#include "scene/scene.h"

namespace defocus::engine::gltf {

// Memory that the scene may still take. It rejects small files that claim billions of vertices, pixels or objects. The
// limit leaves room for real scenes, which exceed their file's size through sharing, compression and zero-filled
// accessors.
class UnpackBudget {
public:
    // Raises the limit for a file that is read. Call it once per file.
    void grant(std::uint64_t fileBytes);
    [[nodiscard]] std::uint64_t fileBytes() const { return fileBytes_; }  // total of all granted files
    // Takes `count` elements of `elementBytes` each. Returns false if they exceed the limit.
    [[nodiscard]] bool take(std::uint64_t count, std::uint64_t elementBytes);

private:
    static constexpr std::uint64_t floorBytes = 512ull << 20;
    static constexpr std::uint64_t perFileByte = 256;
    std::uint64_t left_ = floorBytes;
    std::uint64_t fileBytes_ = 0;
};

struct Source {
    Document document;
    tinygltf::Model model;                                             // JSON parsed by readStructure
    std::vector<std::optional<std::vector<std::byte>>> buffers;        // empty entry: fallback buffer without data
    std::vector<std::optional<std::vector<std::byte>>> unpackedViews;  // per buffer view; EXT_meshopt_compression
    UnpackBudget budget;
    std::set<std::filesystem::path> files;  // external files already granted to the budget
    std::vector<Ignored> ignored;
    std::map<std::pair<std::string, std::string>, std::size_t> ignoredPlaces;  // (what, reason) → index into `ignored`
};

// Reads and checks a file: container, schema, extensions, structure, buffers, compressed views and accessor ranges.
// Throws Error if any step fails.
Source openSource(const std::filesystem::path& path, const Progress& progress);

// Returns the bytes of a buffer view. Throws Error if it has no data or exceeds its buffer.
std::span<const std::byte> viewBytes(const Source& source, int view);

// Takes `count` elements of `elementBytes` from the budget. Throws Error that names `what` if they exceed it.
void takeBudget(Source& source, std::uint64_t count, std::uint64_t elementBytes, const std::string& what);

// Raises the budget by the size of the URI's file. Data URIs and repeated files have no effect.
void grantFile(Source& source, const std::string& uri, const std::string& what);

// Notes content that is not drawn; equal notes share one entry.
void ignore(Source& source, const std::string& what, const std::string& reason, std::uint64_t count = 1);
// Same for content that cannot be drawn correctly because the file is damaged.
void ignoreDamaged(Source& source, const std::string& what, const std::string& reason, std::uint64_t count);

// Returns the extension `name` of a JSON object, or nullptr.
const nlohmann::json* findExtension(const nlohmann::json& object, const char* name);

// Returns a label for messages, such as "mesh 3 'Wheel'".
std::string labelOf(const char* kind, std::size_t index, const std::string& name);

// Converts to float and clamps to its finite range.
float toFloat(double value);

}  // namespace defocus::engine::gltf
