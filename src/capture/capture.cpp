#include "capture/capture.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "capture/frame_files.h"
#include "core/error.h"
#include "core/file.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "frame/report/layer_file.h"
#include "frame/report/render_report.h"
#include "frame/setup/exposure.h"
#include "image/image_rows.h"
#include "image/time_code.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// Returns the file for a range of a frame's samples: frames/0012.exr → frames/0012.part00064-00128.exr.
fs::path partPath(const fs::path& frame, const SampleRange& range) {
    fs::path path = frame;
    path.replace_extension(fmt::format("part{:05}-{:05}.exr", range.first, range.end));
    return path;
}

std::string encodingOf(const std::string& pattern, const Request& request, const WriteOptions& write, bool metered) {
    const std::string ending = fs::path(pattern).extension().string();
    const bool renamed = !request.layers.empty() && request.exrNames != ExrNames{};
    if (isExr(pattern)) return renamed ? "names of other channels" : "";
    const std::string exposure = metered ? "metered" : fmt::format("{}", write.exposure);
    return fmt::format("{} {} {}", ending, static_cast<int>(write.toneMap), exposure);
}

FrameState partState(const fs::path& path, const std::string& settings) {
    try {
        return readPart(path).settings == settings ? FrameState::finished : FrameState::other;
    } catch (const Error&) {
        return FrameState::missing;
    }
}

struct FrameTimes {
    double planMilliseconds = 0;
    double renderMilliseconds = 0;
    double writeMilliseconds = 0;  // time for encoding and writing the files
};

void appendTimes(const FilmOptions& options, std::uint64_t memoryLimit, const FilmFrame& film, const FrameMoment& frame,
                 const RenderStats& stats, const FrameTimes& times) {
    nlohmann::ordered_json line = {{"frame", film.frame},
                                   {"file", film.files.front().string()},
                                   {"time", frame.time},
                                   {"planMilliseconds", times.planMilliseconds},
                                   {"renderMilliseconds", times.renderMilliseconds},
                                   {"writeMilliseconds", times.writeMilliseconds},
                                   {"trianglesDrawn", stats.trianglesDrawn},
                                   {"samples", stats.samples},
                                   {"wave", stats.wave},
                                   {"memoryLimit", memoryLimit},
                                   {"device", stats.device}};
    if (stats.estimatedError) line["estimatedError"] = *stats.estimatedError;
    const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(options.timings.c_str(), "ab"), &std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fflush(file.get()) != 0)
        fail("cannot write {}", options.timings.string());
}

// The result of drawing a frame. Another thread writes the frame's files while the driver draws the next frame.
struct DrawnFrame {
    FrameMoment moment;
    Image image;  // image of an untiled frame
    std::optional<LayerImages> layers;
    std::shared_ptr<const Scene> scene;
    FramePart part;  // partial sums; set if only some of the samples are drawn
    Metadata metadata;
    RenderStats stats;
    FrameTimes times;
    bool written = false;  // true: the frame was drawn in tiles, which have already been written to its files
};

// Returns the metadata of a frame: that of `defocus render`, without values that differ from run to run.
Metadata frameMetadata(const Shot& shot, const FilmFrame& film, RenderReport report) {
    report.exposure = film.write.exposure;
    Metadata metadata = renderMetadata(report);
    metadata.erase("defocus:seconds");
    metadata["capDate"] = std::string();  // no date; otherwise, the image library would insert the current time
    metadata["defocus:frame"] = film.frame;
    metadata["defocus:frameRate"] = shot.frameRate;
    metadata["framesPerSecond"] = rationalFrameRate(shot.frameRate);
    if (const auto code = timeCodeOfFrame(film.frame, shot.frameRate)) metadata["timeCode"] = *code;
    return metadata;
}

// Returns the metadata for the file with index `file` of a frame: the metadata `ofFrame` with the file's settings hash.
Metadata fileMetadata(const FilmFrame& film, std::size_t file, const Metadata& ofFrame) {
    Metadata metadata = ofFrame;
    metadata[settingsAttribute] = film.settings[file];
    const std::string ending = film.files[file].extension().string();
    if (ending != ".exr" && ending != ".png")
        metadata["comments"] = film.settings[file];  // "comments" is the only text attribute that JPEG files keep
    return metadata;
}

void writeFrame(const FilmFrame& film, DrawnFrame& drawn, const FilmOptions& options, std::uint64_t memoryLimit) {
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 0; i < film.files.size(); ++i) {
        const fs::path& path = film.files[i];
        if (options.sampleRange) {
            drawn.part.settings = film.settings[i];
            writePart(path, drawn.part);
            continue;
        }
        writePicture(path, drawn.image, drawn.layers ? &*drawn.layers : nullptr, *drawn.scene, drawn.moment.pose,
                     options.settings.request.exrNames, fileMetadata(film, i, drawn.metadata), film.write);
    }
    drawn.times.writeMilliseconds = millisecondsSince(start);
    appendTimes(options, memoryLimit, film, drawn.moment, drawn.stats, drawn.times);
}

