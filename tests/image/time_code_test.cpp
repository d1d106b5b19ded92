// Tests time codes and frame rates of video frames, and EXR's standard attributes as the image library reads them.

#include "image/time_code.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/file.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

TEST(FrameTimeCode, countsFramesSecondsMinutesAndHours) {
    EXPECT_EQ(timeCodeOfFrame(0, 24), (TimeCode{0, 0, 0, 0}));
    EXPECT_EQ(timeCodeOfFrame(47, 24), (TimeCode{0, 0, 1, 23}));
    EXPECT_EQ(timeCodeOfFrame(30 * 3661 + 7, 29.97), (TimeCode{1, 1, 1, 7}));
    EXPECT_FALSE(timeCodeOfFrame(-1, 24));
    EXPECT_FALSE(timeCodeOfFrame(0, 60));
    EXPECT_FALSE(timeCodeOfFrame(24 * 3600 * 24, 24));
}

// By SMPTE ST 12-1, the time code 01:23:45:16 is 0x01234516.
TEST(FrameTimeCode, hasADecimalDigitInFourBits) {
    EXPECT_EQ(timeCodeBits({1, 23, 45, 16}), 0x01234516u);
    EXPECT_EQ(timeCodeOf(0x01234516u), (TimeCode{1, 23, 45, 16}));
}

TEST(FrameRate, isAFraction) {
    EXPECT_EQ(rationalFrameRate(24), (Rational{24, 1}));
    EXPECT_EQ(rationalFrameRate(23.976), (Rational{24000, 1001}));
    EXPECT_EQ(rationalFrameRate(29.97), (Rational{30000, 1001}));
    EXPECT_EQ(rationalFrameRate(12.5), (Rational{125, 10}));
    EXPECT_EQ(rationalFrameRate(0.001), (Rational{1, 1000}));
}

Metadata filmMetadata() {
    return {{"framesPerSecond", Rational{24000, 1001}},
            {"timeCode", TimeCode{0, 0, 2, 5}},
            {"focus", 2.5},
            {"aperture", 1.4},
            {"expTime", 0.02},
            {"isoSpeed", 400.0}};
}

TEST(ExrAttributes, areReadBack) {
    const ScratchFolder folder;
    writeImage(folder / "film.exr", Image(4, 3, 4), filmMetadata());
    Metadata read;
    readImage(folder / "film.exr", read);
    for (const auto& [name, value] : filmMetadata()) EXPECT_TRUE(read.at(name) == value) << name;
}

// The command-line tools exrheader (OpenEXR) and iinfo (OpenImageIO) print the attributes under their standard names.
TEST(ExrAttributes, areThoseOfOtherPrograms) {
    const ScratchFolder folder;
    writeImage(folder / "film.exr", Image(4, 3, 4), filmMetadata());
    const auto printed = [&](const std::string& command) -> std::string {
        if (std::system(("command -v " + command.substr(0, command.find(' ')) + " >/dev/null").c_str()) != 0) return "";
        const std::string line = command + " " + (folder / "film.exr").string() + " >" + (folder / "out").string();
        EXPECT_EQ(std::system(line.c_str()), 0) << line;
        const std::vector<std::byte> bytes = readFile(folder / "out");
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    };
    const auto expectAll = [](const std::string& text, std::initializer_list<const char*> parts) {
        if (text.empty()) return;
        for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    };
    const std::string openExr = printed("exrheader");
    const std::string openImageIo = printed("iinfo -v");
    expectAll(openExr,
              {"chromaticities (type chromaticities)", "red   (0.64 0.33)", "white (0.3127 0.329)",
               "framesPerSecond (type rational): 24000/1001", "timeCode (type timecode)", "focus (type float): 2.5",
               "aperture (type float): 1.4", "expTime (type float): 0.02", "isoSpeed (type float): 400"});
    expectAll(openImageIo, {"ramesPerSecond: 24000/1001", "smpte:TimeCode: 00:00:02:05", "focus: 2.5", "FNumber: 1.4",
                            "ExposureTime: 0.02", "isoSpeed: 400"});
    if (openExr.empty() && openImageIo.empty()) GTEST_SKIP() << "neither exrheader nor iinfo is installed";
}

}  // namespace
}  // namespace defocus::engine
