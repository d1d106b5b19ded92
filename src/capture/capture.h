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
#include "capture/partial.h"
#include "capture/settings_hash.h"
#include "core/progress.h"
#include "image/image_io.h"
#include "render/methods.h"
#include "render/renderer.h"

namespace defocus {

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
    ToneMap toneMap = ToneMap::none;         // of PNG, JPEG and video, as is the exposure
    std::optional<double> exposure;          // EV; none: what each frame's lens makes
    bool metered = false;                    // the exposure is that of a meter, which is read later
    bool automatic = false;                  // each frame gets as many samples as it asks for
    StopSettings stop;                       // of each frame; no time limit, which no two runs would keep alike
    FilmSettings settings;                   // all but the encoding
    std::filesystem::path timings;           // the sidecar
    bool resume = false;                     // keep what is finished
    // Gets the image of the first frame that is drawn whole, and how its pictures are written.
    std::function<void(const Image&, const WriteOptions&)> firstDrawn;
    const Method* method = nullptr;  // that draws
    std::uint64_t memoryLimit = 0;   // bytes that the process may take in all
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
using FilmMetadata = std::function<Metadata(const SequenceFrame&, const FramePlan&, const RenderStats&)>;

// Renders those that aren't finished. `world` takes each frame's pose and lights; `renderer` was made for it. Before
// each frame `stop` is asked. Frames that don't fit into memory in one piece are drawn in tiles and written row by row,
// with the same bits; those that fit alone are written before the next is drawn. Throws Error for a file that can't be
// written, with what is finished kept, and for frames that fit in no way.
FilmFigures renderFilm(const Shot& shot, const SequenceBase& base, World& world, Renderer& renderer,
                       const std::vector<FilmFrame>& frames, const FilmOptions& options, const FilmMetadata& metadata,
                       const std::function<bool()>& stop, const Progress& progress = {});

}  // namespace defocus
