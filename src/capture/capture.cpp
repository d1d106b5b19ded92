#include "capture/capture.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "capture/frame_files.h"
#include "capture/frame_writer.h"
#include "capture/tile_files.h"
#include "core/error.h"
#include "core/file.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "frame/tiled_frame.h"
#include "image/image_rows.h"
#include "lens/photographic_exposure.h"
#include "plan/frame_plan.h"
#include "render/frame_run.h"

namespace defocus {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t framesWaiting = 2;  // for the writer; more would only take memory

// frames/0012.exr → frames/0012.part00064-00128.exr
fs::path partPath(const fs::path& frame, const SampleRange& range) {
    fs::path path = frame;
    path.replace_extension(fmt::format("part{:05}-{:05}.exr", range.first, range.end));
    return path;
}

std::string encodingOf(const std::string& pattern, const WriteOptions& write, bool metered) {
    const std::string ending = fs::path(pattern).extension().string();
    if (ending == ".exr" || ending == ".EXR") return "";
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

// ---- sidecar
// ---------------------------------------------------------------------------------------------------------

struct FrameTimes {
    double planMilliseconds = 0;
    double renderMilliseconds = 0;
    double writeMilliseconds = 0;  // encoding included
};

void appendTimes(const FilmOptions& options, const FilmFrame& film, const SequenceFrame& frame,
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
                                   {"memoryLimit", options.memoryLimit},
                                   {"device", stats.device}};
    if (stats.estimatedError) line["estimatedError"] = *stats.estimatedError;
    const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(options.timings.c_str(), "ab"), &std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fflush(file.get()) != 0)
        fail("{}: cannot be written", options.timings.string());
}

// ---- one frame
// -------------------------------------------------------------------------------------------------------

// What the writer needs of a frame; the renderer goes on meanwhile.
struct DrawnFrame {
    SequenceFrame frame;
    Image image;
    FramePart part;
    Metadata metadata;
    RenderStats stats;
    FrameTimes times;
};

void takeMoment(World& world, const SequenceFrame& frame) {
    world.pose = frame.pose;
    world.shutter = frame.shutter;
    world.lights = frame.lights;
}

RenderSettings settingsOf(const SequenceFrame& frame, const FilmOptions& options) {
    RenderSettings settings = frame.settings;
    if (options.automatic) settings.sampleCount = automaticSamples;
    return settings;
}

DrawnFrame drawFrame(SequenceFrame frame, World& world, Renderer& renderer, const FilmOptions& options,
                     const FilmMetadata& metadata, const std::function<void(double)>& step) {
    const Clock::time_point start = Clock::now();
    takeMoment(world, frame);
    DrawnFrame drawn;
    FramePlan plan;

    // The whole frame, or some of its samples.
    if (options.sampleRange) {
        plan = planFrame(world, frame.view, frame.settings);
        drawn.times.planMilliseconds = millisecondsSince(start);
        drawn.part = renderPart(renderer, plan, *options.sampleRange, [&] { step(0.5); });
        drawn.stats = renderer.stats();
        drawn.stats.samples = drawn.part.frameSamples;
    } else {
        FrameRun run(world, renderer);
        run.start(frame.view, settingsOf(frame, options), options.stop);
        drawn.times.planMilliseconds = run.planMilliseconds();
        do {
            step(static_cast<double>(run.samples()) / run.sampleTotal());
        } while (run.advance());
        drawn.image = renderer.image();
        drawn.stats = run.stats();
        plan = run.plan();
    }
    drawn.frame = std::move(frame);
    drawn.times.renderMilliseconds = millisecondsSince(start);
    drawn.metadata = metadata(drawn.frame, plan, drawn.stats);
    drawn.part.metadata = drawn.metadata;
    return drawn;
}

// Of a file of the frame: all that its frame has, and what it is made of.
Metadata fileMetadata(const FilmFrame& film, std::size_t file, const Metadata& ofFrame) {
    Metadata metadata = ofFrame;
    metadata[settingsAttribute] = film.settings[file];
    const std::string ending = film.files[file].extension().string();
    if (ending != ".exr" && ending != ".png") metadata["comments"] = film.settings[file];  // all that a JPEG holds
    return metadata;
}

void writeFrame(const FilmFrame& film, DrawnFrame& drawn, const FilmOptions& options) {
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 0; i < film.files.size(); ++i) {
        const fs::path& path = film.files[i];
        if (options.sampleRange) {
            drawn.part.settings = film.settings[i];
            writePart(path, drawn.part);
            continue;
        }
        writeImage(path, drawn.image, fileMetadata(film, i, drawn.metadata), film.write);
    }
    drawn.times.writeMilliseconds = millisecondsSince(start);
    appendTimes(options, film, drawn.frame, drawn.stats, drawn.times);
}

// ---- what fits
// -------------------------------------------------------------------------------------------------------

// How the frames of a film fit into memory, by its first one: all have the same size.
struct FilmMemory {
    bool alone = false;  // one piece, once the frames before are written
    Tiling tiles;        // no bands: in one piece
};

FilmMemory memoryOf(const SequenceFrame& frame, World& world, Renderer& renderer, const FilmOptions& options) {
    FilmMemory memory;
    if (!options.method->needsGl) return memory;
    takeMoment(world, frame);
    const FramePlan plan = planOfTiles(world, frame.view, settingsOf(frame, options));
    Request request = options.settings.request;
    request.stop = options.stop;
    if (mustDrawInTiles(world, plan, request, *options.method, options.memoryLimit)) {
        if (options.sampleRange) refuseTiles(plan, options.memoryLimit, "--sample-range keeps sums of the whole image");
        memory.tiles = chosenTiling(measuredNeeds(world, plan, request, renderer, options.memoryLimit));
        renderer.setWave(memory.tiles.wave);
        return memory;
    }
    TilingNeeds needs = needsBeforeUpload(world, plan, request, options.memoryLimit);
    const std::uint64_t pixels = std::uint64_t(plan.view.width) * std::uint64_t(plan.view.height);
    needs.keptBytes = (framesWaiting + 1) * pixels * bandPixelBytes;
    if (request.memory) renderer.setWave(waveWithin(needs));
    memory.alone = request.memory && !fitsInOnePiece(needs);
    return memory;
}

