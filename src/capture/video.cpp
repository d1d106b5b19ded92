#include "capture/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "capture/frame_files.h"
#include "core/error.h"
#include "core/file.h"
#include "core/source_date.h"
#include "image/quantise.h"
#include "image/tone_map.h"

extern char** environ;  // NOLINT: POSIX requires this declaration

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// ffmpeg's encoder options by file extension. CRF 18 of H.264 is visually lossless.
const std::vector<std::pair<std::string, std::vector<std::string>>>& encoders() {
    static const std::vector<std::pair<std::string, std::vector<std::string>>> table = {
        {".mp4", {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"}},
        {".mov", {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"}},
        {".mkv", {"-c:v", "libx264", "-crf", "18"}},
        {".webm", {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"}},
        // Use one palette for the complete video, and ordered dithering, which doesn't flicker.
        {".gif", {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer"}},
    };
    return table;
}

// Returns ffmpeg's options for 4:2:0 video in BT.709 colours with limited range, with the tags that declare them.
// Without tags, players choose a colour matrix by the size of the video. 4:2:0 plays everywhere but needs an even width
// and height. If the width or height is odd, the last column or row is repeated.
std::vector<std::string> bt709(int width, int height) {
    const std::string filters = fmt::format(
        "format=gbrp,pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right={}:bottom={},"
        "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int",
        width % 2, height % 2);
    return {"-vf",        filters, "-pix_fmt",    "yuv420p", "-color_primaries", "bt709",
            "-color_trc", "bt709", "-colorspace", "bt709",   "-color_range",     "tv"};
}

const std::vector<std::string>& encoderOf(const fs::path& path) {
    const std::string ending = path.extension().string();
    std::string known;
    for (const auto& [name, options] : encoders()) {
        if (name == ending) return options;
        known += (known.empty() ? "" : ", ") + name;
    }
    fail("{}: unknown video type \"{}\"; use one of {}", path.string(), ending, known);
}

bool isInstalled(const std::string& program) {
    const char* folders = std::getenv("PATH");
    std::string rest = folders == nullptr ? "" : folders;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (::access((fs::path(rest.substr(0, end)) / program).c_str(), X_OK) == 0) return true;
        rest.erase(0, end + 1);
    }
    return false;
}

// Adds ffmpeg's prefix for files; without the prefix, ffmpeg would read "12:30.mp4" as a protocol.
std::string fileName(const fs::path& path) {
    return "file:" + path.string();
}

// Runs ffmpeg with a pipe to its standard input. ffmpeg's output and messages go to files.
class Ffmpeg {
public:
    Ffmpeg(const std::vector<std::string>& arguments, const fs::path& output, const fs::path& messages) {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot start ffmpeg: cannot create a pipe");
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_TRUNC, 0);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        std::vector<std::string> words = arguments;
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        const int fault = ::posix_spawnp(&process_, "ffmpeg", &actions, nullptr, pointers.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        ::close(ends[0]);
        input_ = ends[1];
        if (fault != 0) {
            ::close(input_);
            fail("cannot start ffmpeg: {}", std::generic_category().message(fault));
        }
    }
    ~Ffmpeg() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        close();
    }
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;

    // Writes to ffmpeg's input. Returns false if ffmpeg has closed its end of the pipe.
    bool write(const std::vector<std::uint8_t>& bytes) const {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::write(input_, bytes.data() + done, bytes.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            done += static_cast<std::size_t>(count);
        }
        return true;
    }

    // Closes the pipe and waits until ffmpeg ends. Returns whether ffmpeg succeeded.
    bool close() {
        ::close(input_);
        while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
    }
    // Returns the signal that ended ffmpeg as text; empty if none did. Valid after close().
    [[nodiscard]] std::string signalText() const {
        if (!WIFSIGNALED(status_)) return "";
        const int signal = WTERMSIG(status_);
        return fmt::format("was terminated by signal {} ({})", signal, ::strsignal(signal));
    }

private:
    pid_t process_ = -1;
    int input_ = -1;
    int status_ = 0;
};

std::vector<std::uint8_t> displayBytes(const VideoFrame& frame, const Image& first) {
    const fs::path& path = frame.file;
    Image image = readImage(path);
    if (image.width != first.width || image.height != first.height)
        fail("{} is {}x{} px, but all frames must have the size of the first frame, {}x{} px", path.string(),
             image.width, image.height, first.width, first.height);
    // Images read from PNG and JPEG are already tone-mapped, so only the display encoding is applied.
    const bool linear = isExr(path);
    image = linear ? displayEncoded(image, frame.image.toneMap, frame.image.exposure) : displayEncoded(image);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::vector<std::uint8_t> own = quantised(image);
    for (std::size_t i = 0; i < own.size(); i += channels)
        for (std::size_t c = 0; c < 3; ++c) bytes.push_back(own[i + std::min(c, channels - 1)]);
    return bytes;
}

std::string lastLine(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.find_last_of("\r\n") + 1);
}

// Returns the reason why ffmpeg failed: the signal that ended it, its last message, or a generic message if it printed
// none.
std::string complaint(const Ffmpeg& ffmpeg, const fs::path& messages) {
    if (const std::string signal = ffmpeg.signalText(); !signal.empty()) return "ffmpeg " + signal;
    const std::string said = lastLine(readText(messages));
    return said.empty() ? "ffmpeg failed without a message" : "ffmpeg says: " + said;
}

// Throws Error unless the video is readable and has all its frames. On a full disk, ffmpeg reports success but leaves
// an incomplete video.
void checkFilm(const fs::path& film, std::size_t frames, const fs::path& name) {
    PendingFile messages(name.string() + ".log");  // temporary log of ffmpeg, deleted at the end of this function
    PendingFile counted(name.string() + ".count");
    Ffmpeg ffmpeg({"ffmpeg", "-v", "error", "-nostdin", "-i", fileName(film), "-map", "0:v:0", "-c", "copy", "-f",
                   "null", "-progress", "pipe:1", "-"},
                  counted.temporaryPath(), messages.temporaryPath());
    if (!ffmpeg.close())
        fail("cannot write {} (is the disk full?): the video cannot be read back: {}", name.string(),
             complaint(ffmpeg, messages.temporaryPath()));
    const std::string progress = readText(counted.temporaryPath());
    constexpr std::string_view key = "frame=";
    const std::size_t last = progress.rfind(key);
    const std::size_t found =
        last == std::string::npos ? 0 : std::strtoull(progress.c_str() + last + key.size(), nullptr, 10);
    if (found != frames)
        fail("cannot write {} (is the disk full?): the video has {} of {} frames", name.string(), found, frames);
}

}  // namespace

void checkVideo(const fs::path& path) {
    static_cast<void>(encoderOf(path));
    if (!isInstalled("ffmpeg"))
        fail(
            "{}: video requires the program ffmpeg, which is not installed (Debian: apt install ffmpeg); without "
            "--video, only the frames are rendered",
            path.string());
    checkWritable(path);
}

void writeVideo(const fs::path& path, const std::vector<VideoFrame>& frames, double frameRate,
                const Progress& progress) {
    if (frames.empty()) fail("{}: a video needs at least one frame", path.string());
    const Image first = readImage(frames.front().file);
    const fs::path log = path.string() + ".log";
    PendingFile film(path);
    PendingFile messages(log);

    std::vector<std::string> arguments = {"ffmpeg",      "-y",
                                          "-v",          "error",
                                          "-f",          "rawvideo",
                                          "-pix_fmt",    "rgb24",
                                          "-video_size", fmt::format("{}x{}", first.width, first.height),
                                          "-framerate",  fmt::format("{}", frameRate),
                                          "-i",          "-"};
    if (path.extension() != ".gif") std::ranges::copy(bt709(first.width, first.height), std::back_inserter(arguments));
    const std::vector<std::string>& encoder = encoderOf(path);
    arguments.insert(arguments.end(), encoder.begin(), encoder.end());
    if (sourceDate()) arguments.insert(arguments.end(), {"-fflags", "+bitexact"});  // omits random identifiers
    arguments.push_back(fileName(film.temporaryPath()));

    // Write the frames in order. When ffmpeg fails, it closes the pipe; SIGPIPE is ignored so that this program can
    // report ffmpeg's message.
    const auto previous = std::signal(SIGPIPE, SIG_IGN);
    Ffmpeg ffmpeg(arguments, "/dev/null", messages.temporaryPath());
    bool listening = true;
    for (std::size_t i = 0; i < frames.size() && listening; ++i) {
        report(progress, "film", i, frames.size());
        listening = ffmpeg.write(displayBytes(frames[i], first));
    }
    const bool finished = ffmpeg.close();
    std::signal(SIGPIPE, previous);
    if (!finished || !listening)
        fail("cannot write {}: {}", path.string(), complaint(ffmpeg, messages.temporaryPath()));
    checkFilm(film.temporaryPath(), frames.size(), path);
    film.commit();
}

}  // namespace defocus::engine
