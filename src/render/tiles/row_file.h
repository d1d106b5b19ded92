#pragma once
// Files that hold some rows of a frame, over its whole width and with all its lens samples. Each is an EXR image whose
// display window is the whole frame and whose data window is its rows, so that any viewer shows the rows in their
// place. Joining copies pixels and holds a few rows at a time.

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_rows.h"
#include "plan/visible/tiles.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct RowFileHeader {
    int width = 0;  // px, of the frame
    int height = 0;
    RowRange rows;
    std::string settings;  // what the frame is made of; equal for the parts of one frame
    std::string share;     // "1/4" for a requested share of the rows; empty: rows as memory allowed
    Metadata metadata;     // of the whole frame
};

struct RowFile {
    std::filesystem::path path;
    RowFileHeader header;
};

// Returns whether the file's metadata says that it holds rows of a frame; false for a file that cannot be read.
bool isRowFile(const std::filesystem::path& path);

// Throws Error naming the file.
RowFileHeader readRowHeader(const std::filesystem::path& path);

// Opens a file for the header's rows. `channels` as of the images that are then written.
ImageRowWriter rowFileWriter(const std::filesystem::path& path, const RowFileHeader& header, int channels);

// Returns the files in the order of their rows. Throws Error naming the files for rows that overlap, are missing or
// have other settings.
std::vector<RowFile> completeRows(const std::vector<std::filesystem::path>& paths);

// Returns the ranges of the frame's rows that no file covers; `files` are in the order of their rows.
std::vector<RowRange> missingRows(const std::vector<RowFile>& files, int height);

struct JoinedOutput {
    std::filesystem::path path;
    WriteOptions write;
};

// Writes the frame that the files of completeRows make up to each output. Throws Error naming the file.
void joinRows(const std::vector<RowFile>& files, const std::vector<JoinedOutput>& outputs, const Metadata& metadata);

}  // namespace defocus::engine