// Draws the frame and writes it row by row: no more of it is ever in memory.
DrawnFrame filmInTiles(const FilmFrame& film, SequenceFrame frame, World& world, Renderer& renderer,
                       const Tiling& tiling, const FilmOptions& options, const FilmMetadata& metadata,
                       const std::function<void(double)>& step) {
    const Clock::time_point start = Clock::now();
    takeMoment(world, frame);
    const FramePlan plan = planOfTiles(world, frame.view, settingsOf(frame, options));
    DrawnFrame drawn;
    drawn.times.planMilliseconds = millisecondsSince(start);
    TileRun run{.renderer = renderer, .plan = plan, .metadata = {}};
    run.step = [&](double rows) { step(rows / plan.view.height); };
    std::vector<ImageRowWriter> writers;
    for (const Band& band : tiling.bands) {
        const Image rows = drawnBand(band, run, band.rows.first);
        drawn.times.renderMilliseconds = millisecondsSince(start) - drawn.times.writeMilliseconds;
        const Clock::time_point writing = Clock::now();
        if (writers.empty()) {
            drawn.metadata = metadata(frame, plan, run.stats);
            for (std::size_t i = 0; i < film.files.size(); ++i)
                writers.emplace_back(film.files[i], plan.view.width, plan.view.height, rows.channels,
                                     fileMetadata(film, i, drawn.metadata), film.write);
        }
        for (ImageRowWriter& writer : writers) writer.write(rows);
        if (&band == &tiling.bands.back())
            for (ImageRowWriter& writer : writers) writer.finish();
        drawn.times.writeMilliseconds += millisecondsSince(writing);
    }
    drawn.stats = run.stats;
    drawn.frame = std::move(frame);
    appendTimes(options, film, drawn.frame, drawn.stats, drawn.times);
    return drawn;
}

// ---- progress
// --------------------------------------------------------------------------------------------------------

// "frame 12, 3400 ms and 18.2 M triangles each"
std::string stageText(int frame, const FilmFigures& figures, double milliseconds) {
    if (figures.rendered == 0) return fmt::format("frame {}", frame);
    return fmt::format("frame {}, {:.0f} ms and {:.2f} M triangles each", frame, milliseconds / figures.rendered,
                       static_cast<double>(figures.triangles) * 1e-6 / figures.rendered);
}

// ---- what is there
// ---------------------------------------------------------------------------------------------------

FilmFrame filmFrame(const Shot& shot, const SequenceBase& base, int number, const FilmOptions& options) {
    const SequenceFrame frame = frameAt(shot, base, number);
    FilmFrame film;
    film.frame = number;
    film.finished = options.resume;
    film.write = {options.toneMap, options.exposure.value_or(photographicExposure(frame.view.lens))};
    for (const std::string& pattern : options.outputs) {
        FilmSettings settings = options.settings;
        settings.encoding = encodingOf(pattern, film.write, options.metered);
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
    // Of several faulty frames the first is told, whichever was looked at first.
    for (const std::exception_ptr& fault : faults)
        if (fault) std::rethrow_exception(fault);
    return film;
}

FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, World& world, Renderer& renderer,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options, const FilmMetadata& metadata,
                       const std::function<bool()>& stop, const Progress& progress) {
    // What an earlier run left; its times are kept only where its frames are.
    std::vector<fs::path> files;
    int wanted = 0;
    for (const FilmFrame& film : frames) {
        files.insert(files.end(), film.files.begin(), film.files.end());
        wanted += film.finished ? 0 : 1;
    }
    removeUnfinished(files);
    std::error_code ignored;
    if (!options.resume) fs::remove(options.timings, ignored);

    // Frame after frame; the writer works on those before.
    const Clock::time_point start = Clock::now();
    FilmFigures figures;
    FrameWriter writer(framesWaiting);
    std::optional<FilmMemory> memory;
    const auto total = static_cast<double>(std::max(wanted, 1));
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
        SequenceFrame frame = frameAt(shot, base, film.frame);
        if (!memory) memory = memoryOf(frame, world, renderer, options);
        const bool tiles = !memory->tiles.bands.empty();
        auto drawn = std::make_shared<DrawnFrame>(
            tiles ? filmInTiles(film, std::move(frame), world, renderer, memory->tiles, options, metadata, step)
                  : drawFrame(std::move(frame), world, renderer, options, metadata, step));
        ++figures.rendered;
        figures.renderMilliseconds += drawn->times.renderMilliseconds;
        figures.triangles += drawn->stats.trianglesDrawn;
        if (figures.rendered == 1 && options.firstDrawn && !options.sampleRange && !tiles)
            options.firstDrawn(drawn->image, film.write);
        if (memory->alone)
            writeFrame(film, *drawn, options);
        else if (!tiles)
            writer.add([drawn, &film, &options] { writeFrame(film, *drawn, options); });
    }
    writer.finish();
    figures.totalMilliseconds = millisecondsSince(start);
    if (memory) {
        int tiles = 0;
        for (const Band& band : memory->tiles.bands) tiles += static_cast<int>(band.tiles.size());
        figures.tiles = std::max(tiles, 1);
    }
    return figures;
}

}  // namespace defocus
