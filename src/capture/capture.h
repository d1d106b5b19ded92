#pragma once
// Renders the frames of a shot to files. A second thread encodes and writes finished frames while the next is drawn. A
// file gets its name only when it is complete, so that an interrupted run can be resumed.
//
// A sidecar file, timings.jsonl, holds a line of JSON for each rendered frame. The frames themselves hold no times, so
// that repeated runs give identical files.

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
    std::vector<std::string> settings;         // settings hash of each file
    std::vector<std::filesystem::path> files;  // one per output pattern
    WriteOptions write;                        // encoding of PNG, JPEG and video
    bool finished = false;                     // the files exist and have the wanted settings
    std::filesystem::path other;               // with `resume`: image of other settings to be replaced; empty: none
};

struct FilmOptions {
    std::vector<std::string> outputs;        // file name patterns, see capture/frame_files.h
    std::optional<SampleRange> sampleRange;  // write sums of samples to FRAME.partFIRST-END.exr; one EXR output only
    FilmSettings settings;                   // without encoding; of the stop conditions, only the target error counts
    bool metered = false;                    // exposure is metered later, see FilmFrame::write
    std::filesystem::path timings;           // path of the sidecar file
    bool resume = false;                     // keep the frames that are already finished
    // Called with the first image that is drawn in one piece, and with the encoding of its 8-bit files.
    std::function<void(const Image&, const WriteOptions&)> firstDrawn;
};

// Returns the path of the sidecar: "frames/timings.jsonl", or "frames/timings.2-of-8.jsonl" for shard 2 of 8.
std::filesystem::path timingsPath(const std::string& pattern, int shard, int shards);

// Returns the frames with their files. With `resume`, marks frames that are already finished. Throws Error for any
// frame that cannot be rendered, before the long work starts.
std::vector<FilmFrame> filmFrames(const Shot& shot, const SequenceBase& base, const std::vector<int>& frames,
                                  const FilmOptions& options, const Progress& progress = {});

struct FilmFigures {
    int rendered = 0;
    int tiles = 1;  // number of tiles of the last frame
    int finishedBefore = 0;
    double renderMilliseconds = 0;  // time from plan to image, sum over the rendered frames
    double totalMilliseconds = 0;   // wall clock, until the last file is written
    std::uint64_t triangles = 0;
    std::optional<int> stoppedBefore;  // number of the next frame if the run was stopped
};

// Returns the metadata of a frame's files, without times.
using FilmMetadata = std::function<Metadata(const FrameMoment&, const FramePlan&, const RenderStats&)>;

// Bytes per pixel of the images that wait for the writer, for DriverOptions::keptPixelBytes.
inline constexpr std::uint64_t filmPixelBytes = 3 * 16;

// Renders the unfinished frames. `driver` must be made for `world`, whose pose and lights change with each frame. Calls
// `stop` before each frame and ends the run if it returns true. Frames in tiles are written row by row. If memory is
// short, each frame is written before the next is drawn. Throws Error for a file that can't be written and for frames
// that don't fit into memory; finished frames stay.
FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, World& world, FrameDriver& driver,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options, const FilmMetadata& metadata,
                       const std::function<bool()>& stop, const Progress& progress = {});

}  // namespace defocus::engine
