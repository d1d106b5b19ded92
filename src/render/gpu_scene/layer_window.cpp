#include "render/gpu_scene/layer_window.h"

namespace defocus::engine {

LayerWindow layerWindow(const FramePlan& plan) {
    const int width = plan.view.width;
    const int height = plan.view.height;
    const PixelRectangle whole{0, 0, width, height};
    const Tile tile = plan.tile.value_or(Tile{whole, whole});
    LayerWindow window;
    window.layerWidth = tile.cell.width;
    window.layerHeight = tile.cell.height;
    window.imageLeft = tile.cell.left;
    window.imageBottom = height - (tile.cell.top + tile.cell.height);
    window.imageWidth = width;
    window.imageHeight = height;
    window.left = tile.area.left - tile.cell.left;
    window.bottom = tile.cell.top + tile.cell.height - (tile.area.top + tile.area.height);
    window.width = tile.area.width;
    window.height = tile.area.height;
    window.cut = !plan.usesTransmission && (window.width < window.layerWidth || window.height < window.layerHeight);
    return window;
}

}  // namespace defocus::engine
