#pragma once
// Draws a frame and writes it to files in parts: tiles of an image that doesn't fit into memory, a share of its rows,
// or the sums of some of its lens samples. The tiles of an interrupted run are kept and can be resumed.
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
    bool resume = false;                         // keep rows that an interrupted run of the same settings finished
    std::string whole;                           // why tiles are impossible; empty: tiles are possible
};

class FrameOutput {
public:
    // `driver` must outlive the output.
    FrameOutput(SceneDriver& driver, FrameFiles files) : driver_(driver), files_(std::move(files)) {}

    // Throws Error for files and requests that cannot be combined. The scene need not be loaded.
    static void check(const FrameFiles& files, const Request& request);

    // Begins the frame of the driver's request, or the remaining part of an interrupted run. Throws Error as
    // SceneDriver::start does.
    void start(const Progress& progress = {});
    // Draws one wave of samples and writes the finished rows. Returns false once the frame is done.
    bool advance();
    // Writes the sums, finishes the share, or joins the tiles into the output files. Returns the image of a whole frame
    // that fits into memory; the caller writes it.
    std::optional<Image> finish();

    [[nodiscard]] double share() const;  // finished fraction of the work, 0 … 1, including an earlier run's
    // Returns a message about the parts that stay if the run stops: "stopped: 96 of 768 rows are kept in out.tiles; …"
    [[nodiscard]] std::string stopMessage() const;
    [[nodiscard]] int rowsKept() const { return rowsKept_; }  // rows kept from an earlier run

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
    RowRange wanted_;       // rows of the frame or of the share
    int rowsKept_ = 0;
    int rowsDone_ = 0;                      // rows that this run has written to files
    std::optional<ImageRowWriter> writer_;  // writer of the share's file
};

}  // namespace defocus::engine
