#include "render/gpu_scene/layer_window.h"

namespace defocus::engine {

LayerWindow layerWindow(const FramePlan& plan) {
    const int axis = positionsPerAxis(plan.settings);
    const int width = plan.view.width * axis;
    const int height = plan.view.height * axis;
    const auto scaled = [axis](const PixelRectangle& area) {
        return PixelRectangle{area.left * axis, area.top * axis, area.width * axis, area.height * axis};
    };
    const PixelRectangle whole{0, 0, width, height};
    const PixelRectangle cell = plan.tile ? scaled(plan.tile->cell) : whole;
    const PixelRectangle area = plan.tile ? scaled(plan.tile->area) : whole;
    LayerWindow window;
    window.layerWidth = cell.width;
    window.layerHeight = cell.height;
    window.imageLeft = cell.left;
    window.imageBottom = height - (cell.top + cell.height);
    window.imageWidth = width;
    window.imageHeight = height;
    window.left = area.left - cell.left;
    window.bottom = cell.top + cell.height - (area.top + area.height);
    window.width = area.width;
    window.height = area.height;
    window.cut = !plan.usesTransmission && (window.width < window.layerWidth || window.height < window.layerHeight);
    return window;
}

}  // namespace defocus::engine
