#pragma once
// A file's bytes in memory without reading them first: pages come in as they are used.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

namespace defocus {

// Owns the mapping. The bytes stay as they are when the file is renamed over or removed; nobody may shorten it in
// place meanwhile (defocus never does: see PendingFile).
class MappedFile {
public:
    // Nothing where `path` is no regular file, is empty or cannot be read: a miss, not a fault.
    static std::optional<MappedFile> open(const std::filesystem::path& path);

    ~MappedFile();
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::span<const std::byte> bytes_;
};

}  // namespace defocus
