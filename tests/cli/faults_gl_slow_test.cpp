// Tests that system faults never destroy a complete file or leave a partial file under its final name, and that the
// program reports each fault in one line.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <set>
#include <thread>

#include "cli/become_program.h"
#include "cli/shots.h"
#include "cli/traced_child.h"
#include "gl/context.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

constexpr int kills = 50;

using Words = std::vector<std::string>;

class Faults : public Capture {
protected:
    // Replaces a forked process with the program `defocus`. `environment` selects the faults (tests/faults/faults.cpp).
    void become(Words words, const std::vector<std::pair<std::string, std::string>>& environment = {},
                int out = -1) const {
        const int nothing = out >= 0 ? out : ::open("/dev/null", O_WRONLY);
        const int said = ::open((folder() / "said").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (!environment.empty()) ::setenv("LD_PRELOAD", DEFOCUS_FAULTS, 1);
        for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
        becomeProgram(std::move(words), folder(), cacheFolder().parent_path(), nothing, said);
    }
    [[nodiscard]] TracedChild traced(const Words& words, const std::string& writesInto) const {
        return {[this, words] { become(words); }, writesInto};
    }
    // Runs the program and returns its exit code, or 128 + the number of the signal that ended it.
    int ran(const Words& words, const std::vector<std::pair<std::string, std::string>>& environment = {},
            int out = -1) const {
        const pid_t child = ::fork();
        if (child == 0) become(words, environment, out);
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    [[nodiscard]] std::string said() const { return withoutProgress(bytesOf("said")); }
    void expectSaidOneLine(const std::string& about) const {
        const std::string text = said();
        EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
        EXPECT_NE(text.find(about), std::string::npos) << text;
    }

    // Runs the command `words` repeatedly and kills each run before a random system call that writes into the folder
    // `writesInto`. Calls `look` after each run.
    template <typename Look>
    void killed(const Words& words, const std::string& writesInto, const Look& look) const {
        TracedChild undisturbed = traced(words, writesInto);
        if (!undisturbed.traced()) GTEST_SKIP() << "processes can't be traced here (ptrace)";
        ASSERT_EQ(undisturbed.end(), 0) << said();
        const int calls = undisturbed.calls();
        ASSERT_GT(calls, 0);
        look();
        std::mt19937 random(11);
        for (int i = 0; i < kills; ++i) {
            TracedChild child = traced(words, writesInto);
            // If the cache already has the pyramids, the child makes fewer writes and may end by itself with exit code
            // 0.
            const int code = child.end(std::uniform_int_distribution(1, calls)(random), SIGKILL);
            ASSERT_TRUE(code == 128 + SIGKILL || code == 0) << code << said();
            look();
            if (testing::Test::HasFailure()) return;
        }
    }
};

TEST_F(Faults, aMergeThatIsKilledLeavesTheFileOfBeforeOrTheNewOne) {
    const Words render = {"render", "quads.gltf", "--quiet", "--size", "64x48", "--samples", "128"};
    const auto with = [&](const Words& more) {
        Words words = render;
        words.insert(words.end(), more.begin(), more.end());
        ASSERT_EQ(run(words).exitCode, 0);
    };
    with({"--sample-range", "0:64", "-o", "a.exr"});
    with({"--sample-range", "64:128", "-o", "b.exr"});
    with({"--tile", "0/2", "-o", "upper.exr"});
    with({"--tile", "1/2", "-o", "lower.exr"});
    with({"-o", "whole.exr"});
    fs::create_directory(folder() / "merged");
    for (const Words& parts : {Words{"a.exr", "b.exr"}, {"upper.exr", "lower.exr"}}) {
        const std::vector<float> complete = readImage(folder() / "whole.exr").pixels;
        writeImage(folder() / "merged/out.exr", Image(3, 2, 4));
        killed({"merge", "--quiet", parts[0], parts[1], "-o", "merged/out.exr"}, "merged", [&] {
            const Image now = readImage(folder() / "merged/out.exr");
            EXPECT_TRUE(now.width == 3 || now.pixels == complete);
            writeImage(folder() / "merged/out.exr", Image(3, 2, 4));
        });
    }
}

// Killing the program leaves each file of level-of-detail pyramids in the cache either complete or absent.
TEST_F(Faults, aProgramThatIsKilledLeavesTheCacheSound) {
    std::set<std::string> complete;
    const auto clear = [&] { fs::remove_all(cacheFolder()); };
    const auto look = [&] {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(cacheFolder())) {
            if (!entry.is_regular_file() || entry.path().filename().string().front() == '.') continue;
            const std::string bytes = textOf(entry.path());
            if (complete.size() < 2)
                complete.insert(bytes);
            else
                EXPECT_TRUE(complete.contains(bytes)) << entry.path();
        }
        clear();
    };
    killed({"render", "--quiet", "--fish", "2", "--fish-triangles", "200", "--size", "16x12", "--samples", "1", "-o",
            "a.exr"},
           "defocus", look);
    EXPECT_EQ(complete.size(), 2u);
    EXPECT_EQ(run({"cache", "list"}).exitCode, 0);
}

TEST_F(Faults, aBenchThatIsKilledLeavesWholeReports) {
    killed({"bench", "popping", "quads.gltf", "--quiet", "--size", "16x12", "--fstop", "0.5", "--counts", "2",
            "--frames", "2", "--path-frames", "6", "-o", "result", "--allow-changed"},
           "result", [&] {
               for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "result"))
                   if (entry.path().extension() == ".json" && entry.path().filename().string().front() != '.') {
                       const auto json = nlohmann::json::parse(textOf(entry.path()), nullptr, false);
                       EXPECT_FALSE(json.is_discarded()) << entry.path();
                   }
           });
}

