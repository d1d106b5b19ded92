// End-to-end tests of `defocus capture`: frames, their order, resuming, sharing between machines, and errors.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "capture/frame_files.h"
#include "cli/shots.h"
#include "image/image_io.h"
#include "image/tone_map.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string name(int frame) {
    return "frames/000" + std::to_string(frame) + ".exr";
}

TEST_F(Capture, writesEachFrameWithItsMetadataAndASidecarOfTimes) {
    const Outcome outcome = capture({"--frame-rate", "10"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    for (int frame = 0; frame < 8; ++frame) {
        Metadata metadata;
        const Image image = readImage(folder() / name(frame), metadata);
        EXPECT_EQ(image.width, 64);
        EXPECT_EQ(std::get<int>(metadata.at("defocus:frame")), frame);
        EXPECT_DOUBLE_EQ(std::get<double>(metadata.at("defocus:time")), frame / 10.0);
        EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 8);
        EXPECT_FALSE(metadata.contains("defocus:seconds"));
        // The f-number changes by two stops, from f/1.4 to f/2.8. Its logarithm is a smoothstep function of time.
        const double t = frame / 7.0;
        EXPECT_NEAR(std::get<double>(metadata.at("aperture")), 1.4 * std::exp2(t * t * (3 - 2 * t)), 1e-5);
        if (frame == 0) {
            EXPECT_NEAR(std::get<double>(metadata.at("focus")), 2, 1e-6);
        }
        if (frame == 7) {
            EXPECT_NEAR(std::get<double>(metadata.at("focus")), 8, 1e-5);
        }
    }
    const std::string times = bytesOf("frames/timings.jsonl");
    EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), 8);
    EXPECT_GT(json::parse(times.substr(0, times.find('\n'))).at("renderMilliseconds").get<double>(), 0);
}

// Shots default to LodMode::continuous, whose level changes are the least visible. Shot files, options and presets can
// override the default.
TEST_F(Capture, levelsChangePixelByPixelByDefault) {
    const auto lodWith = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"--range", "0"};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(capture(words).exitCode, 0);
        Metadata metadata;
        readImage(folder() / name(0), metadata);
        return std::get<std::string>(metadata.at("defocus:lod"));
    };
    EXPECT_EQ(lodWith({}), "continuous");
    EXPECT_EQ(lodWith({"--lod", "nearest"}), "nearest");
    EXPECT_EQ(lodWith({"--preset", "jeong2011"}), "fractional");
    json document = shot();
    document["lod"] = "off";
    writeShot(document);
    EXPECT_EQ(lodWith({}), "off");
}

// A frame is bit-identical whether it is rendered in the sequence, alone, in a shard (part of the frames), with a
// second output format, or with fewer samples drawn together (--wave).
TEST_F(Capture, aFrameIsTheSameBitsHoweverItIsRendered) {
    ASSERT_EQ(capture({}).exitCode, 0);
    ASSERT_EQ(capture({"--range", "5", "-o", "alone/####.exr"}).exitCode, 0);
    ASSERT_EQ(capture({"--shard", "2/3", "-o", "shard/####.exr", "-o", "shard/####.png", "--wave", "3"}).exitCode, 0);
    for (const char* other : {"alone/0005.exr", "shard/0005.exr"})
        EXPECT_TRUE(bytesOf(other) == bytesOf(name(5))) << other;
    EXPECT_TRUE(bytesOf("shard/0002.exr") == bytesOf(name(2)));
    EXPECT_FALSE(fs::exists(folder() / "shard/0003.exr"));
    EXPECT_FALSE(bytesOf(name(4)) == bytesOf(name(5)));
}

TEST_F(Capture, shardsShareAllFrames) {
    for (const char* shard : {"0/3", "1/3", "2/3"}) ASSERT_EQ(capture({"--shard", shard}).exitCode, 0);
    for (int frame = 0; frame < 8; ++frame) EXPECT_TRUE(fs::exists(folder() / name(frame)));
    expectOneLine(run({"capture", "shot.json", "--shard", "3/3"}), 2);
}

