#pragma once
// Which pixels of a frame's layers are drawn and summed, and where the layers lie in the image. OpenGL's order: row 0
// is the bottom row.

#include "plan/frame_plan.h"

namespace defocus::engine {

struct LayerWindow {
    // Of the layers, px.
    int layerWidth = 0;
    int layerHeight = 0;
    // What is summed: a rectangle of the layers, px.
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
    // Where pixel (0, 0) of the layers lies in the image, and the image's size, px.
    int imageLeft = 0;
    int imageBottom = 0;
    int imageWidth = 0;
    int imageHeight = 0;
    // Pixels outside the rectangle need not be drawn.
    bool cut = false;
    bool operator==(const LayerWindow&) const = default;
};

// Of the plan's tile, or of the whole image. What transmits may show any pixel of a layer, so nothing is cut then.
LayerWindow layerWindow(const FramePlan& plan);

}  // namespace defocus::engine
