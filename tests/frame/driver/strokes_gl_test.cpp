// Tests the brightness of line primitives in a glTF file.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

class StrokesImage : public OwnContextTest {};

constexpr int segments = 24;
constexpr double yfov = 0.7;
constexpr double distance = 4;

// Returns a file with a white regular polygon of circumradius 1 around the view axis, drawn as lines.
GltfBuilder polygon() {
    GltfBuilder builder;
    std::vector<float> places;
    for (int i = 0; i < segments; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.3) / segments;
        places.insert(places.end(), {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    }
    constexpr int loop = 2;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(places)}}}, {"mode", loop}}});
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.01}}}}};
    builder.add("nodes", {{"camera", 0}, {"translation", {0, 0, distance}}});
    return builder;
}

// The pixel values of a channel add up to the length of the lines in pixels, because the lines are white and one pixel
// wide. This holds for lines in focus and for blurred lines.
TEST_F(StrokesImage, linesHaveTheLightOfOnePixelTimesTheirLength) {
    const ScratchFolder folder;
    GltfBuilder::save(folder / "polygon.glb", polygon().glb());
    Request request;
    request.scene = folder / "polygon.glb";
    request.units = 1;
    request.noCache = true;
    request.size = {192, 160};
    request.samples = 256;
    request.background = Color{0, 0, 0};
    const double pixel = 2 * std::tan(yfov / 2) * distance / request.size.height;
    const double expected = segments * 2 * std::sin(std::numbers::pi / segments) / pixel;
    for (const double blurScale : {1.0, 60.0}) {
        request.lens.blurScale = blurScale;
        request.lens.fStop = 1;
        request.focus = FocusDistance{3};
        const Image image = render(request);
        double light = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
            light += static_cast<double>(image.pixels[i]);
        EXPECT_NEAR(light / expected, 1, 0.02) << blurScale;
    }
}

}  // namespace
}  // namespace defocus::engine