// If `defocus bench` is killed while its child process draws the plots, the folder has the previous report page or a
// complete new one.
TEST_F(Faults, aReportThatIsKilledIsWhole) {
    if (std::system("python3 -c 'import matplotlib, PIL' 2>/dev/null || "
                    "/usr/bin/python3 -c 'import matplotlib, PIL' 2>/dev/null") != 0)
        GTEST_SKIP() << "matplotlib is needed (Debian: python3-matplotlib)";
    const Words line = {"bench",         "popping", "quads.gltf", "--quiet", "--size",         "16x12",
                        "--fstop",       "0.5",     "--counts",   "2",       "--frames",       "2",
                        "--path-frames", "6",       "--report",   "report",  "--allow-changed"};
    const auto complete = [&] {
        const std::string page = bytesOf("report/index.html");
        return page.starts_with("<!doctype html>") && page.ends_with("</html>\n");
    };
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(ran(line), 0) << said();
    auto lasts = std::chrono::steady_clock::now() - begin;
    ASSERT_TRUE(complete());
    std::mt19937 random(5);
    int killed = 0;
    for (int i = 0; i < 10; ++i) {
        if (i % 2 == 0) fs::remove(folder() / "report/index.html");
        const bool before = fs::exists(folder() / "report/index.html");
        const pid_t child = ::fork();
        if (child == 0) {
            ::setpgid(0, 0);
            become(line);
        }
        ::setpgid(child, child);
        std::this_thread::sleep_for(lasts * std::uniform_real_distribution(0.1, 1.0)(random));
        ::kill(-child, SIGKILL);  // kills the process group, which includes the plotting process
        int status = 0;
        ::waitpid(child, &status, 0);
        if (WIFSIGNALED(status))
            ++killed;
        else
            // This run ended before the kill. The delay is a random fraction of the first run's time, and the first
            // run was slower, for example because it scanned fonts.
            lasts /= 2;
        EXPECT_TRUE(complete() || (!before && !fs::exists(folder() / "report/index.html"))) << i;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "report")) {
            const bool json = entry.path().extension() == ".json" && entry.path().filename().string().front() != '.';
            EXPECT_TRUE(!json || nlohmann::json::accept(textOf(entry.path()))) << entry.path();
        }
    }
    EXPECT_GT(killed, 0);
    // The next run removes the temporary files of the killed runs.
    ASSERT_EQ(ran(line), 0) << said();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "report"))
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

