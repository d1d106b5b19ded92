#include "core/mapped_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "core/file.h"
#include "image/scratch_folder.h"

namespace defocus {
namespace {

std::string textOf(const MappedFile& file) {
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

TEST(MappedFile, showsTheBytesOfTheFile) {
    const ScratchFolder folder;
    const std::string text(10'001, 'x');
    writeFile(folder / "a ünï.bin", std::string_view(text));
    const auto file = MappedFile::open(folder / "a ünï.bin");
    ASSERT_TRUE(file);
    EXPECT_EQ(textOf(*file), text);
}

TEST(MappedFile, bytesOutliveTheFileAndAMove) {
    const ScratchFolder folder;
    writeFile(folder / "a", std::string_view("first"));
    writeFile(folder / "b", std::string_view("other"));
    auto file = MappedFile::open(folder / "a");
    auto other = MappedFile::open(folder / "b");
    ASSERT_TRUE(file && other);
    writeFile(folder / "a", std::string_view("second"));  // a rename over it
    std::filesystem::remove(folder / "b");
    MappedFile moved = std::move(*file);
    EXPECT_EQ(textOf(moved), "first");
    moved = std::move(*other);
    EXPECT_EQ(textOf(moved), "other");
}

TEST(MappedFile, whatIsNoReadableFileIsAMiss) {
    const ScratchFolder folder;
    writeFile(folder / "empty", std::string_view(""));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(MappedFile::open(folder / "missing"));
    EXPECT_FALSE(MappedFile::open(folder / "empty"));
    EXPECT_FALSE(MappedFile::open(folder / "pipe"));
    EXPECT_FALSE(MappedFile::open(folder.path()));
    EXPECT_FALSE(MappedFile::open("/dev/null"));
}

}  // namespace
}  // namespace defocus
