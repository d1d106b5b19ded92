#include "frame/driver/frame_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "frame/setup/settings_hash.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

fs::path rowsPath(const fs::path& folder, const RowRange& rows) {
    return folder / fmt::format("rows-{:05}-{:05}.exr", rows.first, rows.end);
}

// Returns whether a directory entry may be a tile that this program wrote. Returns false for links and pipes.
bool canBeTile(const fs::directory_entry& entry) {
    std::error_code none;
    return entry.path().filename().string().starts_with("rows-") && fs::is_regular_file(entry.symlink_status(none));
}

struct FoundTiles {
    std::vector<RowFile> fitting;  // tiles with the requested settings and size, from top to bottom, without overlap
    std::vector<fs::path> all;
};

// Returns the tiles that an earlier run left in `folder`, and removes incomplete files of killed processes.
FoundTiles tilesIn(const fs::path& folder, const RowFileHeader& wanted) {
    FoundTiles found;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().filename().string().starts_with(".rows-")) removeAbandoned(entry.path());
        if (!canBeTile(entry) || !isRowFile(entry.path())) continue;
        found.all.push_back(entry.path());
        const RowFileHeader header = readRowHeader(entry.path());
        if (header.settings == wanted.settings && header.width == wanted.width && header.height == wanted.height)
            found.fitting.push_back({entry.path(), header});
    }
    std::ranges::sort(found.fitting, {}, [](const RowFile& file) { return file.header.rows.first; });
    std::erase_if(found.fitting, [end = 0](const RowFile& file) mutable {
        const bool overlaps = file.header.rows.first < end;
        if (!overlaps) end = file.header.rows.end;
        return overlaps;
    });
    return found;
}

}  // namespace

void FrameOutput::check(const FrameFiles& files, const Request& request) {
    const bool oneExr = files.outputs.size() == 1 && isExr(files.outputs.front());
    if (files.samples) {
        if (stopSettings(request).given())
            throw UsageError("--sample-range cannot be combined with --target-error or --time-limit; give --samples");
        if (!request.samples) throw UsageError("--sample-range requires a number of samples; give --samples");
        checkSampleRange(*files.samples, *request.samples);
        if (!oneExr || !files.untiledReason.empty())
            fail("--sample-range writes sums of samples to a single EXR file; give one output, such as -o part.exr");
    }
    if (files.keepPartial && (files.samples || files.share))
        throw UsageError("--keep-partial cannot be combined with --sample-range or --tile; leave one of them out");
    if (!files.share && !files.resume) return;
    const std::string option = files.share ? "--tile" : "--resume";
    const Method& method = *chosenMethod(request).method;
    if (!method.drawsTiles)
        throw UsageError(fmt::format("{}: method '{}' cannot draw tiles; choose accumulation", option, method.name));
    if (files.samples) throw UsageError(option + " cannot be combined with --sample-range; give only one of them");
    if (stopSettings(request).given())
        throw UsageError(option + " cannot be combined with --target-error or --time-limit; give --samples");
    if (!files.untiledReason.empty())
        throw UsageError(
            fmt::format("{} draws the image in tiles, but {}; leave one of them out", option, files.untiledReason));
    if (files.share && !oneExr)
        throw UsageError("--tile writes to a single EXR file; give one output, such as -o tile.exr");
}

// Returns the folder of the temporary tiles: out.tiles for the output out.exr.
fs::path FrameOutput::tilesFolder() const {
    fs::path folder = files_.outputs.front();
    folder.replace_extension("tiles");
    return folder;
}

RowFileHeader FrameOutput::header() const {
    const Request& request = driver_.request();
    RowFileHeader header;
    header.width = request.size.width;
    header.height = request.size.height;
    header.rows = wanted_;
    header.settings = settings_;
    if (files_.share) header.share = fmt::format("{}/{}", files_.share->index, files_.share->count);
    return header;
}

// Keeps the finished tiles of an earlier run if this run resumes it; removes all other tiles.
void FrameOutput::findTiles() {
    const FoundTiles found = tilesIn(tilesFolder(), header());
    std::vector<RowRange> missing = {wanted_};
    std::vector<fs::path> kept;
    if (files_.resume) {
        missing = missingRows(found.fitting, wanted_.end);
        for (const RowFile& file : found.fitting) kept.push_back(file.path);
    }
    for (const fs::path& path : found.all)
        if (std::ranges::find(kept, path) == kept.end()) fs::remove(path);
    rowsKept_ = wanted_.end;
    for (const RowRange& rows : missing) rowsKept_ -= rows.end - rows.first;
    if (files_.resume) parts_.rows = missing;
}

