#pragma once
// Files with some rows of a frame, over its full width and with all lens samples. Each is an EXR image whose display
// window is the frame and whose data window is the rows, so viewers show the rows in position. Joining copies pixels,
// with a few rows in memory at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_rows.h"
#include "plan/visible/tiles.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct RowFileHeader {
    int width = 0;  // size of the frame, px
    int height = 0;
    RowRange rows;
    std::string settings;  // settings of the frame; equal for all parts
    std::string share;     // "1/4" for a requested share of the rows; empty: as many rows as memory allowed
    Metadata metadata;     // metadata of the full frame
};

struct RowFile {
    std::filesystem::path path;
    RowFileHeader header;
};

// Returns whether the file's metadata mark it as rows of a frame; false for an unreadable file.
bool isRowFile(const std::filesystem::path& path);

// Returns the header of a row file. Throws Error naming the file.
RowFileHeader readRowHeader(const std::filesystem::path& path);

// Opens a file for writing the header's rows. `channels`: number of channels of the images written.
ImageRowWriter rowFileWriter(const std::filesystem::path& path, const RowFileHeader& header, int channels);

// Returns the files sorted by rows. Throws Error naming the files if rows overlap or are missing, or if settings
// differ.
std::vector<RowFile> completeRows(const std::vector<std::filesystem::path>& paths);

// Returns the row ranges that no file covers; `files` must be sorted by rows.
std::vector<RowRange> missingRows(const std::vector<RowFile>& files, int height);

struct JoinedOutput {
    std::filesystem::path path;
    WriteOptions write;
};

// Writes the joined frame of completeRows() to each output. Throws Error naming the file.
void joinRows(const std::vector<RowFile>& files, const std::vector<JoinedOutput>& outputs, const Metadata& metadata);

}  // namespace defocus::engine
