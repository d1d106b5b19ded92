#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <string>
#include <thread>

#include "core/bounds.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/parallel.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "defocus-core-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(Files, writtenBytesAreReadBack) {
    const fs::path path = folder_ / "ünï code.bin";
    writeFile(path, std::string_view("first"));
    writeFile(path, std::string_view("second, longer"));
    const std::vector<std::byte> bytes = readFile(path);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), "second, longer");
}

TEST_F(Files, uncommittedFileLeavesTheTargetAndNothingElse) {
    const fs::path path = folder_ / "kept.txt";
    writeFile(path, std::string_view("good"));
    {
        const PendingFile pending(path);
        writeFile(pending.temporaryPath(), std::string_view("half"));
    }
    EXPECT_EQ(readFile(path).size(), 4u);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

// Temporary files of running processes are kept, and those of killed processes are removed.
TEST_F(Files, onlyAbandonedTemporaryFilesAreRemoved) {
    const fs::path path = folder_ / "frame.exr";
    fs::path left;
    {
        PendingFile pending(path);
        removeAbandoned(pending.temporaryPath());
        EXPECT_TRUE(fs::exists(pending.temporaryPath()));
        const PendingFile other(path);
        EXPECT_NE(other.temporaryPath(), pending.temporaryPath());
        pending.commit();
        EXPECT_TRUE(fs::exists(path));
        EXPECT_TRUE(fs::exists(other.temporaryPath()));
    }
    const pid_t child = ::fork();
    if (child == 0) {
        const PendingFile killed(path);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
        if (entry.path() != path) left = entry.path();
    EXPECT_EQ(left.filename().string().substr(0, 7), ".frame.");
    writeFile(folder_ / "frame.png", std::string_view("another target"));
    EXPECT_TRUE(fs::exists(left));
    writeFile(path, std::string_view("next"));
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(path));
    removeAbandoned(folder_ / "missing");
}

std::string textOf(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Files, aLinkStaysAndWhatItNamesIsReplaced) {
    fs::create_directory(folder_ / "far");
    for (const char* name : {"there.txt", "not yet.txt"}) {
        const fs::path link = folder_ / fmt::format("link to {}", name);
        fs::create_symlink(fs::path("far") / name, link);
        if (std::string(name) == "there.txt") writeFile(folder_ / "far" / name, std::string_view("before"));
        writeFile(link, std::string_view("after"));
        EXPECT_TRUE(fs::is_symlink(link));
        EXPECT_EQ(textOf(folder_ / "far" / name), "after");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "far"), fs::directory_iterator()), 2) << "nothing is left";
}

// If a link or a pipe has the file name that the program itself chooses, the program replaces the link or the pipe and
// never writes through it.
TEST_F(Files, ownFilesReplaceLinksAndPipes) {
    fs::create_directory(folder_ / "far");
    const fs::path victim = folder_ / "far" / "victim.txt";
    writeFile(victim, std::string_view("before"));
    fs::create_symlink(victim, folder_ / "link.txt");
    fs::create_symlink(folder_ / "far" / "new.txt", folder_ / "dangling.txt");
    ASSERT_EQ(::mkfifo((folder_ / "pipe.txt").c_str(), 0600), 0);
    for (const char* name : {"link.txt", "dangling.txt", "pipe.txt", "missing.txt"}) {
        const fs::path own = folder_ / name;
        EXPECT_EQ(readOwnFile(own), std::nullopt) << name;
        writeFile(own, std::string_view("after"), NamedBy::program);
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(own))) << name;
        ASSERT_TRUE(readOwnFile(own)) << name;
        EXPECT_EQ(textOf(own), "after");
    }
    EXPECT_EQ(textOf(victim), "before");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "far"), fs::directory_iterator()), 1);
}

TEST_F(Files, ownFoldersAreForTheUserOnlyAndMayBeLinks) {
    createOwnFolder(folder_ / "parent" / "own/");
    EXPECT_EQ(fs::status(folder_ / "parent" / "own").permissions(), fs::perms::owner_all);
    EXPECT_NE(fs::status(folder_ / "parent").permissions(), fs::perms::owner_all);
    fs::create_directory_symlink("parent", folder_ / "link");
    createOwnFolder(folder_ / "link");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    writeFile(folder_ / "file", std::string_view("not a folder"));
    EXPECT_NE(messageOf([&] { createOwnFolder(folder_ / "file" / "own"); }), "");
}

