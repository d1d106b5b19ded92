#pragma once
// Draws the window's image without a window, and renders the reference images that it is compared with.

#include "core/progress.h"
#include "view/bench/view_bench.h"
#include "view/picture/live_picture.h"

namespace defocus::engine {

class BenchPicture {
public:
    // `document` and `state` must outlive this object.
    BenchPicture(Document& document, ViewState& state, bool software)
        : document_(document), state_(state), software_(software) {}

    // Draws the image for the current state as the window does, and waits for the GPU. Throws Error if the method
    // fails.
    void draw();
    // Adds lens samples to the image of a view at rest, then draws it. Waits 1 ms if the view has not yet come to rest.
    void grow();
    [[nodiscard]] ViewPicture& image() { return *picture_.image; }

private:
    Document& document_;
    ViewState& state_;
    bool software_;
    LivePicture picture_;
};

// Renders the reference image of a view at full detail, with ViewBenchOptions::referenceSamples lens samples.
Image benchReference(const Document& document, const ViewState& state, const View& view,
                     const ViewBenchOptions& options, const Progress& progress);

// Resizes the image with bilinear interpolation, as the window does with its texture.
Image enlarged(const Image& image, int width, int height);

}  // namespace defocus::engine
