#pragma once
// Draws a frame, or a part of a frame, and writes it to files: a complete image (in tiles if memory is short), part of
// the rows, or partial sums over some of the lens samples. Finished tiles of an interrupted run are kept on disk and
// can be resumed.
//
//   FrameOutput output(driver, files);
//   output.start();
//   while (output.advance()) {}
//   std::optional<Image> image = output.finish();   // the frame, unless it was drawn in tiles

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frame/driver/scene_driver.h"
#include "image/image_rows.h"
#include "render/tiles/row_file.h"

namespace defocus::engine {

struct FrameFiles {
    std::vector<std::filesystem::path> outputs;  // at least one file; a part of a frame is written to the first
    std::optional<SampleRange> samples;          // write only partial sums of these samples, for `merge`; nullopt: all
    std::optional<Share> share;                  // part of the rows to write, for `merge`; nullopt: all rows
    bool resume = false;                         // keep rows that an interrupted run with the same settings finished
    std::string untiledReason;                   // reason why tiles are forbidden; empty: tiles are allowed
    bool keepPartial = false;                    // true: partialImage() returns the image of the samples so far
};

class FrameOutput {
public:
    // `driver` must outlive the output.
    FrameOutput(SceneDriver& driver, FrameFiles files) : driver_(driver), files_(std::move(files)) {}

    // Throws Error for files and requests that cannot be combined. Doesn't need a loaded scene.
    static void check(const FrameFiles& files, const Request& request);

    // Begins the frame of the driver's request, or the missing part of an interrupted run. Throws Error in the same
    // cases as SceneDriver::start.
    void start(const Progress& progress = {});
    // Draws a batch (wave) of lens samples and writes the finished rows. Returns false once the frame is complete.
    bool advance();
    // Completes the output files. Writes the partial sums if FrameFiles::samples is set; finishes the file of a part of
    // the rows if FrameFiles::share is set; joins the tiles of a frame that was drawn in tiles. Returns the image of an
    // untiled frame, which the caller must write; otherwise nullopt.
    std::optional<Image> finish();

    [[nodiscard]] double share() const;  // finished fraction of the work, 0 … 1, including rows of an earlier run
    // Returns the image of the samples drawn so far, to be saved when a run is interrupted. Returns nullopt without
    // FrameFiles::keepPartial, before the first sample, for parts of a frame, and for frames in tiles.
    [[nodiscard]] std::optional<Image> partialImage();
    // Returns the message about the files that an interrupted run leaves on disk, such as "stopped: 96 of 768 rows are
    // kept in out.tiles; …".
    [[nodiscard]] std::string stopMessage() const;
    [[nodiscard]] int rowsKept() const { return rowsKept_; }  // number of rows kept from an earlier run

private:
    [[nodiscard]] std::filesystem::path tilesFolder() const;
    [[nodiscard]] RowFileHeader header() const;
    void takeRows(const RowRange& rows, Image&& pixels);
    void findTiles();
    void findShare();
    void join();

    SceneDriver& driver_;
    FrameFiles files_;
    FrameParts parts_;
    std::string settings_;  // SceneDriver::settingsHash; empty until a file needs it
    RowRange wanted_;       // rows to draw: all rows of the frame, or the part that FrameFiles::share selects
    int rowsKept_ = 0;
    int rowsDone_ = 0;                      // rows that this run has written to files
    std::optional<ImageRowWriter> writer_;  // writes the rows that FrameFiles::share selects
};

}  // namespace defocus::engine