TEST_F(Capture, resumeKeepsFinishedFramesOnly) {
    ASSERT_EQ(capture({}).exitCode, 0);
    const std::string second = bytesOf(name(2));
    const std::string fifth = bytesOf(name(5));
    fs::remove(folder() / name(2));
    std::ofstream(folder() / name(5), std::ios::binary) << fifth.substr(0, fifth.size() / 2);
    std::ofstream(folder() / name(6), std::ios::binary) << "not an image";
    std::ofstream(folder() / "frames/.0002.4711-0.exr") << "left by a killed process";
    const auto before = fs::last_write_time(folder() / name(3));
    const Outcome outcome = run({"capture", "shot.json", "--resume"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("8 frames, 5 of them from earlier runs: 3 rendered"), std::string::npos) << outcome.err;
    EXPECT_EQ(fs::last_write_time(folder() / name(3)), before);
    EXPECT_TRUE(bytesOf(name(2)) == second);
    EXPECT_TRUE(bytesOf(name(5)) == fifth);
    EXPECT_FALSE(fs::exists(folder() / "frames/.0002.4711-0.exr"));
}

TEST_F(Capture, resumeReplacesFramesOfOtherSettingsOnlyWhenTold) {
    ASSERT_EQ(capture({"--range", "0:1", "-o", "a#.png", "-o", "b#.jpg"}).exitCode, 0);
    const auto resumed = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words = {"capture", "shot.json", "--range", "0:1",   "--resume",
                                          "-o",      "a#.png",    "-o",      "b#.jpg"};
        words.insert(words.end(), options.begin(), options.end());
        return run(words);
    };
    const auto rendered = [&](const std::vector<std::string>& options) {
        const std::string text = resumed(options).err;
        return text.find("rendered") == std::string::npos ? 0 : std::atoi(text.c_str() + text.find(": ") + 2);
    };
    EXPECT_EQ(rendered({}), 0) << "PNG and JPEG store their settings, too";
    const std::string first = bytesOf("a0.png");
    const Outcome refused = resumed({"--samples", "9"});
    expectOneLine(refused, 1);
    EXPECT_NE(refused.err.find("a0.png and 1 more frame were rendered with other settings; replace with --overwrite"),
              std::string::npos)
        << refused.err;
    EXPECT_TRUE(bytesOf("a0.png") == first);
    EXPECT_EQ(rendered({"--samples", "9", "--overwrite"}), 2);
    EXPECT_EQ(rendered({"--samples", "9", "--overwrite"}), 0);
    EXPECT_EQ(rendered({"--samples", "9", "--exposure", "1", "--overwrite"}), 2);
    EXPECT_EQ(rendered({"--samples", "9", "--exposure", "1", "--fstop", "2", "--overwrite"}), 2);
    expectOneLine(run({"capture", "shot.json", "--overwrite"}), 2);  // --overwrite requires --resume
}

// --resume never replaces an image that has a frame's name but is not a frame of the shot.
TEST_F(Capture, resumeKeepsForeignPictures) {
    writeImage(folder() / "a0.png", Image(4, 4, 3));
    expectOneLine(run({"capture", "shot.json", "--range", "0", "--resume", "-o", "a#.png"}), 1);
    EXPECT_EQ(readImage(folder() / "a0.png").width, 4);
}

TEST_F(Capture, optionsReplaceWhatTheShotSays) {
    ASSERT_EQ(capture({"--range", "3", "--size", "32x24", "--samples", "4", "--fstop", "4", "--focus-node", "Far",
                       "--camera", "Main", "--set", "/lens/bladeCount=7", "-o", "x#.exr"})
                  .exitCode,
              0);
    Metadata metadata;
    EXPECT_EQ(readImage(folder() / "x3.exr", metadata).width, 32);
    EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 4);
    EXPECT_EQ(std::get<double>(metadata.at("aperture")), 4);
    EXPECT_NEAR(std::get<double>(metadata.at("focus")), 8, 1e-6) << "the scene's camera does not move";
    EXPECT_EQ(std::get<double>(metadata.at("defocus:bladeCount")), 7);
}

