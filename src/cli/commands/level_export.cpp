#include "cli/commands/level_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"
#include "core/file.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestStem = 80;  // max bytes; leaves room for suffixes, as file systems allow 255 bytes

// Returns `name` as a file name: only ASCII letters, digits and "-_.", without a leading dot.
std::string safeStem(const std::string& name) {
    std::string stem;
    for (const char c : name) {
        const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
        stem += safe && static_cast<unsigned char>(c) < 0x80 ? c : '_';
    }
    stem.resize(std::min(stem.size(), longestStem));
    if (!stem.empty() && stem.front() == '.') stem.front() = '_';
    return stem.empty() ? "mesh" : stem;
}

}  // namespace

std::vector<std::string> fileStems(const Scene& scene) {
    std::vector<std::string> stems;
    std::set<std::string> taken;
    for (const Mesh& mesh : scene.meshes) {
        const auto free = [&](std::string stem) {
            for (char& c : stem) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            return taken.insert(stem).second;
        };
        const std::string plain = safeStem(mesh.name);
        std::string stem = plain;
        for (int number = 2; !free(stem); ++number) stem = fmt::format("{}-{}", plain, number);
        stems.push_back(stem);
    }
    return stems;
}

fs::path levelFile(const fs::path& folder, const std::string& stem, std::size_t level) {
    return folder / fmt::format("{}-level-{:02}.glb", stem, level);
}

void prepareFolder(const fs::path& folder, const fs::path& firstFile) {
    std::error_code status;
    if (fs::exists(folder, status) && !fs::is_directory(folder, status))
        fail("{} is not a folder; give a folder for --export", folder.string());
    fs::create_directories(folder, status);
    if (status) fail("cannot create the folder {}: {}", folder.string(), status.message());
    checkWritable(firstFile);
}

Mesh levelMesh(const Pyramid& pyramid, std::size_t l, const std::string& name) {
    const PyramidLevel& level = pyramid.levels[l];
    Mesh mesh;
    mesh.name = fmt::format("{} level {}", name, l);
    mesh.vertices.positions = level.positions;
    mesh.vertices.normals = level.normals;
    mesh.vertices.colors = level.colors;
    mesh.vertices.uv0 = level.uv0;
    mesh.vertices.uv1 = level.uv1;
    for (const IndexRange& range : level.primitives) {
        const auto first = pyramid.indices.begin() + static_cast<std::ptrdiff_t>(range.first);
        mesh.primitives.push_back({-1, {first, first + static_cast<std::ptrdiff_t>(range.count)}});
    }
    return mesh;
}

}  // namespace defocus::engine
