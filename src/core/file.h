#pragma once
// Whole-file reads and writes that never leave half a file: data goes to a temporary name beside the target and is
// renamed over it once complete, so a crash or a full disk destroys nothing.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace defocus {

// The bytes of `path`. Throws Error naming the path and the reason (missing, a directory, unreadable).
std::vector<std::byte> readFile(const std::filesystem::path& path);

// Replaces `path` by `bytes` through a temporary file and rename. Throws Error naming the path and the reason.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

// A temporary name beside `target` with the same extension, for writers (image libraries) that need a path of their
// own. The temporary file is removed on destruction unless `commit()` has renamed it over the target.
class PendingFile {
public:
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporary_; }
    // Renames the temporary file over the target. Throws Error when that fails.
    void commit();

private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

// Throws Error now if a file cannot be created at `path` (no folder, no permission, a directory), so that long work
// doesn't end in a write failure.
void checkWritable(const std::filesystem::path& path);

}  // namespace defocus
