#pragma once
// Row-wise access to image files that do not fit into memory. EXR, PNG and JPEG are written from the top row down, with
// the same pixels as writeImage. Only EXR can be read by rows.

#include <filesystem>
#include <memory>

#include "image/image_io.h"

namespace defocus::engine {

// Position of a file's rows in a larger image; in EXR, the data window within the display window.
struct RowPlace {
    int firstRow = 0;
    int imageHeight = 0;  // px; 0: the file holds the complete image
};

class ImageRowWriter {
public:
    // Throws Error that names the path. `place` applies to EXR only.
    ImageRowWriter(const std::filesystem::path& path, int width, int height, int channels, const Metadata& metadata,
                   const WriteOptions& options = {}, const RowPlace& place = {});
    ~ImageRowWriter();  // removes an unfinished file
    ImageRowWriter(ImageRowWriter&&) noexcept;

    // Appends rows with the width and channels given to the constructor.
    void write(const ImageView& rows);
    // Call after the last row: flushes the file to disk and renames it to `path`.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

class ImageRowReader {
public:
    // Throws Error that names the path, also if the file is not an EXR file with channels R, G, B and optionally A.
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
