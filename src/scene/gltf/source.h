#pragma once
// A document with its buffers read and its JSON as tinygltf's structures: what all readers of the loader work on.
// tinygltf only sees JSON that passed checkSchema, and never touches files, images or binary data. Internal to the
// loader.

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

// How much memory may still be taken for the scene, so that a few bytes that claim billions of vertices, pixels or
// objects are refused instead of filling it. Sharing, compression and zero-filled accessors make real scenes larger
// than their files, but not this much.
class UnpackBudget {
public:
    // A file that is read, once each, allows more.
    void grant(std::uint64_t fileBytes);
    [[nodiscard]] std::uint64_t fileBytes() const { return fileBytes_; }  // of all that were granted
    // False when the file may not take another `count` elements of `elementBytes`.
    [[nodiscard]] bool take(std::uint64_t count, std::uint64_t elementBytes);

private:
    static constexpr std::uint64_t floorBytes = 512ull << 20;
    static constexpr std::uint64_t perFileByte = 256;
    std::uint64_t left_ = floorBytes;
    std::uint64_t fileBytes_ = 0;
};

struct Source {
    Document document;
    tinygltf::Model model;                                             // as readStructure gives it
    std::vector<std::optional<std::vector<std::byte>>> buffers;        // empty: has no data of its own (fallbacks)
    std::vector<std::optional<std::vector<std::byte>>> unpackedViews;  // by buffer view: EXT_meshopt_compression
    UnpackBudget budget;
    std::set<std::filesystem::path> files;  // those beside the document that the budget was granted for
    std::vector<Ignored> ignored;
    std::map<std::pair<std::string, std::string>, std::size_t> ignoredPlaces;  // what and reason → into `ignored`
};

// Steps 1 to 4 of loading: container, schema, extensions, structure, buffers (compressed views unpacked), accessors in
// range.
Source openSource(const std::filesystem::path& path, const Progress& progress);

// The bytes of a buffer view. Throws Error when it has none or leaves its buffer.
std::span<const std::byte> viewBytes(const Source& source, int view);

// Takes `count` elements of `elementBytes` from the budget, or throws Error naming `what`.
void takeBudget(Source& source, std::uint64_t count, std::uint64_t elementBytes, const std::string& what);

// Lets the file behind a URI count for the budget, if it is one.
void grantFile(Source& source, const std::string& uri, const std::string& what);

// Notes something that is not drawn; equal things are counted in one entry.
void ignore(Source& source, const std::string& what, const std::string& reason, std::uint64_t count = 1);
// The same of what can't be drawn as it is because the file is damaged there.
void ignoreDamaged(Source& source, const std::string& what, const std::string& reason, std::uint64_t count);

// The object `name` among the "extensions" of a JSON object, or nullptr.
const nlohmann::json* findExtension(const nlohmann::json& object, const char* name);

// "mesh 3 'Wheel'" for messages.
std::string labelOf(const char* kind, std::size_t index, const std::string& name);

// A double from the file as a finite float.
float toFloat(double value);

}  // namespace defocus::engine::gltf
