#include "core/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/error.h"

namespace defocus {

namespace fs = std::filesystem;

namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

FileHandle openFile(const fs::path& path, const char* mode) {
    return {std::fopen(path.c_str(), mode), &std::fclose};
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& path) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail("{}: is a directory, not a file", path.string());
    const FileHandle file = openFile(path, "rb");
    if (!file) fail("{}: cannot be read: {}", path.string(), reason(errno));
    std::vector<std::byte> bytes;
    std::byte chunk[1 << 16];
    while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file.get()))
        bytes.insert(bytes.end(), chunk, chunk + count);
    if (std::ferror(file.get()) != 0) fail("{}: cannot be read: {}", path.string(), reason(errno));
    return bytes;
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
    PendingFile pending(path);
    FileHandle file = openFile(pending.temporaryPath(), "wb");
    if (!file) fail("{}: cannot be written: {}", path.string(), reason(errno));
    const bool written = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    if (!written || std::fclose(file.release()) != 0) fail("{}: cannot be written: {}", path.string(), reason(errno));
    pending.commit();
}

void writeFile(const fs::path& path, std::string_view text) {
    writeFile(path, std::as_bytes(std::span(text)));
}

PendingFile::PendingFile(fs::path target) : target_(std::move(target)) {
    static std::atomic<unsigned> counter = 0;
    temporary_ = target_;
    temporary_.replace_filename(
        fmt::format(".{}.{}-{}{}", target_.stem().string(), ::getpid(), counter++, target_.extension().string()));
}

PendingFile::~PendingFile() {
    if (committed_) return;
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void PendingFile::commit() {
    std::error_code status;
    fs::rename(temporary_, target_, status);
    if (status) fail("{}: cannot be written: {}", target_.string(), status.message());
    committed_ = true;
}

void checkWritable(const fs::path& path) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail("{}: is a directory; give a file name", path.string());
    const PendingFile probe(path);
    const int descriptor = ::open(probe.temporaryPath().c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) fail("{}: cannot be written: {}", path.string(), reason(errno));
    ::close(descriptor);
}

}  // namespace defocus
