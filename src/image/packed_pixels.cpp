#include "image/packed_pixels.h"

#include <algorithm>

#include "core/error.h"

namespace defocus::engine {

bool coversItsPixels(const ImageView& view) {
    if (view.width < 1 || view.height < 1 || view.channels < 1) return false;
    const std::size_t last = static_cast<std::size_t>(view.height - 1) * view.strides.row +
                             static_cast<std::size_t>(view.width - 1) * view.strides.pixel;
    return last + static_cast<std::size_t>(view.channels) <= view.pixels.size();
}

ImageView rowsOf(const ImageView& image, int first, int count) {
    const std::size_t begin = static_cast<std::size_t>(first) * image.strides.row;
    const std::size_t size = static_cast<std::size_t>(count) * image.strides.row;
    ImageView rows = image;
    rows.height = count;
    // The strides may imply a gap after the last row, but the image's memory may end before that gap.
    rows.pixels = image.pixels.subspan(begin, std::min(size, image.pixels.size() - begin));
    return rows;
}

PackedPixels::PackedPixels(const ImageView& view) : view_(view) {
    if (view.isPacked()) return;
    if (!coversItsPixels(view))
        fail(
            "{} values are too few for an image of {}x{} px with {} channels, a pixel stride of {} and a row stride of "
            "{}",
            view.pixels.size(), view.width, view.height, view.channels, view.strides.pixel, view.strides.row);
    copy_ = Image(view.width, view.height, view.channels);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) std::copy_n(view.at(x, y), view.channels, copy_.at(x, y));
    view_ = copy_;
}

}  // namespace defocus::engine
