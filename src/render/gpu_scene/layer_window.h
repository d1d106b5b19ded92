#pragma once
// The pixels of a frame's layers that are drawn and summed, and the position of the layers in the image. Row 0 is the
// bottom row, as in OpenGL.

#include "plan/frame_plan.h"

namespace defocus::engine {

struct LayerWindow {
    // Size of the layers, px.
    int layerWidth = 0;
    int layerHeight = 0;
    // Rectangle of the layers that is summed, px.
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
    // Position of the layers' pixel (0, 0) in the image, and size of the image, px.
    int imageLeft = 0;
    int imageBottom = 0;
    int imageWidth = 0;
    int imageHeight = 0;
    // Pixels outside the rectangle need not be drawn.
    bool cut = false;
    bool operator==(const LayerWindow&) const = default;
};

// Returns the window of the plan's tile, or of the full image. With transmission `cut` is false, since such surfaces
// may show any pixel of a layer.
LayerWindow layerWindow(const FramePlan& plan);

}  // namespace defocus::engine