// The focus distance at a pixel or at the middle of the image is measured at each frame's own time, independent of the
// other frames in the run. The camera moves 0.6 m towards the square in the middle.
TEST_F(Capture, focusOnPixelAndMiddleIsFoundInEachFrame) {
    json dolly = shot();
    dolly.erase("focus");
    dolly["camera"] = json::parse(R"({"dolly": {"distance": 0.6, "interpolation": "linear"}})");
    writeShot(dolly);
    const auto focusOf = [&](const char* output, int frame) {
        Metadata metadata;
        readImage(folder() / framePath(output, frame), metadata);
        return std::get<double>(metadata.at("focus"));
    };
    ASSERT_EQ(capture({"--focus-pixel", "32,14", "-o", "p#.exr"}).exitCode, 0);
    ASSERT_EQ(capture({"--focus-auto", "-o", "a#.exr"}).exitCode, 0);
    for (int frame = 0; frame < 8; ++frame) {
        EXPECT_NEAR(focusOf("p#.exr", frame), 2 - 0.6 * frame / 7, 1e-5) << frame;
        EXPECT_NEAR(focusOf("a#.exr", frame), 2 - 0.6 * frame / 7, 1e-5) << frame;
    }
    dolly["focus"] = json::parse(R"({"pixel": [32, 14]})");
    writeShot(dolly);
    ASSERT_EQ(capture({"--range", "5", "-o", "alone#.exr"}).exitCode, 0);
    EXPECT_TRUE(bytesOf("alone5.exr") == bytesOf("p5.exr"));
    ASSERT_EQ(capture({"--shard", "1/3", "-o", "shard#.exr", "--focus-auto"}).exitCode, 0);
    EXPECT_TRUE(bytesOf("shard4.exr") == bytesOf("a4.exr"));
    // Pixel coordinates in a shot refer to the image size in the shot.
    ASSERT_EQ(capture({"--range", "5", "-o", "small#.exr", "--size", "32x24"}).exitCode, 0);
    EXPECT_NEAR(focusOf("small#.exr", 5), 2 - 0.6 * 5 / 7, 1e-5);
    expectOneLine(capture({"--range", "0", "--focus-pixel", "0,0"}), 1);
}

TEST_F(Capture, aCameraPlacedByHandStandsThere) {
    ASSERT_EQ(capture({"--range", "3", "--camera-position", "0,0,2", "--focus-node", "Near", "-o", "x#.exr"}).exitCode,
              0);
    Metadata metadata;
    readImage(folder() / "x3.exr", metadata);
    EXPECT_NEAR(std::get<double>(metadata.at("focus")), 4, 1e-5);
}

TEST_F(Capture, sampleSeedIsTheSameInEachFrameUnlessAskedFor) {
    json still = shot();
    still.erase("camera");
    still.erase("focus");
    still["lens"] = {{"fStop", 1.4}, {"focusDistance", 3}};
    writeShot(still);
    const auto pixels = [&](const char* file) { return readImage(folder() / file).pixels; };
    ASSERT_EQ(capture({"--range", "0:1", "-o", "s#.exr"}).exitCode, 0);
    EXPECT_EQ(pixels("s0.exr"), pixels("s1.exr"));
    ASSERT_EQ(capture({"--range", "0:1", "-o", "a#.exr", "--animate-seed"}).exitCode, 0);
    EXPECT_NE(pixels("a0.exr"), pixels("a1.exr"));
}

TEST_F(Capture, warnsOfOptionsThatDoNothingAndOfClippedPictures) {
    const auto warned = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"capture", "shot.json", "--range", "0"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.err;
    };
    const auto says = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    const std::string unused = warned({"--lod", "off", "--size-threshold", "2"});
    EXPECT_TRUE(says(unused, "warning: --size-threshold has no effect: --lod off")) << unused;
    EXPECT_FALSE(says(unused, "of the image is")) << unused;
    // The time and the seed that each frame gets are not settings of the user.
    json still = shot();
    still.erase("animation");
    writeShot(still);
    const Outcome later =
        run({"capture", "shot.json", "--range", "1", "--animate-seed", "--method", "circular", "-o", "later/####.exr"});
    EXPECT_EQ(later.exitCode, 0) << later.err;
    EXPECT_FALSE(says(later.err, "--time")) << later.err;
    EXPECT_FALSE(says(later.err, "--seed")) << later.err;
    const std::string black = warned({"--exposure", "-20", "-o", "black/####.png"});
    EXPECT_TRUE(says(black, "of the image is black at an exposure of -20 EV")) << black;
    EXPECT_EQ(warned({"--exposure", "-20", "-o", "black/####.png", "--quiet"}), "");
    EXPECT_FALSE(says(warned({"--exposure", "-20", "-o", "linear/####.exr"}), "of the image is"));
}

