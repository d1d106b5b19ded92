#pragma once
// Whole-file reads and writes that never leave half a file: data goes to a temporary name beside the target, is flushed
// to the disk and renamed over the target once complete, so that a crash, a full disk or a loss of power destroys
// nothing. Of several processes that write the same file, each has a temporary file of its own, and the last to rename
// wins with a whole one. A link stays, and the file that it names is replaced. Devices, pipes and descriptors
// (/dev/stdout) are never replaced: the complete data is copied into them.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace defocus::engine {

// The bytes of `path`: of a file, or of a descriptor of this process (/dev/stdin). Throws Error naming the path and the
// reason (missing, a directory, a device, a pipe, unreadable).
std::vector<std::byte> readFile(const std::filesystem::path& path);

// `relative`, which another file names, as a path to a regular file inside `folder`. Throws Error where it is absolute,
// climbs out of the folder, or is a device, a pipe or a folder; a file that is missing is left to who reads it.
std::filesystem::path fileWithin(const std::filesystem::path& folder, const std::filesystem::path& relative);

// Replaces `path` by `bytes` through a temporary file and rename. Throws Error naming the path and the reason.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

// A new, empty temporary file beside `target` with the same extension, for writers (ffmpeg) that need a path of their
// own. It is removed on destruction unless `commit()` has renamed it over the target.
class PendingFile {
public:
    // Throws Error naming the target when no file can be made there.
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporary_; }
    // Flushes the temporary file to the disk and renames it over the target, or copies it into a device or a pipe.
    // Throws Error when that fails.
    void commit();

private:
    std::filesystem::path target_;
    bool stream_ = false;  // the target can't be replaced
    std::filesystem::path temporary_;
    int descriptor_ = -1;  // locked while the file is pending
    bool committed_ = false;
};

// Removes a temporary file that a killed process left; one that is still being written, by whatever process, stays.
void removeAbandoned(const std::filesystem::path& temporary);

// Throws Error now if a file cannot be created at `path` (no folder, no permission, a directory), so that long work
// doesn't end in a write failure.
void checkWritable(const std::filesystem::path& path);

}  // namespace defocus::engine