TEST_F(Files, aPipeGetsAllBytesAndStaysAPipe) {
    const fs::path pipe = folder_ / "pipe.json";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const std::string sent(100'000, 'x');
    std::string received;
    std::thread reader([&] {
        std::ifstream stream(pipe, std::ios::binary);
        received.assign(std::istreambuf_iterator<char>(stream), {});
    });
    writeFile(pipe, std::string_view(sent));
    reader.join();
    EXPECT_EQ(received, sent);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

// Writing to the path of a device writes to the device. A rename would replace the device, for the whole system if the
// program runs as root.
TEST_F(Files, aDeviceStaysADevice) {
    if (!fs::is_character_file("/dev/null")) GTEST_SKIP() << "no /dev/null";
    writeFile("/dev/null", std::string_view("gone"));
    fs::create_symlink("/dev/null", folder_ / "link");
    writeFile(folder_ / "link", std::string_view("gone too"));
    ASSERT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    if (!fs::is_character_file("/dev/full")) return;
    EXPECT_NE(messageOf([] { writeFile("/dev/full", std::string_view("lost")); }).find("No space"), std::string::npos);
}

// Writing to a path such as /proc/self/fd/3 writes to the open file descriptor; the file behind it is not replaced.
TEST_F(Files, aDescriptorIsWrittenWhereItLeads) {
    const int descriptor = ::open((folder_ / "kept.txt").c_str(), O_CREAT | O_RDWR, 0600);
    ASSERT_GE(descriptor, 0);
    const fs::path path = fmt::format("/proc/self/fd/{}", descriptor);
    if (!fs::exists(path)) GTEST_SKIP() << "no /proc";
    writeFile(path, std::string_view("words"));
    char words[6] = {};
    EXPECT_EQ(::pread(descriptor, words, 5, 0), 5);
    EXPECT_STREQ(words, "words");
    ::close(descriptor);
}

// Temporary files of another process are never overwritten, even if that process has the same id on another machine
// that shares the folder.
TEST_F(Files, temporaryNamesThatAreTakenAreLeftAlone) {
    const fs::path path = folder_ / "frame.exr";
    const auto numberOf = [&](const fs::path& temporary) {
        const std::string name = temporary.stem().string();
        return std::stoul(name.substr(name.rfind('-') + 1));
    };
    const auto number = numberOf(PendingFile(path).temporaryPath());
    const auto nameOf = [&](unsigned long each) {
        return folder_ / (".frame." + std::to_string(::getpid()) + "-" + std::to_string(each) + ".exr");
    };
    std::vector<int> locked;
    for (const unsigned long taken : {number + 1, number + 2}) {
        std::ofstream(nameOf(taken)) << "theirs";
        locked.push_back(::open(nameOf(taken).c_str(), O_RDONLY | O_CLOEXEC));
        ASSERT_EQ(::flock(locked.back(), LOCK_EX), 0);
    }
    writeFile(path, std::string_view("ours"));
    EXPECT_EQ(readFile(path).size(), 4u);
    for (const unsigned long taken : {number + 1, number + 2}) EXPECT_EQ(readFile(nameOf(taken)).size(), 6u);
    for (const int each : locked) ::close(each);
}

TEST_F(Files, errorsNameThePathAndTheReason) {
    EXPECT_NE(messageOf([&] { readFile(folder_); }).find("is a folder"), std::string::npos);
    const std::string missing = messageOf([&] { readFile(folder_ / "missing"); });
    EXPECT_NE(missing.find("missing"), std::string::npos);
    EXPECT_NE(missing.find("No such file"), std::string::npos);
    EXPECT_NE(messageOf([&] { checkWritable(folder_ / "no" / "folder.png"); }).find("cannot write "),
              std::string::npos);
    EXPECT_EQ(messageOf([&] { checkWritable(folder_ / "fine.png"); }), "");
    EXPECT_TRUE(fs::is_empty(folder_));
}

// Devices and pipes are not read, because reading them may block or never end. File descriptors that the shell passes
// are read.
TEST_F(Files, devicesAndPipesAreNotRead) {
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder_ / "link");
    for (const fs::path& path : {folder_ / "pipe", folder_ / "link", fs::path("/dev/zero")})
        EXPECT_NE(messageOf([&] { readFile(path); }).find("a device or a pipe"), std::string::npos) << path;
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "abc", 3), 3);
    ::close(ends[1]);
    EXPECT_EQ(readFile(fmt::format("/dev/fd/{}", ends[0])).size(), 3u);
    ::close(ends[0]);
}

