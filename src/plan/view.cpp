#include "plan/view.h"

namespace defocus::engine {

View withMargin(View view, int margin) {
    const int width = view.width + 2 * margin;
    view.lens.horizontalAperture *= static_cast<double>(width) / view.width;
    view.width = width;
    view.height += 2 * margin;
    return view;
}

}  // namespace defocus::engine
