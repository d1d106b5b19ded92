#pragma once
// Renders the frames of a shot to files. A second thread encodes and writes finished frames while the next frame is
// drawn. A file gets its final name only when it is complete, so that an interrupted run can be resumed.
//
// A sidecar file, timings.jsonl, gets a line of JSON for each rendered frame. The image files contain no times, so that
// repeated runs give identical files.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "capture/refocus_runs.h"
#include "core/progress.h"
#include "frame/driver/scene_driver.h"
#include "frame/setup/settings_hash.h"
#include "image/image_io.h"

namespace defocus::engine {

// A frame of a shot, and the files to which it is written.
struct FilmFrame {
    int frame = 0;
    std::vector<std::string> settings;         // settings hash, one per file
    std::vector<std::filesystem::path> files;  // image files, one per file name pattern
    WriteOptions write;                        // encoding of PNG, JPEG and video
    bool finished = false;                     // whether all files exist with the requested settings
    // First existing image file whose settings differ from this run's. Set only with FilmOptions::resume.
    std::filesystem::path other;
};

struct FilmOptions {
    std::vector<std::string> outputs;  // file name patterns; see capture/frame_files.h
    // Range of samples to draw; nullopt: all samples. If set, their sum is written to FRAME.partFIRST-END.exr, which
    // requires exactly one output, an EXR file.
    std::optional<SampleRange> sampleRange;
    // `encoding` is set per file by filmFrames(). The request must have no time limit, because a frame must have the
    // same samples in every run; the callback `stop` of renderFilm() can limit the time of the run.
    FilmSettings settings;
    bool metered = false;  // true: the caller stores a metered exposure in FilmFrame::write before renderFilm()
    std::filesystem::path timings;  // path of the sidecar file, timings.jsonl
    bool resume = false;            // true: keep the frames that are already finished
    // Frames to compute from lens images (one image per lens sample); must be empty if sampleRange is set.
    std::vector<RefocusRun> runs = {};
    // Called with the image of the first rendered frame, unless the frame is drawn in tiles, and with the options for
    // writing this image to PNG, JPEG and video.
    std::function<void(const Image&, const WriteOptions&)> firstDrawn;
    // Called for each rendered frame with its number and plan, while the driver's frame is that frame. Not called for
    // frames that are computed from lens images.
    std::function<void(int frame, const FramePlan& plan)> frameDrawn;
};

// Returns the path of the sidecar file: "frames/timings.jsonl", or "frames/timings.2-of-8.jsonl" for shard 2 of 8.
std::filesystem::path timingsPath(const std::string& pattern, int shard, int shards);

// Returns the frames with their files. With FilmOptions::resume, marks frames that are already finished. Throws Error
// if any of the frames cannot be rendered, so that the error appears before the first frame is drawn.
std::vector<FilmFrame> filmFrames(const Shot& shot, const SequenceBase& base, const std::vector<int>& frames,
                                  const FilmOptions& options, const Progress& progress = {});

struct FilmFigures {
    int rendered = 0;
    int tiles = 1;  // number of tiles of the latest frame
    int finishedBefore = 0;
    int refocused = 0;              // frames computed from lens images (one per lens sample); included in `rendered`
    std::uint64_t lensImages = 0;   // number of lens images rendered for the refocused frames
    double renderMilliseconds = 0;  // sum over all frames of the time for planning and rendering, without writing
    double totalMilliseconds = 0;   // wall-clock time until the last file is written
    std::uint64_t triangles = 0;
    std::optional<int> stoppedBefore;  // first frame not drawn because the run was stopped; nullopt: not stopped
};

// Renders the unfinished frames. Loads nothing: the pyramids of `driver` must be built, and its GL context open if the
// method needs one. Calls `stop` before each frame; the run ends when `stop` returns true. Frames in tiles are written
// row by row. If memory is short, each frame is written before the next is drawn. Throws Error if a file can't be
// written or a frame doesn't fit into memory; finished frames are kept.
FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, SceneDriver& driver,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options,
                       const std::function<bool()>& stop, const Progress& progress = {});

}  // namespace defocus::engine
