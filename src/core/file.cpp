#include "core/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace defocus::engine {

namespace fs = std::filesystem;

namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

FileHandle openFile(const fs::path& path, const char* mode) {
    return {std::fopen(path.c_str(), mode), &std::fclose};
}

// Locks a new temporary file until it is closed; the lock tells other processes that the writing process is alive.
// Returns false if another process has already removed the file as abandoned. Returns true on file systems without
// locks.
bool isKept(int descriptor) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat status {};
    return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

// Returns the path with symbolic links resolved, so that writing replaces the linked file and keeps the link.
fs::path followed(fs::path path) {
    std::error_code status;
    for (int links = 0; links < 40 && fs::is_symlink(path, status); ++links) {
        const fs::path next = fs::read_symlink(path, status);
        if (status) break;
        path = next.is_absolute() ? next : path.parent_path() / next;
    }
    return path;
}

// Returns whether the path refers to an open descriptor, such as /dev/stdin or /dev/fd/63 from a shell's <(command).
bool isDescriptor(const fs::path& path) {
    const auto liesInProc = [](const fs::path& file) {
        std::error_code status;
        const fs::path folder = fs::canonical(file.has_parent_path() ? file.parent_path() : ".", status);
        return !status && folder.string().starts_with("/proc/");
    };
    std::error_code none;
    return liesInProc(path) || (fs::is_symlink(path, none) && liesInProc(fs::read_symlink(path, none)));
}

// Returns whether the target is a device, pipe or descriptor, which cannot be replaced by a rename.
bool isStream(const fs::path& path) {
    std::error_code status;
    const fs::file_type type = fs::status(path, status).type();
    if (type == fs::file_type::not_found || type == fs::file_type::directory || type == fs::file_type::none)
        return false;
    return type != fs::file_type::regular || isDescriptor(path);
}

std::vector<std::byte> allBytes(std::FILE* file, const fs::path& path) {
    std::vector<std::byte> bytes;
    struct stat status {};
    if (::fstat(::fileno(file), &status) == 0 && S_ISREG(status.st_mode))
        bytes.reserve(static_cast<std::size_t>(status.st_size));
    std::byte chunk[1 << 16];
    while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file))
        bytes.insert(bytes.end(), chunk, chunk + count);
    if (std::ferror(file) != 0) fail("cannot read {}: {}", path.string(), reason(errno));
    return bytes;
}

void writeStream(const fs::path& from, const fs::path& to) {
    const std::vector<std::byte> bytes = readFile(from);
    FileHandle stream = openFile(to, "wb");
    const bool written =
        stream && (bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size());
    if (!written || std::fclose(stream.release()) != 0) fail("cannot write {}: {}", to.string(), reason(errno));
}

// Flushes the directory to disk, so that a rename inside the directory survives a crash. Failures are ignored because
// some file systems do not support fsync on directories.
void syncFolder(const fs::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

// Returns the name of a temporary file for `target`, ".STEM.PROCESS-COUNT.EXTENSION", with the process id and a
// counter.
std::string temporaryName(const fs::path& target, std::string_view number) {
    return fmt::format(".{}.{}{}", target.stem().string(), number, target.extension().string());
}

// Paths of the temporary files that this process is writing.
class PendingNames {
public:
    void add(const fs::path& path) {
        const std::scoped_lock lock(mutex_);
        names_.insert(path);
    }
    void remove(const fs::path& path) {
        const std::scoped_lock lock(mutex_);
        names_.erase(path);
    }
    void removeFiles() {
        const std::scoped_lock lock(mutex_);
        std::error_code ignored;
        for (const fs::path& name : names_) fs::remove(name, ignored);
    }

private:
    std::mutex mutex_;
    std::set<fs::path> names_;
};

PendingNames& pendingNames() {
    static PendingNames names;
    return names;
}

// Removes the temporary files of `target` that killed processes left behind.
void removeAbandonedOf(const fs::path& target) {
    const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
    const std::size_t begin = target.stem().string().size() + 2;  // start of the process id in a temporary file's name
    std::error_code fault;
    for (auto entry = fs::directory_iterator(folder, fault); !fault && entry != fs::directory_iterator();
         entry.increment(fault)) {
        const std::string name = entry->path().filename().string();
        const std::size_t end = std::min(name.find_first_not_of("0123456789-", begin), name.size());
        if (end > begin && name == temporaryName(target, name.substr(begin, end - begin)))
            removeAbandoned(entry->path());
    }
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& path) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail("{} is a folder, not a file", path.string());
    // Reading a device may never end, and opening a pipe may block forever.
    if (fs::exists(path, status) && !fs::is_regular_file(path, status) && !isDescriptor(path))
        fail("{} is a device or a pipe, not a file", path.string());
    const FileHandle file = openFile(path, "rb");
    if (!file) fail("cannot read {}: {}", path.string(), reason(errno));
    return allBytes(file.get(), path);
}

