// Tests the ray tracer's bokeh against the definition of each aperture that is sampled from a mask.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "aperture_shapes.h"
#include "embree/aperture_mask.h"
#include "likeness.h"
#include "render/traced.h"

namespace defocus::engine {
namespace {

// The bokeh of a bright square has the shape and the brightness of the aperture. These apertures, all but disks and
// polygons with straight blades, are sampled by rejection. The tolerance covers the noise of the 18,000 rays that hit
// the square.
TEST(EmbreeBokehShape, MaskedAperturesShowTheirDefinition) {
    View view = bokehView(36, 36);
    view.lens.fStop = 0.03;  // with its blur of 28 px, the square just fits into the image
    std::vector<std::pair<std::string, Lens>> lenses = {{"image", view.lens}};
    lenses.front().second.apertureImage = std::make_shared<const Image>(lopsidedImage());
    for (const ApertureShape& shape : apertureShapes)
        if (ApertureMask::isNeeded(shape.lens())) lenses.emplace_back(shape.name, shape.lens(view.lens));
    for (const auto& [name, lens] : lenses) {
        view.lens = lens;
        const Image image = traced(rectangleScene(view, {{15, 15, 21, 21, 6}}, glm::vec3(100)), view, 512);
        EXPECT_LT(misplacedLight(image, expectedBokeh(view, 6, 6, 3600, lightOf(lens))), 0.06) << name;
        EXPECT_NEAR(momentsOf(image).energy, 3600, 3600 * 0.03) << name;
    }
}

}  // namespace
}  // namespace defocus::engine