TEST_F(Capture, dryRunPrintsAndWritesNothing) {
    const Outcome outcome = run({"capture", "shot.json", "--dry-run"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2 + 8) << outcome.out;
    EXPECT_NE(outcome.out.find("frames/0007.exr"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder() / "frames"));
}

TEST_F(Capture, faultsAreOneLine) {
    json wrong = shot();
    wrong["focus"]["keys"][1] = {{"frame", 7}, {"node", "Nobody"}};
    writeShot(wrong);
    const Outcome node = capture({});
    expectOneLine(node, 1);
    EXPECT_NE(node.err.find("shot.json: /focus/keys/1/node: there is no node 'Nobody'"), std::string::npos) << node.err;
    for (const char* place : {"/camera/name", "/animation/clip", "/focus/node"}) {
        json misnamed = shot();
        if (std::string(place).starts_with("/focus")) misnamed.erase("focus");
        misnamed[json::json_pointer(place)] = "Nobody";
        writeShot(misnamed);
        const Outcome outcome = capture({});
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find(std::string("shot.json: ") + place + ": there is no "), std::string::npos)
            << outcome.err;
    }
    writeShot(shot());
    EXPECT_NE(capture({"--clip", "Nobody"}).err.find("defocus: there is no animation 'Nobody'"), std::string::npos)
        << "an option has no path in the shot";
    wrong["focus"] = 3;
    writeShot(wrong);
    const Outcome focus = capture({});
    expectOneLine(focus, 1);
    EXPECT_NE(focus.err.find("shot.json: /focus: expected an object, not 3"), std::string::npos) << focus.err;
    writeShot(shot());
    expectOneLine(capture({"-o", "frame.exr"}), 1);
    expectOneLine(capture({"--range", "3:1"}), 2);
    expectOneLine(capture({"--set", "fStop=2"}), 2);
    expectOneLine(run({"capture", "missing.json"}), 1);
    expectOneLine(run({"capture"}), 2);
    EXPECT_EQ(std::count_if(fs::directory_iterator(folder()), fs::directory_iterator(),
                            [](const auto& entry) { return entry.path().extension() == ".exr"; }),
              0);
}

TEST_F(Capture, fullDiskIsOneLineAndKeepsWhatIsThere) {
    ASSERT_EQ(capture({"--range", "0:2"}).exitCode, 0);
    const std::string first = bytesOf(name(0));
    const Outcome outcome = capture({"--resume", "--range", "0:5"}, 600);
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("cannot write "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--resume"), std::string::npos) << outcome.err;
    EXPECT_TRUE(bytesOf(name(0)) == first);
    EXPECT_FALSE(fs::exists(folder() / name(3)));
    EXPECT_EQ(fileCount(), 2u + 1 + 3 + 1) << "scene, shot, folder, three frames, times";
}

TEST_F(Capture, withoutFfmpegAFilmIsRefusedBeforeTheWork) {
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    const Outcome outcome = capture({"--video", "film.mp4"});
    ::setenv("PATH", path.c_str(), 1);
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("ffmpeg, which is not installed"), std::string::npos) << outcome.err;
}

TEST_F(Capture, filmHasTheFramesAtTheirRate) {
    if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    ASSERT_EQ(capture({"--video", "film.mp4", "--frame-rate", "8", "--range", "1:6", "--size", "65x49"}).exitCode, 0);
    const fs::path facts = folder() / "facts";
    const std::string command =
        "ffprobe -v error -count_frames -show_entries stream=nb_read_frames,r_frame_rate,width "
        "-of csv=p=0 '" +
        (folder() / "film.mp4").string() + "' > '" + facts.string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(textOf(facts), "66,8/1,6\n");
    expectOneLine(capture({"--video", "film.avi"}), 1);
    expectOneLine(capture({"--video", "film.mp4", "--shard", "0/2"}), 1);
}

// With SOURCE_DATE_EPOCH, two runs produce byte-identical files.
TEST_F(Capture, filmsAndPicturesAreReproducible) {
    if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
    for (const char* name : {"film.mp4", "film.webm"}) {
        std::vector<std::string> runs;
        for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(capture({"--video", name, "--range", "0:1", "--size", "32x24"}).exitCode, 0);
            runs.push_back(textOf(folder() / name));
            fs::remove_all(folder() / "frames");
        }
        EXPECT_TRUE(runs[0] == runs[1]) << name;
    }
    const auto rendered = [&](const char* name) {
        EXPECT_EQ(run({"render", "quads.gltf", "--size", "32x24", "--samples", "2", "-o", name}).exitCode, 0);
        return textOf(folder() / name);
    };
    const std::string exr = rendered("a.exr"), png = rendered("a.png");
    // Dates in the files are in whole seconds. Without SOURCE_DATE_EPOCH, this pause would change them.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_TRUE(rendered("a.exr") == exr);
    EXPECT_TRUE(rendered("a.png") == png);
    ::unsetenv("SOURCE_DATE_EPOCH");
}