void FrameOutput::findShare() {
    const int height = wanted_.end;
    if (files_.share->count > height)
        fail("--tile {}/{}: the image has only {} rows; use fewer tiles", files_.share->index, files_.share->count,
             height);
    wanted_ = rowsOfPart(height, files_.share->index, files_.share->count);
    parts_.rows = {wanted_};
    if (!files_.resume || !isRowFile(files_.outputs.front())) return;
    const RowFileHeader before = readRowHeader(files_.outputs.front());
    if (before.settings != settings_ || !(before.rows == wanted_) || before.height != height) return;
    parts_.rows = std::vector<RowRange>();
    rowsKept_ = wanted_.end - wanted_.first;
}

void FrameOutput::start(const Progress& progress) {
    const Request& request = driver_.request();
    check(files_, request);
    driver_.prepare(progress);
    // Meter the exposure (in writeOptions) before the frame allocates memory.
    static_cast<void>(driver_.writeOptions());
    wanted_ = {0, request.size.height};
    parts_ = {.samples = files_.samples, .untiledReason = files_.untiledReason, .shortDraws = files_.keepPartial};
    if (files_.untiledReason.empty() && !files_.samples)
        parts_.takeRows = [this](const RowRange& rows, Image&& pixels) { takeRows(rows, std::move(pixels)); };
    const bool resumesTiles = files_.resume && fs::is_directory(tilesFolder());
    if (files_.samples || files_.share || resumesTiles) settings_ = driver_.settingsHash();
    if (files_.share)
        findShare();
    else if (resumesTiles)
        findTiles();
    driver_.start(Request(request), parts_, progress);
    if (!driver_.driver().inTiles()) {
        if (files_.resume)
            throw UsageError(
                "--resume continues a frame that is drawn in tiles, but this frame fits into memory without tiles; "
                "leave out --resume");
    } else if (settings_.empty()) {
        settings_ = driver_.settingsHash();
        findTiles();
    }
}

void FrameOutput::takeRows(const RowRange& rows, Image&& pixels) {
    if (files_.share) {
        if (!writer_) {
            RowFileHeader own = header();
            own.metadata = driver_.metadata();
            writer_.emplace(rowFileWriter(files_.outputs.front(), own, pixels.channels));
        }
        writer_->write(pixels);
    } else {
        fs::create_directories(tilesFolder());
        RowFileHeader own = header();
        own.rows = rows;
        own.metadata = driver_.metadata();
        ImageRowWriter writer = rowFileWriter(rowsPath(tilesFolder(), rows), own, pixels.channels);
        writer.write(pixels);
        writer.finish();
    }
    rowsDone_ += rows.end - rows.first;
}

bool FrameOutput::advance() {
    return driver_.advance();
}

double FrameOutput::share() const {
    const double rows = wanted_.end - wanted_.first;
    return (rowsKept_ + driver_.driver().share() * (rows - rowsKept_)) / rows;
}

std::optional<Image> FrameOutput::partialImage() {
    const FrameDriver& driver = driver_.driver();
    if (!files_.keepPartial || files_.samples || files_.share || driver.inTiles() || driver.samples() == 0) return {};
    return driver_.image();
}

std::string FrameOutput::stopMessage() const {
    const FrameDriver& driver = driver_.driver();
    if (files_.share) return fmt::format("stopped: tile {} was not written", header().share);
    if (driver.inTiles())
        return fmt::format("stopped: {} of {} rows are kept in {}; repeat the command with --resume to continue",
                           rowsKept_ + rowsDone_, wanted_.end, tilesFolder().string());
    return fmt::format("stopped after {} of {} samples; no image was written", driver.samples(), driver.sampleTotal());
}

// Joins the temporary tiles into the output files, then removes the tiles.
void FrameOutput::join() {
    const fs::path folder = tilesFolder();
    std::vector<fs::path> paths;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (canBeTile(entry)) paths.push_back(entry.path());
    std::vector<JoinedOutput> outputs;
    for (const fs::path& path : files_.outputs) outputs.push_back({path, driver_.writeOptions()});
    joinRows(completeRows(paths), outputs, driver_.metadata());
    for (const fs::path& path : paths) fs::remove(path);
    std::error_code notEmpty;
    fs::remove(folder, notEmpty);
}

std::optional<Image> FrameOutput::finish() {
    if (files_.samples) {
        FramePart part = driver_.driver().sums();
        part.settings = settings_;
        part.metadata = driver_.metadata();
        part.metadata["defocus:samples"] = static_cast<int>(part.frameSamples);
        writePart(files_.outputs.front(), part);
        return {};
    }
    if (files_.share) {
        if (writer_) writer_->finish();
        return {};
    }
    if (!driver_.driver().inTiles()) return driver_.image();
    join();
    return {};
}

}  // namespace defocus::engine