// A render that is stopped by a signal prints one line and leaves no file. The complete render would take minutes; its
// first progress line comes after a second.
TEST_F(Faults, aRenderThatIsStoppedSaysSoAndLeavesNothing) {
    for (const int signal : {SIGTERM, SIGINT}) {
        fs::remove(folder() / "said");
        const pid_t child = ::fork();
        if (child == 0) become({"render", "quads.gltf", "--size", "512x384", "--samples", "65536", "-o", "out.exr"});
        siginfo_t ended{};
        while (bytesOf("said").find("samples: ") == std::string::npos && ended.si_pid == 0)
            ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
        expectSaidOneLine("of 65536 samples; no image was written");
        EXPECT_FALSE(fs::exists(folder() / "out.exr"));
        for (const fs::directory_entry& entry : fs::directory_iterator(folder()))
            EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
    }
}

TEST_F(Faults, aFrameInTilesThatIsKilledOrStoppedGoesOn) {
    if (!createHeadlessContext()->software()) GTEST_SKIP() << "a GPU keeps the pixels in its own memory";
    const Words line = {"render", "quads.gltf", "--quiet", "--size", "1600x1200", "--samples",
                        "3",      "--memory",   "350MiB",  "-o",     "out.exr",   "--resume"};
    Words complete = line;
    complete[10] = "whole.exr";
    ASSERT_EQ(run(complete).exitCode, 0);
    const std::vector<float> pixels = readImage(folder() / "whole.exr").pixels;
    for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
        TracedChild child = traced(line, "out.tiles");
        if (!child.traced()) GTEST_SKIP() << "processes can't be traced here (ptrace)";
        const int code = child.end(8, signal);
        if (signal == SIGKILL) {
            EXPECT_EQ(code, 128 + SIGKILL);
        } else {
            EXPECT_EQ(code, 1);
            expectSaidOneLine("rows are kept in out.tiles; repeat the command with --resume to continue");
        }
        EXPECT_FALSE(fs::exists(folder() / "out.exr"));
        EXPECT_TRUE(fs::exists(folder() / "out.tiles"));
        ASSERT_EQ(run(line).exitCode, 0);
        EXPECT_TRUE(readImage(folder() / "out.exr").pixels == pixels);
        EXPECT_FALSE(fs::exists(folder() / "out.tiles"));
        fs::remove(folder() / "out.exr");
    }
}

// Mesa maps the index of its shader cache into memory. If the disk has no room for the index, a write to the mapping
// would end the program with SIGBUS.
TEST_F(Faults, aFullDiskUnderTheShaderCacheIsNoCrash) {
    fs::create_directory(folder() / "small");
    std::ofstream(folder() / "inside.sh")
        << "mount -t tmpfs -o size=16k tmpfs small || exit 9\n"
           "unset MESA_SHADER_CACHE_DIR MESA_GLSL_CACHE_DIR MESA_SHADER_CACHE_DISABLE MESA_GLSL_CACHE_DISABLE\n"
           "XDG_CACHE_HOME=\"$PWD/small\" '" DEFOCUS_PROGRAM
           "' render quads.gltf --size 64x48 --samples 2 -o a.png 2> said\necho $? > code\n";
    const std::string command =
        "cd '" + folder().string() + "' && unshare --map-root-user --user --mount sh inside.sh > /dev/null 2>&1";
    if (std::system(command.c_str()) != 0 || !fs::exists(folder() / "code"))
        GTEST_SKIP() << "no small file system can be mounted here (unshare)";
    EXPECT_EQ(bytesOf("code"), "0\n") << bytesOf("said");
    EXPECT_TRUE(fs::exists(folder() / "a.png"));
    const std::string text = bytesOf("said");
    const std::size_t warning = text.find("the driver's shader cache is off for this run");
    EXPECT_NE(warning, std::string::npos) << text;
    EXPECT_EQ(text.find("shader cache is off", warning + 30), std::string::npos) << text;
}