// Colours of videos follow ITU-R BT.709, and the files are tagged accordingly. The column and row that pad odd sizes
// have the same colour as the rest of the frame.
TEST_F(Capture, filmsHaveTaggedColoursOfBt709) {
    if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    const auto outputOf = [&](const std::string& command) {
        const fs::path file = folder() / "output";
        EXPECT_EQ(std::system((command + " > '" + file.string() + "'").c_str()), 0) << command;
        return textOf(file);
    };
    json still = shot();
    still.erase("camera");
    still.erase("focus");
    writeShot(still);
    constexpr std::size_t width = 34, height = 26;
    const std::array<std::array<double, 3>, 3> colours = {{{0, 255, 0}, {255, 0, 0}, {20, 60, 200}}};
    const std::array<const char*, 3> films = {"film.mp4", "film.mkv", "film.webm"};
    for (std::size_t i = 0; i < films.size(); ++i) {
        // Each video shows a uniform background. Its colour has 8-bit values, so the PNG frames, from which the video
        // is encoded, contain it exactly.
        std::string background;
        for (const double value : colours[i])
            background += (background.empty() ? "" : ",") + std::to_string(srgbDecode(static_cast<float>(value / 255)));
        const Outcome outcome = capture({"--video", films[i], "--range", "0", "--size", "33x25", "--background",
                                         background, "--camera-target", "0,0,90", "--tonemap", "none", "--exposure",
                                         "0", "--no-dof", "-o", std::to_string(i) + "#.png"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const std::string film = "'" + (folder() / films[i]).string() + "'";
        EXPECT_EQ(outputOf("ffprobe -v error -show_entries stream=width,height,color_range,color_space,color_transfer,"
                           "color_primaries -of csv=p=0 " +
                           film),
                  "34,26,tv,bt709,bt709,bt709\n");
        const std::string planes = outputOf("ffmpeg -v error -i " + film + " -f rawvideo -pix_fmt yuv420p -");
        ASSERT_EQ(planes.size(), width * height * 3 / 2);
        const auto sample = [&](std::size_t at) { return static_cast<double>(static_cast<unsigned char>(planes[at])); };
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t chroma = width * height + y / 2 * (width / 2) + x / 2;
                const double luma = 255 * (sample(y * width + x) - 16) / 219;
                const double blue = 255 * (sample(chroma) - 128) / 224;
                const double red = 255 * (sample(chroma + width * height / 4) - 128) / 224;
                const std::array<double, 3> shown = {luma + 1.5748 * red, luma - 0.187324 * blue - 0.468124 * red,
                                                     luma + 1.8556 * blue};
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(shown[c], colours[i][c], 2) << films[i] << " at " << x << ", " << y;
            }
    }
}

TEST_F(Capture, targetErrorTakesAsManySamplesAsItNeeds) {
    json document = shot();
    document.erase("samples");
    writeShot(document);
    ASSERT_EQ(run({"capture", "shot.json", "--range", "5", "-o", "free/####.exr", "--target-error", "0.01"}).exitCode,
              0);
    Metadata metadata;
    readImage(folder() / "free/0005.exr", metadata);
    // 64: default number of samples without a target error
    EXPECT_GT(std::get<int>(metadata.at("defocus:samples")), 64);
    EXPECT_LE(std::get<double>(metadata.at("defocus:estimatedError")), 0.01);
}

// With a target error, each frame gets the number of samples that its own error requires. The number is the same if
// the frame is rendered alone, in the sequence, or in another shard of the sequence.
TEST_F(Capture, targetErrorGivesAFrameTheSameSamplesHoweverItIsRendered) {
    const std::vector<std::string> asked = {"--target-error", "0.01", "--samples", "1024"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), asked.begin(), asked.end());
        return capture(more).exitCode;
    };
    ASSERT_EQ(with({}), 0);
    ASSERT_EQ(with({"--range", "5", "-o", "alone/####.exr", "--wave", "3"}), 0);
    ASSERT_EQ(with({"--shard", "2/3", "-o", "shard/####.exr"}), 0);
    for (const char* other : {"alone/0005.exr", "shard/0005.exr"})
        EXPECT_TRUE(bytesOf(other) == bytesOf(name(5))) << other;
    for (int frame = 0; frame < 8; ++frame) {
        Metadata metadata;
        readImage(folder() / name(frame), metadata);
        const int samples = std::get<int>(metadata.at("defocus:samples"));
        EXPECT_TRUE(samples == 1024 || std::get<double>(metadata.at("defocus:estimatedError")) <= 0.01) << frame;
        EXPECT_GE(samples, 128) << frame;
    }
    const std::string before = bytesOf(name(3));
    ASSERT_EQ(with({"--resume"}), 0);
    EXPECT_TRUE(bytesOf(name(3)) == before);
    expectOneLine(capture({"--target-error", "0.01", "--sample-range", "0:64", "-o", "a/####.exr"}), 2);
}

