#pragma once
// Access to the pixels of a view as one contiguous block.

#include "image/image.h"

namespace defocus::engine {

// Returns whether all pixels of a view lie within ImageView::pixels. Sizes below 0 are invalid.
bool coversItsPixels(const ImageView& view);

// The pixels of a view without gaps between them. Packed views are not copied, so the view's pixels must outlive this
// object.
class PackedPixels {
public:
    // Throws Error if the view reaches beyond its pixels.
    explicit PackedPixels(const ImageView& view);
    PackedPixels(const PackedPixels&) = delete;
    PackedPixels& operator=(const PackedPixels&) = delete;

    [[nodiscard]] const ImageView& view() const { return view_; }

private:
    Image copy_;  // empty if the view is packed
    ImageView view_;
};

}  // namespace defocus::engine
