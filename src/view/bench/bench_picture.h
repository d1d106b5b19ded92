#pragma once
// The picture of the window, drawn without a window, and the references that it is compared with.

#include "core/progress.h"
#include "view/bench/view_bench.h"
#include "view/picture/live_picture.h"

namespace defocus::engine {

class BenchPicture {
public:
    // `document` and `state` must outlive this object.
    BenchPicture(Document& document, ViewState& state, bool software)
        : document_(document), state_(state), software_(software) {}

    // Draws the picture for the state as the window does, and waits for the GPU. Throws Error if the method fails.
    void draw();
    // Adds samples to a still picture, then draws it. Waits for a millisecond if the picture is not yet still.
    void grow();
    [[nodiscard]] ViewPicture& image() { return *picture_.image; }

private:
    Document& document_;
    ViewState& state_;
    bool software_;
    LivePicture picture_;
};

// Renders the reference of a view at full detail.
Image benchReference(const Document& document, const ViewState& state, const View& view,
                     const ViewBenchOptions& options, const Progress& progress);

// Returns the image at another size, interpolated bilinearly like the window's texture.
Image enlarged(const Image& image, int width, int height);

}  // namespace defocus::engine
