#include "lod/pyramid/cache.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <new>
#include <span>
#include <string_view>
#include <system_error>
#include <tuple>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/stopwatch.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/file.h"

namespace defocus::engine {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view extension = ".pyramid";
constexpr std::size_t keyDigits = 16;

// Returns a file name that is a hash of the complete key. Different program versions and options therefore never
// overwrite each other's files.
fs::path fileName(const PyramidKey& key) {
    const std::uint64_t rest[4] = {PyramidFileHeader::expectedVersion, key.options.minTriangles,
                                   static_cast<std::uint64_t>(key.options.maxLevels),
                                   static_cast<std::uint64_t>(key.options.vertices)};
    return fmt::format("{:0{}x}{}", hashBytes(std::as_bytes(std::span(rest)), key.mesh), keyDigits, extension);
}

enum class NameKind { other, complete, pending };

bool consistsOf(std::string_view text, const char* letters) {
    return !text.empty() && text.find_first_not_of(letters) == std::string_view::npos;
}

// Returns the kind of file that the name belongs to: a complete cache file, a pending cache file, or another file.
// Complete files are named "KEY.pyramid". While a file is being written, PendingFile names it
// ".KEY.PROCESS-NUMBER.pyramid".
NameKind kindOf(std::string_view name) {
    const bool pending = name.starts_with('.');
    if (pending) name.remove_prefix(1);
    if (!name.ends_with(extension) || !consistsOf(name.substr(0, keyDigits), "0123456789abcdef"))
        return NameKind::other;
    name.remove_suffix(extension.size());
    if (!pending) return name.size() == keyDigits ? NameKind::complete : NameKind::other;

    if (name.size() <= keyDigits || name[keyDigits] != '.') return NameKind::other;
    const std::string_view writer = name.substr(keyDigits + 1);
    const std::size_t dash = writer.find('-');
    const bool numbers = dash != std::string_view::npos && consistsOf(writer.substr(0, dash), "0123456789") &&
                         consistsOf(writer.substr(dash + 1), "0123456789");
    return numbers ? NameKind::pending : NameKind::other;
}

std::optional<CacheFile> cacheFile(const fs::directory_entry& entry) {
    const NameKind kind = kindOf(entry.path().filename().string());
    std::error_code status;
    if (kind == NameKind::other || !fs::is_regular_file(entry.symlink_status(status))) return {};
    std::array<std::byte, sizeof(PyramidFileHeader)> beginning;
    std::ifstream file(entry.path(), std::ios::binary);
    file.read(reinterpret_cast<char*>(beginning.data()), beginning.size());
    const auto header = pyramidHeader(std::span(beginning).first(static_cast<std::size_t>(file.gcount())));
    if (!header) return {};
    const std::uintmax_t size = entry.file_size(status);
    const fs::file_time_type written = entry.last_write_time(status);
    return CacheFile{entry.path(), size, written, header->triangleCount, kind == NameKind::pending};
}

std::optional<Pyramid> load(const Mesh& mesh, const fs::path& folder, const PyramidKey& key) {
    try {
        const std::optional<std::vector<std::byte>> bytes = readOwnFile(folder / fileName(key));
        return bytes ? decodePyramid(*bytes, mesh, key) : std::nullopt;
    } catch (const Error&) {
        return {};  // an unreadable file is a cache miss, not an error
    }
}

void store(const Pyramid& pyramid, const Mesh& mesh, const fs::path& folder, const PyramidKey& key) {
    createOwnFolder(folder);
    writeFile(folder / fileName(key), encodePyramid(pyramid, mesh, key), NamedBy::program);
}

// Stores the pyramid in the cache folder. Returns the reason for a failure; empty on success.
std::string tryToStore(const Pyramid& pyramid, const Mesh& mesh, const fs::path& folder, const PyramidKey& key) {
    try {
        store(pyramid, mesh, folder, key);
        return {};
    } catch (const Error& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return "out of memory";
    }
}

fs::path absolutePathIn(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : fs::path();
}

}  // namespace

fs::path defaultCacheFolder() {
    if (const fs::path caches = absolutePathIn("XDG_CACHE_HOME"); !caches.empty()) return caches / "defocus";
    const fs::path home = absolutePathIn("HOME");
    return home.empty() ? fs::path() : home / ".cache" / "defocus";
}

std::optional<Pyramid> loadPyramid(const Mesh& mesh, const fs::path& folder, const PyramidOptions& options) {
    return load(mesh, folder, pyramidKey(mesh, options));
}

void storePyramid(const Pyramid& pyramid, const Mesh& mesh, const fs::path& folder, const PyramidOptions& options) {
    store(pyramid, mesh, folder, pyramidKey(mesh, options));
}

CachedPyramids cachedPyramids(const std::vector<Mesh>& meshes, const fs::path& folder, const PyramidOptions& options,
                              const Progress& progress) {
    CachedPyramids result;
    result.seconds.resize(meshes.size());
    std::mutex mutex;  // protects `loaded` and `failure` of `result`
    const auto stillStoring = [&] {
        const std::scoped_lock lock(mutex);
        return result.failure.empty();
    };
    result.pyramids = obtainPyramids(meshes, options, progress, [&](std::size_t i, const auto& build) {
        const Mesh& mesh = meshes[i];
        const bool cached = !folder.empty() && mesh.triangleCount() > options.minTriangles;
        const PyramidKey key = cached ? pyramidKey(mesh, options) : PyramidKey{};
        if (cached)
            if (std::optional<Pyramid> loaded = load(mesh, folder, key)) {
                const std::scoped_lock lock(mutex);
                ++result.loaded;
                return std::move(*loaded);
            }
        const Clock::time_point begin = Clock::now();
        Pyramid pyramid = build();
        result.seconds[i] = millisecondsSince(begin) / 1000;
        const std::string failure = cached && stillStoring() ? tryToStore(pyramid, mesh, folder, key) : std::string();
        const std::scoped_lock lock(mutex);
        if (result.failure.empty()) result.failure = failure;
        return pyramid;
    });
    return result;
}

std::vector<CacheFile> cacheFiles(const fs::path& folder) {
    std::vector<CacheFile> files;
    std::error_code status;
    if (!fs::exists(folder, status) && !status) return files;
    for (fs::directory_iterator entries(folder, status), end; !status && entries != end; entries.increment(status))
        if (std::optional<CacheFile> file = cacheFile(*entries)) files.push_back(std::move(*file));
    if (status) fail("cannot read {}: {}", folder.string(), status.message());
    std::sort(files.begin(), files.end(), [](const CacheFile& a, const CacheFile& b) {
        return std::tie(b.written, a.path) < std::tie(a.written, b.path);
    });
    return files;
}

std::vector<CacheFile> clearCache(const fs::path& folder) {
    std::vector<CacheFile> files = cacheFiles(folder);
    for (const CacheFile& file : files) {
        std::error_code status;
        fs::remove(file.path, status);
        if (status) fail("cannot remove {}: {}", file.path.string(), status.message());
    }
    return files;
}

}  // namespace defocus::engine
