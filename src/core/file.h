#pragma once
// Reads and atomically writes complete files. Data goes to a temporary file beside the target; this file is flushed to
// disk and renamed over the target. A crash, a full disk or a power failure therefore never damages an existing file.
// Concurrent writers use separate temporary files; the last rename wins. A symbolic link at a path that the user gives
// is followed: the linked file is replaced, and the link stays. Devices, pipes and descriptors (/dev/stdout) receive a
// copy of the complete data instead. A link, device or pipe at a path that the program chose is replaced instead: see
// NamedBy.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

// Returns the bytes of a file, or of an open descriptor (/dev/stdin), even if that is a pipe. Throws Error, with the
// path in its message, if the file is missing, unreadable, a directory, or another device or pipe.
std::vector<std::byte> readFile(const std::filesystem::path& path);
// Same as readFile, but returns the bytes as text.
std::string readText(const std::filesystem::path& path);

// Returns the bytes of a file at a path that the program chose, such as a cache entry. Returns nullopt if the file is
// missing or isn't a regular file: links are not followed, and a pipe does not block. Throws Error if the file is
// unreadable.
std::optional<std::vector<std::byte>> readOwnFile(const std::filesystem::path& path);

// Creates a folder at a path that the program chose; only the user may enter it (mode 0700). Missing parents get the
// default mode. Does nothing if the folder, or a link to a folder, exists. Throws Error on failure.
void createOwnFolder(const std::filesystem::path& folder);

// Returns the path of `relative` inside `folder`, for a path that comes from another file. Throws Error if `relative`
// is absolute, leaves the folder, or is a device, pipe or directory. A missing file is not an error.
std::filesystem::path fileWithin(const std::filesystem::path& folder, const std::filesystem::path& relative);

// Says who chose a file's path: the user or the program. The program never creates links, pipes or devices. A link,
// pipe or device at a path that the program chose is therefore replaced by the file and never written through.
enum class NamedBy { user, program };

// Creates or atomically replaces the file at `path`. Throws Error, with the path in its message, if writing fails.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes, NamedBy namer = NamedBy::user);
void writeFile(const std::filesystem::path& path, std::string_view text, NamedBy namer = NamedBy::user);

// New empty temporary file beside `target` with the same extension, for writers that need a path, such as ffmpeg. The
// destructor removes the temporary file unless `commit()` has renamed it over the target. The constructor first removes
// temporary files for the same target that killed processes left behind.
class PendingFile {
public:
    // Throws Error, with the target's path in its message, if the temporary file cannot be created.
    explicit PendingFile(std::filesystem::path target, NamedBy namer = NamedBy::user);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporary_; }
    // Appends to the temporary file. Throws Error on failure.
    void write(std::span<const std::byte> bytes);
    // Flushes the temporary file to disk and renames it over the target. Copies the data instead if the target is a
    // device or pipe. Throws Error on failure.
    void commit();

private:
    std::filesystem::path target_;
    bool stream_ = false;  // true: the target is a device, pipe or descriptor
    std::filesystem::path temporary_;
    int descriptor_ = -1;  // open until destruction, so that the temporary file stays locked
    bool committed_ = false;
};

// Removes the temporary files of all PendingFile objects of this process, for exits that run no destructors.
void removePendingFiles();

// Removes a temporary file that a killed process left behind. Does nothing while a process is still writing the file.
void removeAbandoned(const std::filesystem::path& temporary);

// Throws Error if no file can be created at `path`, so that a long job fails at its start instead of its end.
void checkWritable(const std::filesystem::path& path);

}  // namespace defocus::engine
