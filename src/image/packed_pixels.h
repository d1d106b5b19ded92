#pragma once
// Gives access to the pixels of an ImageView as one contiguous block.

#include "image/image.h"

namespace defocus::engine {

// Returns whether the size and strides of a view keep all its pixels within ImageView::pixels. Returns false for sizes
// below 1.
bool coversItsPixels(const ImageView& view);

// Returns a view of rows [first, first + count) of an image.
ImageView rowsOf(const ImageView& image, int first, int count);

// Pixels of a view, without gaps between rows or pixels. Pixels are copied only if the view has gaps; otherwise the
// view's pixels must outlive this object.
class PackedPixels {
public:
    // Throws Error if the view extends beyond ImageView::pixels.
    explicit PackedPixels(const ImageView& view);
    PackedPixels(const PackedPixels&) = delete;
    PackedPixels& operator=(const PackedPixels&) = delete;

    [[nodiscard]] const ImageView& view() const { return view_; }

private:
    Image copy_;  // copy of the pixels; empty if the view has no gaps
    ImageView view_;
};

}  // namespace defocus::engine