// Regular files below /dev, in a memory file system, are replaced like other files.
TEST_F(Files, aFileBelowDevIsReplacedAsAnyOther) {
    const fs::path folder = fmt::format("/dev/shm/defocus-test-{}", ::getpid());
    std::error_code status;
    if (!fs::create_directory(folder, status)) GTEST_SKIP() << "no /dev/shm";
    writeFile(folder / "a", std::string_view("before"));
    fs::create_hard_link(folder / "a", folder / "b");
    writeFile(folder / "a", std::string_view("after"));
    EXPECT_EQ(textOf(folder / "a"), "after");
    EXPECT_EQ(textOf(folder / "b"), "before") << "written in place";
    fs::remove_all(folder);
}

TEST_F(Files, whatAnotherFileNamesLiesInItsFolderAndIsAFile) {
    fs::create_directory(folder_ / "below");
    writeFile(folder_ / "below" / "a.png", std::string_view("a"));
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder_ / "link");
    EXPECT_EQ(fileWithin(folder_, "below/a.png"), folder_ / "below" / "a.png");
    EXPECT_EQ(fileWithin(folder_, "below/../below/./a.png"), folder_ / "below/../below/./a.png");
    EXPECT_EQ(fileWithin(folder_, "missing"), folder_ / "missing");
    for (const char* outside : {"", "/dev/zero", "..", "../a.png", "below/../../a.png", "./../a.png"})
        EXPECT_NE(messageOf([&] { fileWithin(folder_, outside); }).find("is outside the folder"), std::string::npos)
            << outside;
    for (const char* other : {"pipe", "link", "below", "."})
        EXPECT_NE(messageOf([&] { fileWithin(folder_, other); }).find("not a file"), std::string::npos) << other;
}

TEST(Hash, everyByteMattersAndPiecesChain) {
    std::string text(37, 'a');
    const auto hash = [](std::string_view s, std::uint64_t seed = hashSeed) {
        return hashBytes(std::as_bytes(std::span(s)), seed);
    };
    const std::uint64_t original = hash(text);
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string changed = text;
        changed[i] = 'b';
        EXPECT_NE(hash(changed), original) << i;
    }
    EXPECT_EQ(hash("b", hash("a")), hash("b", hash("a")));
    EXPECT_NE(hash("b", hash("a")), hash("a", hash("b")));
}

TEST(ParallelFor, visitsEachIndexOnce) {
    std::vector<std::atomic<int>> visits(1000);
    parallelFor(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, passesOnTheFirstFailure) {
    EXPECT_THROW(parallelFor(100,
                             [](std::size_t i) {
                                 if (i == 17) fail("seventeen");
                             }),
                 Error);
}

// A loop body that waits for an inner loop works only on that loop, not on another index of the outer loop. Work on
// another index might wait for a lock that this body holds, and would double the memory use.
TEST(ParallelFor, nestsWithoutMixingAndWithoutMoreThreadsThanCores) {
    static thread_local int inside = 0;
    std::vector<std::atomic<int>> visits(64 * 64);
    std::atomic<unsigned> working = 0;
    std::atomic<unsigned> max = 0;
    std::atomic<bool> mixed = false;
    parallelFor(64, [&](std::size_t i) {
        if (++inside != 1) mixed = true;
        parallelFor(64, [&](std::size_t k) {
            const unsigned now = ++working;
            for (unsigned seen = max; seen < now && !max.compare_exchange_weak(seen, now);) continue;
            ++visits[64 * i + k];
            --working;
        });
        --inside;
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
    EXPECT_FALSE(mixed);
    EXPECT_LE(max, std::max(1u, std::thread::hardware_concurrency()));
}

TEST(ParallelFor, passesOnAFailureOfAnInnerLoop) {
    EXPECT_EQ(messageOf([] {
                  parallelFor(8, [](std::size_t i) {
                      parallelFor(8, [i](std::size_t k) {
                          if (i == 3 && k == 5) fail("three, five");
                      });
                  });
              }),
              "three, five");
}

TEST(Bounds, emptyStaysEmptyAndTransformsKeepTheCorners) {
    EXPECT_TRUE(transformed(Bounds{}, glm::dmat4(1)).empty());
    Bounds box;
    box.extend(glm::dvec3(0));
    box.extend(glm::dvec3(1, 2, 3));
    const Bounds turned = transformed(box, glm::rotate(glm::dmat4(1), glm::radians(90.0), glm::dvec3(0, 0, 1)));
    EXPECT_NEAR(turned.minimum.x, -2, 1e-12);
    EXPECT_NEAR(turned.maximum.y, 1, 1e-12);
    EXPECT_NEAR(turned.maximum.z, 3, 1e-12);
}

}  // namespace
}  // namespace defocus::engine
