#pragma once
// Image files row by row, for images that don't fit into memory. All three formats are written from the top, some rows
// after the other, with the same pixels as writeImage gives them. EXR files are read so too; what is in the way of PNG
// and JPEG is only that nobody needs it.

#include <filesystem>
#include <memory>

#include "image/image_io.h"

namespace defocus::engine {

// Where the rows of a file lie in a larger image. In an EXR file it is the data window within the display window.
struct RowPlace {
    int firstRow = 0;
    int imageHeight = 0;  // px; 0: the file is the whole image
};

class ImageRowWriter {
public:
    // Throws Error naming the path. `place` is for EXR files alone.
    ImageRowWriter(const std::filesystem::path& path, int width, int height, int channels, const Metadata& metadata,
                   const WriteOptions& options = {}, const RowPlace& place = {});
    ~ImageRowWriter();  // removes what isn't finished
    ImageRowWriter(ImageRowWriter&&) noexcept;

    // The next rows, of the width and channels given.
    void write(const ImageView& rows);
    // After the last row: the file is flushed to the disk and gets its name.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

class ImageRowReader {
public:
    // Throws Error naming the path, also for what isn't an EXR file with the channels R, G, B and maybe A.
    explicit ImageRowReader(const std::filesystem::path& path);
    ~ImageRowReader();
    ImageRowReader(ImageRowReader&&) noexcept;

    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;  // of the rows that the file has
    [[nodiscard]] int channels() const;
    [[nodiscard]] RowPlace place() const;
    [[nodiscard]] Metadata metadata() const;
    // Rows [first, first + count) of the file.
    Image read(int first, int count);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace defocus::engine