// Writes a frame that is drawn in tiles to its files, row by row.
class RowsToFiles {
public:
    RowsToFiles(const FilmFrame& film, std::function<Metadata()> metadata)
        : film_(film), metadata_(std::move(metadata)) {}

    void take(Image&& rows, int width, int height) {
        const Clock::time_point start = Clock::now();
        if (writers_.empty()) {
            const Metadata ofFrame = metadata_();
            for (std::size_t i = 0; i < film_.files.size(); ++i)
                writers_.emplace_back(film_.files[i], width, height, rows.channels, fileMetadata(film_, i, ofFrame),
                                      film_.write);
        }
        for (ImageRowWriter& writer : writers_) writer.write(rows);
        milliseconds_ += millisecondsSince(start);
    }
    // Completes the files. Returns the total writing time, ms.
    double finish() {
        const Clock::time_point start = Clock::now();
        for (ImageRowWriter& writer : writers_) writer.finish();
        return milliseconds_ + millisecondsSince(start);
    }

private:
    const FilmFrame& film_;
    std::function<Metadata()> metadata_;
    std::vector<ImageRowWriter> writers_;
    double milliseconds_ = 0;
};

// Draws a frame, or a range of its samples.
DrawnFrame drawFrame(const Shot& shot, const FilmFrame& film, FrameMoment moment, SceneDriver& driver,
                     const FilmOptions& options, const std::function<void(double)>& step) {
    const Clock::time_point start = Clock::now();
    driver.pose(options.settings.request, moment);
    RowsToFiles rows(film, [&] { return frameMetadata(shot, film, driver.report()); });
    FrameParts parts{.samples = options.sampleRange};
    if (!options.sampleRange)
        parts.takeRows = [&](const RowRange&, Image&& pixels) {
            rows.take(std::move(pixels), moment.view.width, moment.view.height);
        };
    driver.start(parts);
    FrameDriver& frame = driver.driver();
    do {
        step(frame.share());
    } while (driver.advance());

    DrawnFrame drawn;
    drawn.written = frame.inTiles();
    drawn.stats = driver.stats();
    if (options.sampleRange) {
        drawn.part = frame.sums();
        drawn.stats.samples = drawn.part.frameSamples;
    } else if (!drawn.written) {
        drawn.image = driver.image();
        drawn.layers = driver.layerImages();
    }
    drawn.times.planMilliseconds = frame.planMilliseconds();
    drawn.times.renderMilliseconds = millisecondsSince(start);
    drawn.metadata = frameMetadata(shot, film, driver.report(frame.plan(), drawn.stats));
    drawn.part.metadata = drawn.metadata;
    if (drawn.written) {
        drawn.times.writeMilliseconds = rows.finish();
        drawn.times.renderMilliseconds -= drawn.times.writeMilliseconds;
    }
    drawn.moment = std::move(moment);
    drawn.scene = driver.frame().scene;
    if (drawn.written) appendTimes(options, frame.memoryLimit(), film, drawn.moment, drawn.stats, drawn.times);
    return drawn;
}

// Computes a frame of `run` from the run's lens images (one image per lens sample).
DrawnFrame refocusFrame(const Shot& shot, const FilmFrame& film, const RefocusRun& run, FrameMoment moment,
                        SceneDriver& driver, RefocusedPictures& pictures, const FilmOptions& options,
                        const std::function<void(double)>& step) {
    const Clock::time_point start = Clock::now();
    const Request& request = options.settings.request;
    RefocusedPictures::Picture picture = pictures.picture(run, request, moment, driver, step);
    driver.pose(request, moment);
    DrawnFrame drawn;
    drawn.image = std::move(picture.image);
    drawn.stats = driver.stats();
    drawn.stats.samples = picture.samples;
    drawn.stats.trianglesDrawn = picture.rendered ? picture.plan.trianglesDrawn : 0;
    drawn.times.planMilliseconds = picture.rendered ? driver.driver().planMilliseconds() : 0;
    drawn.times.renderMilliseconds = millisecondsSince(start);
    drawn.metadata = frameMetadata(shot, film, driver.report(picture.plan, drawn.stats));
    drawn.moment = std::move(moment);
    drawn.scene = driver.frame().scene;
    return drawn;
}

// Returns a line such as "frame 12, 3400 ms and 18.2 M triangles per frame".
std::string stageText(int frame, const FilmFigures& figures, double milliseconds) {
    if (figures.rendered == 0) return fmt::format("frame {}", frame);
    return fmt::format("frame {}, {:.0f} ms and {:.2f} M triangles per frame", frame, milliseconds / figures.rendered,
                       static_cast<double>(figures.triangles) * 1e-6 / figures.rendered);
}

