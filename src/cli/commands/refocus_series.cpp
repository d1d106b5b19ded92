#include "cli/commands/refocus_series.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "capture/video.h"
#include "cli/options/image_output.h"
#include "core/error.h"
#include "core/message.h"
#include "core/parse.h"
#include "core/stopwatch.h"
#include "refocus/focal_stack.h"

namespace defocus::engine {

namespace {

// Temporary folder beside a file. The destructor removes the folder and its content.
class FrameFolder {
public:
    explicit FrameFolder(const std::filesystem::path& file) : path_(file) {
        path_ += fmt::format(".frames-{}", ::getpid());
        std::filesystem::create_directory(path_);
    }
    ~FrameFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;

    [[nodiscard]] std::filesystem::path frame(int index) const { return path_ / fmt::format("{:05}.png", index); }

private:
    std::filesystem::path path_;
};

}  // namespace

void parseFocusPull(const std::string& text, FocusPullFilm& pull) {
    const std::vector<std::string> parts = splitAt(text, ':');
    if (parts.size() != 2) fail("'{}' is not a pair A:B of distances in m, such as 1.2:4", text);
    const Range metres{1e-6, 1e12};
    pull.from = parseNumber(parts[0], metres);
    pull.to = parseNumber(parts[1], metres);
}

void writeFocusPull(LightField& field, const Refocusing& refocusing, const FocusPullFilm& pull,
                    const WriteOptions& write, const GlobalOptions& global) {
    const Clock::time_point start = Clock::now();
    for (const double distance : {pull.from, pull.to}) {
        Refocusing end = refocusing;
        end.focusDistance = distance;
        static_cast<void>(shiftedImages(field.info(), end, field.name()));  // throws for an unsupported distance
    }
    checkVideo(pull.video);
    field.keepImages();
    const FrameFolder folder(pull.video);
    std::vector<VideoFrame> frames;
    Progress progress = terminalProgress(global);
    for (int i = 0; i < pull.frames; ++i) {
        Refocusing frame = refocusing;
        frame.focusDistance = distanceAt(pull.from, pull.to, i, pull.frames);
        frames.push_back({folder.frame(i), {}});  // PNG files already have display values
        writeImage(frames.back().file, refocused(field, frame), Metadata(), write);
        report(progress, "frames", static_cast<std::uint64_t>(i) + 1, static_cast<std::uint64_t>(pull.frames));
    }
    const double seconds = millisecondsSince(start) / 1000;
    writeVideo(pull.video, frames, pull.frameRate, progress);
    progress = {};
    if (!global.quiet)
        printMessage("{}: {} frames from {} lens images in {:.2f} s\n", pull.video.string(), pull.frames,
                     field.info().points.size(), seconds);
}

std::filesystem::path stackPath(const std::filesystem::path& output, const std::string& name) {
    std::filesystem::path path = output;
    return path.replace_extension(name + output.extension().string());
}

void writeFocalStack(LightField& field, const Refocusing& refocusing, int pictures, const std::filesystem::path& output,
                     const WriteOptions& write, const GlobalOptions& global) {
    const Clock::time_point start = Clock::now();
    if (isStandardOutput(output))
        throw UsageError("--stack writes several files, not to standard output; give a file name with -o");
    field.keepImages();
    Progress progress = terminalProgress(global);
    const FocusRange& range = field.info().range;
    const std::vector<double> distances = stackDistances(range, pictures);
    for (int i = 0; i < pictures; ++i) {
        Refocusing picture = refocusing;
        picture.focusDistance = distances[static_cast<std::size_t>(i)];
        writeImage(stackPath(output, fmt::format("{:02}", i)), refocused(field, picture),
                   refocusedMetadata(field.info(), picture), write);
        report(progress, "images", static_cast<std::uint64_t>(i) + 1, static_cast<std::uint64_t>(pictures) + 1);
    }
    writeImage(stackPath(output, "sharp"), allInFocus(field), field.info().metadata, write);
    std::filesystem::path depth = stackPath(output, "depth");
    writeImage(depth.replace_extension("exr"), centralDepth(field), field.info().metadata);
    progress = {};
    if (!global.quiet)
        printMessage("{}, … {}, {}, {}: focus from {:.4g} to {:.4g} m, in {:.2f} s\n", stackPath(output, "00").string(),
                     stackPath(output, fmt::format("{:02}", pictures - 1)).string(),
                     stackPath(output, "sharp").string(), depth.string(), range.nearest, range.farthest,
                     millisecondsSince(start) / 1000);
}

}  // namespace defocus::engine