// --time-limit limits the duration of the run, not of a frame. The run renders at least one frame, ends between frames,
// and keeps all finished frames.
TEST_F(Capture, timeLimitEndsTheRunBetweenFrames) {
    ASSERT_EQ(capture({"-o", "whole/####.exr"}).exitCode, 0);
    for (int run = 0; run < 7; ++run) {
        const Outcome outcome = capture({"--time-limit", "0.001", "--resume"});
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find("stopped before frame " + std::to_string(run + 1)), std::string::npos)
            << outcome.err;
    }
    EXPECT_EQ(capture({"--time-limit", "0.001", "--resume"}).exitCode, 0);
    for (int frame = 0; frame < 8; ++frame)
        EXPECT_TRUE(bytesOf(name(frame)) == bytesOf("whole/000" + std::to_string(frame) + ".exr")) << frame;
}

// Puts a folder with a shell script named ffmpeg first in the environment variable PATH, for the lifetime of this
// object.
class FakeFfmpeg {
public:
    FakeFfmpeg(const fs::path& folder, const std::string& script) : path_(std::getenv("PATH")) {
        fs::create_directories(folder);
        std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nPATH='" << path_ << "'\n" << script;
        fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
        ::setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
    }
    ~FakeFfmpeg() { ::setenv("PATH", path_.c_str(), 1); }
    FakeFfmpeg(const FakeFfmpeg&) = delete;
    FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;

private:
    std::string path_;
};

// File names of videos may contain a colon, although ffmpeg reads the text before a colon as a protocol.
TEST_F(Capture, filmsMayHaveAnyName) {
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    for (const char* name : {"12:30.mp4", "pipe:1.mp4"}) {
        const Outcome outcome = capture({"--video", name, "--range", "1:2"});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_TRUE(fs::is_regular_file(folder() / name));
    }
}

// A truncated video never replaces a complete one. The fake ffmpeg behaves as on a full disk: it truncates the video
// but exits with success.
TEST_F(Capture, filmWithoutItsEndNeverReplacesAGoodOne) {
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    const FakeFfmpeg cut(folder() / "bin",
                         "ffmpeg \"$@\" || exit 1\n"
                         "for last; do :; done\n"
                         "last=${last#file:}\n"
                         "test \"$last\" = - || truncate -s $(($(stat -c %s \"$last\") / 2)) \"$last\"\n");
    for (const char* name : {"film.mp4", "film.mkv"}) {
        std::ofstream(folder() / name) << "a good film";
        const Outcome outcome = capture({"--video", name, "--range", "1:6"});
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find("is the disk full?"), std::string::npos) << outcome.err;
        EXPECT_EQ(textOf(folder() / name), "a good film");
    }
    for (const auto& entry : fs::directory_iterator(folder()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path() << " is left";
}

TEST_F(Capture, signalThatEndsFfmpegIsNamed) {
    const FakeFfmpeg killed(folder() / "bin", "kill -9 $$\n");
    const Outcome outcome = capture({"--video", "film.mp4", "--range", "1:2"});
    expectOneLine(outcome, 1);
    EXPECT_NE(outcome.err.find("terminated by signal 9 (Killed)"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "film.mp4"));
}

}  // namespace
}  // namespace defocus::engine
