#pragma once
// Writes and reads multi-part EXR files: images of equal size, each with its depths, in one file that any EXR reader
// can open. A part has the channels R, G, B and A (16-bit float) and Z (32-bit float), with lossless ZIP compression.
// Images are written and read one at a time, so that only one image is in memory.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "image/half_image.h"
#include "image/image_io.h"

namespace defocus::engine {

inline constexpr std::size_t maxImageParts = 1024;

// Size of the visible image and of the margin around it, in px. EXR's display window is the visible image, and its data
// window also contains the margin.
struct PartSize {
    int width = 0;
    int height = 0;
    int margin = 0;
    [[nodiscard]] int fullWidth() const { return width + 2 * margin; }
    [[nodiscard]] int fullHeight() const { return height + 2 * margin; }
};

class ImagePartWriter {
public:
    // `parts`: the metadata of each part of the file, for 1 … maxImageParts parts. Throws Error, with the path in its
    // message, if the file cannot be created.
    ImagePartWriter(const std::filesystem::path& path, const PartSize& size, const std::vector<Metadata>& parts);
    ~ImagePartWriter();  // deletes the temporary file unless finish() was called
    ImagePartWriter(ImagePartWriter&&) noexcept;

    // Appends the next part of the file: `colour` is linear, premultiplied RGBA, and `depth` has one channel. Both
    // include the margin. Colours above 65504 are clamped to that value.
    void write(const ImageView& colour, const ImageView& depth);
    // Completes the file after the last part: flushes it to disk and renames it to `path`.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

class ImagePartReader {
public:
    // Throws Error, with the path in its message, if the file cannot be read, or if its parts differ in size or lack a
    // channel.
    explicit ImagePartReader(const std::filesystem::path& path);
    ~ImagePartReader();
    ImagePartReader(ImagePartReader&&) noexcept;

    [[nodiscard]] const PartSize& size() const;
    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] const Metadata& metadata(std::size_t part) const;
    // Return a part's colours (RGBA) or depths (one channel), including the margin. Throw Error if the part is damaged.
    [[nodiscard]] HalfImage colour(std::size_t part);
    [[nodiscard]] Image depth(std::size_t part);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace defocus::engine