FilmFrame filmFrame(const Shot& shot, const SequenceBase& base, int number, const FilmOptions& options) {
    const FrameMoment frame = frameAt(shot, base, number);
    FilmFrame film;
    film.frame = number;
    film.finished = options.resume;
    const Request& request = options.settings.request;
    film.write = {request.toneMap, unmeteredExposure(request, frame.view.lens)};
    for (const std::string& pattern : options.outputs) {
        FilmSettings settings = options.settings;
        settings.encoding = encodingOf(pattern, request, film.write, options.metered);
        if (const RefocusRun* const run = runOf(options.runs, number)) settings.lensImages = run->text();
        film.settings.push_back(settingsHash(settings, frame));
        fs::path path = framePath(pattern, number);
        if (options.sampleRange) path = partPath(path, *options.sampleRange);
        if (options.resume) {
            const FrameState state = options.sampleRange
                                         ? partState(path, film.settings.back())
                                         : frameState(path, frame.view.width, frame.view.height, film.settings.back());
            film.finished = film.finished && state == FrameState::finished;
            if (state == FrameState::other && film.other.empty()) film.other = path;
        }
        film.files.push_back(std::move(path));
    }
    return film;
}

}  // namespace

fs::path timingsPath(const std::string& pattern, int shard, int shards) {
    const fs::path path(pattern);
    std::string stem = path.stem().string();
    std::erase(stem, '#');
    const std::string part = shards > 1 ? fmt::format(".{}-of-{}", shard, shards) : "";
    return path.parent_path() / (stem + "timings" + part + ".jsonl");
}

std::vector<FilmFrame> filmFrames(const Shot& shot, const SequenceBase& base, const std::vector<int>& frames,
                                  const FilmOptions& options, const Progress& progress) {
    std::vector<FilmFrame> film(frames.size());
    std::vector<std::exception_ptr> faults(frames.size());
    std::mutex reporting;
    std::uint64_t done = 0;
    parallelFor(frames.size(), [&](std::size_t i) {
        try {
            film[i] = filmFrame(shot, base, frames[i], options);
        } catch (const Error&) {
            faults[i] = std::current_exception();
        }
        const std::lock_guard lock(reporting);
        report(progress, "frames checked", ++done, frames.size());
    });
    // Throw the exception of the faulty frame that comes first in the shot.
    for (const std::exception_ptr& fault : faults)
        if (fault) std::rethrow_exception(fault);
    return film;
}

FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, SceneDriver& driver,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options,
                       const std::function<bool()>& stop, const Progress& progress) {
    std::error_code ignored;
    if (!options.resume) fs::remove(options.timings, ignored);  // delete the timings file of an earlier run

    // Draw one frame after another while another thread encodes and writes the previous one.
    const Clock::time_point start = Clock::now();
    FilmFigures figures;
    std::future<void> writing;
    RefocusedPictures pictures;
    const auto wanted = std::ranges::count(frames, false, &FilmFrame::finished);
    const auto total = static_cast<double>(std::max(wanted, std::ptrdiff_t{1}));
    for (const FilmFrame& film : frames) {
        if (film.finished) {
            ++figures.finishedBefore;
            continue;
        }
        if (stop()) {
            figures.stoppedBefore = film.frame;
            break;
        }
        const std::string stage = stageText(film.frame, figures, millisecondsSince(start));
        const auto step = [&](double share) {
            report(progress, stage, static_cast<std::uint64_t>(1000 * (figures.rendered + share)),
                   static_cast<std::uint64_t>(1000 * total));
        };
        FrameMoment moment = frameAt(shot, base, film.frame);
        const RefocusRun* const run = runOf(options.runs, film.frame);
        const auto drawn = std::make_shared<DrawnFrame>(
            run != nullptr ? refocusFrame(shot, film, *run, std::move(moment), driver, pictures, options, step)
                           : drawFrame(shot, film, std::move(moment), driver, options, step));
        ++figures.rendered;
        if (run != nullptr) {
            ++figures.refocused;
            if (drawn->stats.trianglesDrawn > 0) figures.lensImages += run->samples;
        }
        const FrameDriver& frame = driver.driver();
        figures.tiles = frame.tiles();
        figures.renderMilliseconds += drawn->times.renderMilliseconds;
        figures.triangles += drawn->stats.trianglesDrawn;
        if (options.frameDrawn && run == nullptr) options.frameDrawn(film.frame, frame.plan());
        if (figures.rendered == 1 && options.firstDrawn && !drawn->image.empty())
            options.firstDrawn(drawn->image, film.write);
        const auto write = [drawn, &film, &options, limit = frame.memoryLimit()] {
            writeFrame(film, *drawn, options, limit);
        };
        if (writing.valid()) writing.get();  // rethrows the exception of a failed write
        if (frame.crowded() && !drawn->written)
            write();
        else if (!drawn->written)
            writing = std::async(std::launch::async, write);
    }
    if (writing.valid()) writing.get();
    figures.totalMilliseconds = millisecondsSince(start);
    return figures;
}

}  // namespace defocus::engine
