#pragma once
// Draws a frame that goes to files in parts: tiles of an image that doesn't fit into memory, a share of its rows, or
// the sums of some of its lens samples. Tiles of an interrupted run are kept and can be resumed.
//
//   FrameOutput output(driver, files);
//   output.start();
//   while (output.advance()) {}
//   std::optional<Image> image = output.finish();   // the frame, if it fits into memory in one piece

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frame/driver/scene_driver.h"
#include "image/image_rows.h"
#include "render/tiles/row_file.h"

namespace defocus::engine {

struct FrameFiles {
    std::vector<std::filesystem::path> outputs;  // at least one; a part of a frame goes to the first
    std::optional<SampleRange> samples;          // write only the sums of these lens samples, for `merge`
    std::optional<TileShare> share;              // write only this share of the rows, for `merge`
    bool resume = false;                         // keep what an interrupted run of the same settings has finished
    std::string whole;                           // why tiles are impossible; empty: they aren't
};

class FrameOutput {
public:
    // `driver` must outlive the output.
    FrameOutput(SceneDriver& driver, FrameFiles files) : driver_(driver), files_(std::move(files)) {}

    // Throws UsageError for files and requests that don't go together. Needs no scene.
    static void check(const FrameFiles& files, const Request& request);

    // Begins the frame of the driver's request, or what an earlier run has left to do. Throws Error as
    // SceneDriver::start does.
    void start(const Progress& progress = {});
    // Draws one wave of samples and writes the rows that are finished; false once the frame is done.
    bool advance();
    // Writes the sums, finishes the share, or joins the tiles to the outputs. Returns the image of a whole frame that
    // fits into memory, which the caller writes.
    std::optional<Image> finish();

    [[nodiscard]] double share() const;  // 0 … 1 of the work, with what an earlier run did
    // What is kept if the run stops now, as a message: "stopped: 96 of 768 rows are kept in out.tiles; …"
    [[nodiscard]] std::string stopMessage() const;
    [[nodiscard]] int rowsKept() const { return rowsKept_; }  // from an earlier run

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
    std::string settings_;  // SceneDriver::settingsHash, once a file needs it
    RowRange wanted_;       // rows of the frame, or of the share
    int rowsKept_ = 0;
    int rowsDone_ = 0;                      // by this run, in files
    std::optional<ImageRowWriter> writer_;  // of the share
};

}  // namespace defocus::engine
