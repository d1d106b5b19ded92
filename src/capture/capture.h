#pragma once
// Renders the frames of a shot to files: plans and draws one after the other while a thread of its own encodes and
// writes what is done. A frame appears under its name only whole, so that a run can be cut off at any moment and
// resumed.
//
// Beside the frames lies a sidecar, timings.jsonl, with a line of JSON for each frame rendered: times don't stand in
// the frames, which are the same bits whenever and wherever they are rendered.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "core/progress.h"
#include "frame/driver/frame_driver.h"
#include "frame/setup/settings_hash.h"
#include "image/image_io.h"

namespace defocus::engine {

// One frame of a shot and its files.
struct FilmFrame {
    int frame = 0;
    std::vector<std::string> settings;         // of each file
    std::vector<std::filesystem::path> files;  // one an output pattern
    WriteOptions write;                        // of PNG, JPEG and video
    bool finished = false;                     // there already, and as it should be
    std::filesystem::path
        other;  // a whole image that would be replaced, of other settings; empty: none (with `resume`)
};

struct FilmOptions {
    std::vector<std::string> outputs;        // patterns, see frame_files.h
    std::optional<SampleRange> sampleRange;  // write parts of the frames: FRAME.partFIRST-END.exr; one EXR output only
    FilmSettings settings;                   // all but the encoding; of its request's stop only the target error counts
    bool metered = false;                    // the exposure is metered later, see FilmFrame::write
    std::filesystem::path timings;           // the sidecar
    bool resume = false;                     // keep finished frames
    // Called with the first image that is drawn in one piece, and how its 8-bit files are written.
    std::function<void(const Image&, const WriteOptions&)> firstDrawn;
};

// "frames/timings.jsonl", or of shard 2 of 8 "frames/timings.2-of-8.jsonl".
std::filesystem::path timingsPath(const std::string& pattern, int shard, int shards);

// Each frame of the list, checked: what can't be filmed throws before long work. With `resume`, finished ones are
// found.
std::vector<FilmFrame> filmFrames(const Shot& shot, const SequenceBase& base, const std::vector<int>& frames,
                                  const FilmOptions& options, const Progress& progress = {});

struct FilmFigures {
    int rendered = 0;
    int tiles = 1;  // that a frame was drawn in
    int finishedBefore = 0;
    double renderMilliseconds = 0;  // of the rendered frames, each from its plan to its image
    double totalMilliseconds = 0;   // wall clock, until the last file was written
    std::uint64_t triangles = 0;
    std::optional<int> stoppedBefore;  // the frame that would have come next
};

// Metadata of a frame's files, without times.
using FilmMetadata = std::function<Metadata(const FrameMoment&, const FramePlan&, const RenderStats&)>;

// Bytes a pixel of the images that wait for the writer, for DriverOptions.
inline constexpr std::uint64_t filmPixelBytes = 3 * 16;

// Renders the frames that aren't finished. `driver` was made for `world`, which takes each frame's pose and lights.
// Asks `stop` before each frame. Frames in tiles are written row by row; if memory is short, each frame is written
// before the next is drawn. Throws Error for a file that can't be written, with finished frames kept, and for frames
// that don't fit into memory.
FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, World& world, FrameDriver& driver,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options, const FilmMetadata& metadata,
                       const std::function<bool()>& stop, const Progress& progress = {});

}  // namespace defocus::engine
