#pragma once
// Opens a glTF document: provides its buffers, and its JSON as tinygltf structures, from which materials, meshes, nodes
// and animations are read. tinygltf parses only JSON that passed checkSchema, and never reads files, images or binary
// data. Internal to the glTF loader.

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

// Memory limit of a scene, to reject small files that claim billions of vertices, pixels or objects. The limit is 512
// MiB plus 256 times the file size: valid scenes may exceed their file size by sharing, compression and zero-filled
// accessors.
class UnpackBudget {
public:
    // Raises the memory limit by 256 times `fileBytes`, the size of a file. Must be called once per file that is read.
    void grant(std::uint64_t fileBytes);
    [[nodiscard]] std::uint64_t fileBytes() const { return fileBytes_; }  // total size of the files passed to grant()
    // Counts `count` elements of `elementBytes` each as used memory. Returns false, and counts nothing, if the total
    // would exceed the limit.
    [[nodiscard]] bool take(std::uint64_t count, std::uint64_t elementBytes);
    [[nodiscard]] std::uint64_t limit() const { return limit_; }  // current memory limit, bytes
    [[nodiscard]] std::uint64_t taken() const { return taken_; }  // bytes counted by take() so far

private:
    static constexpr std::uint64_t floorBytes = 512ull << 20;
    static constexpr std::uint64_t perFileByte = 256;
    std::uint64_t limit_ = floorBytes;
    std::uint64_t taken_ = 0;
    std::uint64_t fileBytes_ = 0;
};

struct Source {
    Document document;
    tinygltf::Model model;                                             // result of readStructure
    std::vector<std::optional<std::vector<std::byte>>> buffers;        // bytes; nullopt: a fallback buffer without data
    std::vector<std::optional<std::vector<std::byte>>> unpackedViews;  // bytes of views with EXT_meshopt_compression
    UnpackBudget budget;
    std::set<std::filesystem::path> files;  // external files that grantFile has counted
    std::vector<Ignored> ignored;
    std::map<std::pair<std::string, std::string>, std::size_t> ignoredPlaces;  // (what, reason) → index into `ignored`
};

// Reads and checks a file: container, schema, extensions, structure, buffers, compressed buffer views and accessor
// ranges. Throws Error if a check fails. Primitives have the materials of `variant`, unless it is empty.
Source openSource(const std::filesystem::path& path, const std::string& variant, const Progress& progress);

// Returns the bytes of a buffer view. Throws Error if its buffer has no data or is too short.
std::span<const std::byte> viewBytes(const Source& source, int view);

// Reserves memory in the budget for `count` elements of `elementBytes` bytes each. Throws Error, with `what` in its
// message, if the budget is exceeded.
void takeBudget(Source& source, std::uint64_t count, std::uint64_t elementBytes, const std::string& what);

// Calls budget.grant() for the file that `uri` refers to, once per file. If a backslash in the URI was read as a slash,
// says so in Source::ignored. Does nothing for data URIs.
void grantFile(Source& source, const std::string& uri, const std::string& what);

// Adds an entry to Source::ignored, for content that is not drawn. Entries with equal `what` and `reason` are merged,
// and their counts are added.
void ignore(Source& source, const std::string& what, const std::string& reason, std::uint64_t count = 1);
// Same as ignore(), for content that cannot be drawn correctly because the file is damaged.
void ignoreDamaged(Source& source, const std::string& what, const std::string& reason, std::uint64_t count);

// Returns the extension `name` of a JSON object; nullptr if it is absent.
const nlohmann::json* findExtension(const nlohmann::json& object, const char* name);

// Returns the extras of a JSON object; nullptr if they are absent or not an object.
const nlohmann::json* extrasOf(const nlohmann::json& object);

// Returns a label for error messages, such as "mesh 3 'Wheel'".
std::string labelOf(const char* kind, std::size_t index, const std::string& name);

// Converts to float, clamped to the range of finite floats.
float toFloat(double value);

}  // namespace defocus::engine::gltf
