#include "view/bench/bench_picture.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "core/error.h"
#include "frame/driver/reference_image.h"
#include "gl/timer.h"

namespace defocus::engine {

void BenchPicture::draw() {
    const std::string faultBefore = std::exchange(state_.fault, {});
    updateWorld(document_, state_, false);
    updatePicture(picture_, document_, state_, software_, 0, false);
    waitForGpu();
    if (!state_.fault.empty()) throw Error(chosenMethod(state_.options).text() + ": " + state_.fault);
    state_.fault = faultBefore;
}

void BenchPicture::grow() {
    growPicture(picture_, document_, state_);
    draw();
    if (image().moving()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

Image benchReference(const Document& document, const ViewState& state, const View& view,
                     const ViewBenchOptions& options, const Progress& progress) {
    ReferenceOptions reference;
    reference.samples = options.referenceSamples;
    reference.renderer.shaderFolder = options.shaderFolder;
    reference.shadows = state.options.shadows;
    return renderedReference(document.frame->world, view, reference, progress).image;
}

Image enlarged(const Image& image, int width, int height) {
    if (image.width == width && image.height == height) return image;
    Image result(width, height, image.channels);
    const auto place = [](int to, int sizeTo, int sizeFrom) {
        const double from = (to + 0.5) * sizeFrom / sizeTo - 0.5;
        const double clamped = std::clamp(from, 0.0, sizeFrom - 1.0);
        const int low = std::min(static_cast<int>(clamped), std::max(0, sizeFrom - 2));
        return std::pair(low, static_cast<float>(clamped - low));
    };
    for (int y = 0; y < height; ++y) {
        const auto [y0, v] = place(y, height, image.height);
        const int y1 = std::min(y0 + 1, image.height - 1);
        for (int x = 0; x < width; ++x) {
            const auto [x0, u] = place(x, width, image.width);
            const int x1 = std::min(x0 + 1, image.width - 1);
            for (int c = 0; c < image.channels; ++c) {
                const float top = std::lerp(image.at(x0, y0)[c], image.at(x1, y0)[c], u);
                const float bottom = std::lerp(image.at(x0, y1)[c], image.at(x1, y1)[c], u);
                result.at(x, y)[c] = std::lerp(top, bottom, v);
            }
        }
    }
    return result;
}

}  // namespace defocus::engine
