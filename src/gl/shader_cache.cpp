#include "gl/shader_cache.h"

#include <fmt/format.h>
#include <sys/statvfs.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <mutex>

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// Required free disk space in bytes: about three times the size of the cache's index and one frame's shaders.
constexpr std::uint64_t room = std::uint64_t{16} << 20;

fs::path pathIn(const char* variable) {
    const char* const value = std::getenv(variable);
    return value == nullptr ? fs::path() : fs::path(value);
}

// Returns the folder of Mesa's shader cache, chosen as Mesa does (src/util/disk_cache_os.c); empty if there is none.
fs::path cacheFolder() {
    for (const char* variable : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"})
        if (const fs::path folder = pathIn(variable); !folder.empty()) return folder / "mesa_shader_cache";
    const fs::path home = pathIn("HOME");
    return home.empty() ? home : home / ".cache" / "mesa_shader_cache";
}

// Returns `folder` if it exists, else its nearest existing ancestor.
fs::path existing(fs::path folder) {
    std::error_code fault;
    while (!fs::exists(folder, fault) && folder.has_parent_path() && folder != folder.parent_path())
        folder = folder.parent_path();
    return folder;
}

std::string protectedFolder() {
    const fs::path folder = cacheFolder();
    if (folder.empty() || std::getenv("MESA_SHADER_CACHE_DISABLE") != nullptr) return {};
    struct statvfs system {};
    if (::statvfs(existing(folder).c_str(), &system) != 0) return {};
    if (std::uint64_t{system.f_bavail} * system.f_frsize >= room) return {};
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    return folder.string();
}

// Folder of the shader cache if the cache is disabled for lack of disk space, else empty.
std::string& folderWithoutRoom() {
    static std::string folder;
    return folder;
}

}  // namespace

void protectShaderCache() {
    static std::once_flag once;
    std::call_once(once, [] { folderWithoutRoom() = protectedFolder(); });
}

std::string shaderCacheWarning() {
    if (folderWithoutRoom().empty()) return {};
    return fmt::format(
        "the disk that holds {} is almost full, so the driver's shader cache is off for this run and shaders are "
        "recompiled; free disk space",
        folderWithoutRoom());
}

}  // namespace defocus::engine
