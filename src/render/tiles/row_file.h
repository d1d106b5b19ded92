#pragma once
// Reads, writes and joins files that each hold a range of complete rows of a frame, with all lens samples. Each is an
// EXR image whose display window is the frame and whose data window is the rows, so viewers show the rows at their
// position in the frame. Files are joined by copying pixels, with a few rows in memory at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_rows.h"
#include "plan/visible/tiles.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct RowFileHeader {
    int width = 0;  // width of the entire frame in px
    int height = 0;
    RowRange rows;
    std::string settings;  // settings of the frame, equal for all parts
    std::string share;     // "1/4": requested part of the rows; empty: rows chosen to fit into memory
    Metadata metadata;     // metadata of the full frame
};

struct RowFile {
    std::filesystem::path path;
    RowFileHeader header;
};

// Returns whether the file's metadata mark it as a row file; false for an unreadable file.
bool isRowFile(const std::filesystem::path& path);

// Returns the header of a row file. Throws Error, with the path in its message, if it cannot be read.
RowFileHeader readRowHeader(const std::filesystem::path& path);

// Opens a row file for writing the rows that `header` describes. `channels` is the number of channels of the rows.
ImageRowWriter rowFileWriter(const std::filesystem::path& path, const RowFileHeader& header, int channels);

// Returns the row files of a frame, sorted by rows. Throws Error, with the paths in its message, if rows overlap or are
// missing, or if settings differ.
std::vector<RowFile> completeRows(const std::vector<std::filesystem::path>& paths);

// Returns the ranges of rows of a frame of `height` rows that are in no file; `files` must be sorted by rows.
std::vector<RowRange> missingRows(const std::vector<RowFile>& files, int height);

struct JoinedOutput {
    std::filesystem::path path;
    WriteOptions write;
};

// Joins the files of completeRows() and writes the frame to each output. Throws Error, with the path in its message, if
// a file cannot be read or written.
void joinRows(const std::vector<RowFile>& files, const std::vector<JoinedOutput>& outputs, const Metadata& metadata);

}  // namespace defocus::engine
