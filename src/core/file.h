#pragma once
// Atomic reads and writes of complete files. Data goes to a temporary file beside the target, is flushed to disk, and
// is renamed over the target. A crash, a full disk or a power failure therefore never damages an existing file.
// Concurrent writers use separate temporary files; the last rename wins. Symbolic links stay, and the linked file is
// replaced. Devices, pipes and descriptors (/dev/stdout) receive a copy of the complete data instead.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace defocus::engine {

// Returns the bytes of a file or of an open descriptor (/dev/stdin). Throws Error with the path and the reason:
// missing, a directory, a device, a pipe, or unreadable.
std::vector<std::byte> readFile(const std::filesystem::path& path);

// Resolves `relative`, a path read from another file, inside `folder`. Throws Error if the path is absolute, leaves the
// folder, or is a device, pipe or directory. A missing file is not an error here.
std::filesystem::path fileWithin(const std::filesystem::path& folder, const std::filesystem::path& relative);

// Replaces the file at `path` atomically. Throws Error with the path and the reason.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

// New empty temporary file beside `target` with the same extension, for writers that need a path, such as ffmpeg. The
// destructor removes it unless `commit()` has renamed it over the target.
class PendingFile {
public:
    // Throws Error that names the target if no file can be created there.
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporary_; }
    // Flushes the temporary file to disk and renames it over the target, or copies it into a device or pipe. Throws
    // Error if that fails.
    void commit();

private:
    std::filesystem::path target_;
    bool stream_ = false;  // target is a device, pipe or descriptor
    std::filesystem::path temporary_;
    int descriptor_ = -1;  // locked while the file is pending
    bool committed_ = false;
};

// Removes a temporary file that a killed process left behind. A file that any process is still writing stays.
void removeAbandoned(const std::filesystem::path& temporary);

// Throws Error if no file can be created at `path`, so that a long job fails at its start instead of its end.
void checkWritable(const std::filesystem::path& path);

}  // namespace defocus::engine