std::string readText(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<std::vector<std::byte>> readOwnFile(const fs::path& path) {
    // O_NONBLOCK: otherwise, opening a pipe would wait for its writer. The file type is read from the open descriptor,
    // so that no other process can replace the file between the check and the read.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    const FileHandle file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb"), &std::fclose);
    if (!file) {
        const bool absent = errno == ENOENT || errno == ENOTDIR || errno == ELOOP || errno == ENXIO;
        if (absent) return {};
        fail("cannot read {}: {}", path.string(), reason(errno));
    }
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return allBytes(file.get(), path);
}

void createOwnFolder(const fs::path& folder) {
    std::error_code status;
    if (fs::is_directory(folder, status)) return;
    fs::path full = fs::absolute(folder).lexically_normal();
    if (!full.has_filename()) full = full.parent_path();  // "folder/" has an empty file name
    fs::create_directories(full.parent_path(), status);
    if (status) fail("cannot create {}: {}", folder.string(), status.message());
    if (::mkdir(full.c_str(), 0700) != 0 && !fs::is_directory(full, status))
        fail("cannot create {}: {}", folder.string(), reason(errno));
}

fs::path fileWithin(const fs::path& folder, const fs::path& relative) {
    const fs::path normal = relative.lexically_normal();
    if (relative.empty() || relative.is_absolute() || *normal.begin() == "..")
        fail(
            "'{}' is outside the folder of the file that refers to it; move it into this folder and use a relative "
            "path",
            relative.string());
    fs::path path = folder / relative;
    std::error_code status;
    if (fs::exists(path, status) && !fs::is_regular_file(path, status))
        fail("{} is a device, a pipe or a folder, not a file", path.string());
    return path;
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes, NamedBy namer) {
    PendingFile pending(path, namer);
    pending.write(bytes);
    pending.commit();
}

void writeFile(const fs::path& path, std::string_view text, NamedBy namer) {
    writeFile(path, std::as_bytes(std::span(text)), namer);
}

PendingFile::PendingFile(fs::path target, NamedBy namer)
    : target_(std::move(target)), stream_(namer == NamedBy::user && isStream(target_)) {
    static std::atomic<unsigned> counter = 0;
    if (namer == NamedBy::user && !stream_) target_ = followed(target_);
    if (!stream_) removeAbandonedOf(target_);
    while (descriptor_ < 0) {
        temporary_ = stream_ ? fs::temp_directory_path() / target_.filename() : target_;
        temporary_.replace_filename(temporaryName(target_, fmt::format("{}-{}", ::getpid(), counter++)));
        // O_EXCL fails if the file exists: a process with the same id on another machine may have created it.
        descriptor_ = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) fail("cannot write {}: {}", target_.string(), reason(errno));
        if (descriptor_ >= 0 && !isKept(descriptor_)) ::close(std::exchange(descriptor_, -1));
    }
    pendingNames().add(temporary_);
}

PendingFile::~PendingFile() {
    std::error_code ignored;
    if (!committed_) fs::remove(temporary_, ignored);
    pendingNames().remove(temporary_);
    ::close(descriptor_);
}

void PendingFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) fail("cannot write {}: {}", target_.string(), reason(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

void PendingFile::commit() {
    if (stream_) return writeStream(temporary_, target_);
    // Some file systems report a full disk only at fsync.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
        fail("cannot write {}: {}", target_.string(), reason(errno));
    std::error_code status;
    fs::rename(temporary_, target_, status);
    if (status) fail("cannot write {}: {}", target_.string(), status.message());
    committed_ = true;
    syncFolder(target_.parent_path());
}

void removePendingFiles() {
    pendingNames().removeFiles();
}

void removeAbandoned(const fs::path& temporary) {
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return;
    std::error_code ignored;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove(temporary, ignored);
    ::close(descriptor);
}

void checkWritable(const fs::path& path) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail("{} is a folder; give a file name", path.string());
    const PendingFile probe(path);
}

}  // namespace defocus::engine
