#pragma once
// Writes and reads image files in groups of rows, for images that do not fit into memory. EXR, PNG and JPEG files are
// written from the top row down, with the same pixels as writeImage. Only EXR files can be read row by row.

#include <filesystem>
#include <memory>

#include "core/file.h"
#include "image/image_io.h"

namespace defocus::engine {

// Position of a file's rows in the complete image, if the file holds only some rows. EXR stores it as the data window
// within the display window.
struct RowPlace {
    int firstRow = 0;
    int imageHeight = 0;  // height in px of the complete image; 0: the file holds all rows
};

class ImageRowWriter {
public:
    // Throws Error, with the path in its message, if the file cannot be created. `place` is stored only in EXR files.
    ImageRowWriter(const std::filesystem::path& path, int width, int height, int channels, const Metadata& metadata,
                   const WriteOptions& options = {}, const RowPlace& place = {}, NamedBy namer = NamedBy::user);
    ~ImageRowWriter();  // deletes the temporary file unless finish() was called
    ImageRowWriter(ImageRowWriter&&) noexcept;

    // Appends rows, which must have the width and channels given to the constructor.
    void write(const ImageView& rows);
    // Completes the file after the last row: flushes it to disk and renames it to `path`.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

class ImageRowReader {
public:
    // Throws Error, with the path in its message, if the file cannot be read or is not EXR with channels R, G, B and
    // optionally A.
    explicit ImageRowReader(const std::filesystem::path& path);
    ~ImageRowReader();
    ImageRowReader(ImageRowReader&&) noexcept;

    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;  // number of rows in the file
    [[nodiscard]] int channels() const;
    [[nodiscard]] RowPlace place() const;
    [[nodiscard]] Metadata metadata() const;
    // Returns rows [first, first + count) of the file.
    Image read(int first, int count);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace defocus::engine
