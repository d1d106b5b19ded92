#pragma once
// Access to the pixels of an ImageView as one contiguous block.

#include "image/image.h"

namespace defocus::engine {

// Returns whether all pixels of a view, by its sizes and strides, lie within ImageView::pixels. Returns false for
// negative sizes.
bool coversItsPixels(const ImageView& view);

// Pixels of a view without gaps between rows or pixels. A view without gaps is not copied, so its pixels must outlive
// this object.
class PackedPixels {
public:
    // Throws Error if the view extends beyond ImageView::pixels.
    explicit PackedPixels(const ImageView& view);
    PackedPixels(const PackedPixels&) = delete;
    PackedPixels& operator=(const PackedPixels&) = delete;

    [[nodiscard]] const ImageView& view() const { return view_; }

private:
    Image copy_;  // empty if the view has no gaps
    ImageView view_;
};

}  // namespace defocus::engine
