#pragma once
// Measures the frame time and the picture quality after a change of focus or f-number while the camera stands still.
// Compares a window that keeps lens images (the image of each lens sample; picture/kept_images.h) with one that
// doesn't.

#include "view/bench/view_bench.h"

namespace defocus::engine {

struct RefocusBenchRow {
    std::string method;             // method in the format of MethodUse::text
    std::string change;             // such as "focus 2 to 1.4 m"
    std::uint32_t keptImages = 0;   // lens images (one per lens sample) that the window keeps; 0: none
    double dragMilliseconds = 0;    // median time of a frame while the value is dragged
    FrameQuality dragQuality;       // resolution and lens samples of the last frame of the drag
    double dragPsnr = 0;            // PSNR of the last frame of the drag, dB
    double fullMilliseconds = 0;    // time from the last change to the first picture at full quality
    std::uint32_t fullSamples = 0;  // lens samples of the first picture at full quality
    double fullPsnr = 0;            // PSNR of the first picture at full quality, dB
};

// Measures the methods on the document's scene at ViewState::pictureSize. For each method, drags the focus halfway, in
// 1/distance, to the nearest and to the farthest surface, and the f-number by one stop, in steps of one frame each. A
// picture has full quality if it has the window's resolution and enough samples: all kept images within the aperture,
// or as many lens samples as the maximum number of kept images. Needs a current GL context. Throws Error for a method
// that doesn't support the scene or the settings.
void measureRefocus(Document& document, ViewState& state, const ViewBenchOptions& options,
                    const std::function<void(const RefocusBenchRow&)>& take, const Progress& progress = {});

}  // namespace defocus::engine