TEST_F(Faults, aReaderThatGoesAwayIsNoCrash) {
    for (const Words& words : {Words{"info", "quads.gltf"},
                               {"plan", "quads.gltf", "--json"},
                               {"render", "quads.gltf", "--size", "64x48", "--samples", "2", "-o", "-"}}) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        ::close(ends[0]);
        const int code = ran(words, {}, ends[1]);
        ::close(ends[1]);
        EXPECT_TRUE(code == 1 || code == 128 + SIGPIPE) << code;
        if (code == 1) expectSaidOneLine("standard output");
    }
}

#ifdef DEFOCUS_FAULTS_LOADABLE

// Two programs can share a cache on a file system without locks. They use complete files of earlier runs and rebuild
// damaged ones.
TEST_F(Faults, aCacheOnAFileSystemWithoutLocksServesAllTheSame) {
    const Words words = {"render", "--quiet",   "--fish", "2", "--fish-triangles", "400", "--size",
                         "16x12",  "--samples", "1",      "-o"};
    const auto to = [&](const char* output) {
        Words line = words;
        line.emplace_back(output);
        return line;
    };
    const pid_t other = ::fork();
    if (other == 0) become(to("b.exr"), {{"FAULT_LOCKS", "1"}});
    EXPECT_EQ(ran(to("a.exr"), {{"FAULT_LOCKS", "1"}}), 0) << said();
    int status = 0;
    ::waitpid(other, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(ran(to("c.exr"), {{"FAULT_LOCKS", "1"}}), 0) << said();
    for (const char* name : {"b.exr", "c.exr"})
        EXPECT_TRUE(readImage(folder() / name).pixels == readImage(folder() / "a.exr").pixels) << name;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(cacheFolder()))
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

TEST_F(Faults, aClockThatGoesBackChangesNothing) {
    const Words film = {"capture", "shot.json", "--quiet", "--range", "0:3", "-o"};
    const auto to = [&](const char* pattern) {
        Words line = film;
        line.emplace_back(pattern);
        return line;
    };
    ASSERT_EQ(ran(to("true/#.exr")), 0);
    EXPECT_EQ(ran(to("false/#.exr"), {{"FAULT_CLOCK", "1"}}), 0) << said();
    for (int i = 0; i < 4; ++i)
        EXPECT_TRUE(bytesOf(fmt::format("true/{}.exr", i)) == bytesOf(fmt::format("false/{}.exr", i))) << i;
    EXPECT_EQ(ran({"render", "quads.gltf", "--quiet", "--size", "64x48", "--samples", "256", "--time-limit", "5", "-o",
                   "a.exr"},
                  {{"FAULT_CLOCK", "1"}}),
              0)
        << said();
}

// If any one of the driver's memory allocations fails, the program prints one line and keeps the
// finished frames.
TEST_F(Faults, aDriverOutOfMemoryInTheMiddleKeepsTheFramesBefore) {
    const Words film = {"capture", "shot.json", "--quiet", "--range", "0:7", "--resume"};
    ASSERT_EQ(run({"capture", "shot.json", "--quiet", "--range", "0:7", "-o", "whole/####.exr"}).exitCode, 0);
    int partly = 0;
    for (const int calls : {1, 5, 20, 40, 60, 80, 100, 130, 160, 200}) {
        fs::remove_all(folder() / "frames");
        const int code = ran(film, {{"FAULT_GL_MEMORY", std::to_string(calls)}});
        EXPECT_TRUE(code == 1 || code == 0) << code;
        if (code == 1) expectSaidOneLine("memory");
        int there = 0;
        for (int i = 0; i < 8; ++i) {
            const std::string name = fmt::format("{:04}.exr", i);
            if (!fs::exists(folder() / "frames" / name)) continue;
            ++there;
            EXPECT_TRUE(bytesOf("frames/" + name) == bytesOf("whole/" + name)) << name;
        }
        partly += there > 0 && there < 8 ? 1 : 0;
        EXPECT_EQ(ran(film), 0) << said();
        EXPECT_TRUE(bytesOf("frames/0007.exr") == bytesOf("whole/0007.exr"));
    }
    EXPECT_GT(partly, 0) << "some runs must fail after the first frames";
}

// The program names each extension that the driver lacks, whether or not a fallback can render the image.
TEST_F(Faults, extensionsThatADriverLacksAreNamed) {
    if (!createHeadlessContext()->software()) GTEST_SKIP() << "GPU drivers lack other extensions";
    const Words line = {"render", "quads.gltf", "--size", "16x12", "--samples", "1", "-o", "a.exr", "--verbose"};
    EXPECT_EQ(ran(line, {{"FAULT_EGL", "EGL_EXT_platform_device"}}), 0) << said();
    EXPECT_NE(said().find("EGL devices: the driver does not support EGL_EXT_platform_device\n"), std::string::npos)
        << said();
    EXPECT_NE(said().find("surfaceless platform: "), std::string::npos) << said();

    const std::string all = "EGL_EXT_platform_device,EGL_MESA_platform_surfaceless";
    EXPECT_EQ(ran(line, {{"FAULT_EGL", all}, {"EGL_PLATFORM", "x11"}, {"DISPLAY", ":-1"}}), 1);
    const std::string text = said();
    EXPECT_NE(text.find("cannot create an OpenGL 4.5 context: EGL devices: the driver does not support "
                        "EGL_EXT_platform_device; surfaceless platform: the driver does not support "
                        "EGL_MESA_platform_surfaceless; default display: eglInitialize"),
              std::string::npos)
        << text;
}

#endif

// A read-only output folder yields one error line and no crash. The folder is mounted read-only, since file
// permissions do not stop root.
TEST_F(Faults, aReadOnlyFolderIsOneLineAndNeverACrash) {
    fs::create_directory(folder() / "locked");
    writeImage(folder() / "locked/0.exr", Image(3, 2, 4));
    std::ofstream(folder() / "inside.sh")
        << "mount --bind locked locked && mount -o remount,ro,bind locked || exit 9\n"
           "run() { '" DEFOCUS_PROGRAM
           "' \"$@\" --quiet; echo \"code $?\"; }\n"
           "run render quads.gltf --size 16x12 --samples 1 -o locked/0.exr\n"
           "run render quads.gltf --size 16x12 --samples 1 -o a.exr --cache-dir locked\n"
           "run capture shot.json --range 0:1 -o 'locked/#.exr'\n"
           "run merge locked/0.exr -o locked/1.exr\n"
           "run bench popping quads.gltf --size 16x12 --counts 2 --frames 2 --path-frames 6 -o locked "
           "--allow-changed\n";
    const std::string command = "cd '" + folder().string() + "' && XDG_CACHE_HOME='" +
                                cacheFolder().parent_path().string() +
                                "' unshare --map-root-user --user --mount sh inside.sh > out 2>&1";
    if (std::system(command.c_str()) != 0) GTEST_SKIP() << "nothing can be mounted here (unshare)";
    std::vector<std::string> lines;
    std::ifstream file(folder() / "out");
    for (std::string line; std::getline(file, line);)
        if (!withoutProgress(line + "\n").empty()) lines.push_back(line);
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    int codes = 0;
    bool lastWasCode = true;
    for (const std::string& line : lines) {
        const bool code = line.starts_with("code ");
        codes += code ? 1 : 0;
        if (code) {
            EXPECT_TRUE(line == "code 1" || line == "code 0") << all;
        } else {
            EXPECT_TRUE(lastWasCode) << "more than one line\n" << all;
            EXPECT_NE(line.find("ead-only"), std::string::npos) << all;
        }
        lastWasCode = code;
    }
    EXPECT_EQ(codes, 5) << all;
}

}  // namespace
}  // namespace defocus::engine
