#pragma once
// Measures the frame time and the image quality after a change of focus or f-number while the camera stands still.
// Compares a window that stores the image of each lens sample (picture/kept_images.h) with one that doesn't.

#include "view/bench/view_bench.h"

namespace defocus::engine {

struct RefocusBenchRow {
    std::string method;             // method and its settings, in the format of MethodUse::text
    std::string change;             // dragged value with its start and end, such as "focus 2 to 1.4 m"
    std::uint32_t keptImages = 0;   // number of images that the window stores, one per lens sample; 0: none
    double dragMilliseconds = 0;    // median frame time during the drag
    FrameQuality dragQuality;       // resolution and lens samples of the last frame of the drag
    double dragPsnr = 0;            // PSNR of the last frame of the drag, dB
    double fullMilliseconds = 0;    // time from the end of the drag to the first image at full quality
    std::uint32_t fullSamples = 0;  // lens samples of the first image at full quality
    double fullPsnr = 0;            // PSNR of the first image at full quality, dB
};

// Measures the methods on the document's scene at ViewState::pictureSize. For each method, simulates three drags, with
// one step per frame. Two drags move the focus halfway (in 1/distance) to the nearest or to the farthest surface. The
// third changes the f-number by one stop. An image computed from stored images has full quality if it uses every stored
// image whose lens point is within the aperture. A rendered image has full quality if it has the window's resolution
// and KeptImages::maxImages lens samples, or if it needs no further samples. Needs a current GL context. Throws Error
// for a method that doesn't support the scene or the settings.
void measureRefocus(Document& document, ViewState& state, const ViewBenchOptions& options,
                    const std::function<void(const RefocusBenchRow&)>& take, const Progress& progress = {});

}  // namespace defocus::engine
