#pragma once
// The rectangle that is drawn and summed in a frame's layers (images of single samples), and the position of the layers
// in the image. Row 0 is the bottom row, as in OpenGL. All values are in pixels of the layers. With n positions per
// image pixel (RenderSettings::positions), a layer has n pixels per image pixel.

#include "plan/frame_plan.h"

namespace defocus::engine {

struct LayerWindow {
    // Size of the layers.
    int layerWidth = 0;
    int layerHeight = 0;
    // Rectangle of the layers that is summed.
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
    // Position of pixel (0, 0) of the layers in the image, and size of the image.
    int imageLeft = 0;
    int imageBottom = 0;
    int imageWidth = 0;
    int imageHeight = 0;
    // True if pixels of the layers outside the rectangle that is summed need not be drawn.
    bool cut = false;
    bool operator==(const LayerWindow&) const = default;
};

// Returns the window of the plan's tile, or of the full image without tiles. With transmission, LayerWindow::cut is
// false: the entire layer is drawn, because any pixel may be visible through a transmitting surface.
LayerWindow layerWindow(const FramePlan& plan);

}  // namespace defocus::engine
