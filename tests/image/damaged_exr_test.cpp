// Tests that messages about damaged EXR files are valid UTF-8 for any contents of the file.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "image/image_io.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

TEST(DamagedExr, messagesHaveNoBytesOfDamagedNames) {
    const ScratchFolder folder;
    writeImage(folder / "a.exr", Image(4, 4, 4), Metadata());
    std::ifstream file(folder / "a.exr", std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(file), {});
    const std::string name = "screenWindowWidth";
    const std::size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    bytes[at + 1] = '\xfe';  // invalid UTF-8
    bytes[at + 2] = '\n';
    bytes[at + name.size() + 1 + std::string("float").size() + 1] = 9;  // size of the value, normally 4
    std::ofstream(folder / "a.exr", std::ios::binary) << bytes;
    const std::string message = messageOf<Error>([&] { static_cast<void>(readImage(folder / "a.exr")); });
    EXPECT_NE(message.find("'s??eenWindowWidth'"), std::string::npos) << message;
}

}  // namespace
}  // namespace defocus::engine
