// Tests exposure metering: a file with a light as bright as the sun on a clear day is rendered without exposure
// settings.

#include <gtest/gtest.h>

#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "image/image_io.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

class MeteredRender : public OwnContextTest {
protected:
    void SetUp() override {
        OwnContextTest::SetUp();
        saveWall(0.5, 100'000);
        request_.scene = folder_ / "sunny.glb";
        request_.size.width = 32;
        request_.size.height = 24;
        request_.samples = 4;
        request_.noCache = true;
        request_.toneMap = ToneMap::none;
    }

    // Saves a scene with a matt grey wall in front of the camera, under light of `lux` at normal incidence.
    void saveWall(double grey, double lux) const {
        GltfBuilder builder;
        const int positions = builder.positions({-9, -9, -5, 9, -9, -5, 9, 9, -5, -9, 9, -5});
        const int indices = builder.indices({0, 1, 2, 0, 2, 3});
        builder.json["materials"] = {
            {{"pbrMetallicRoughness", {{"baseColorFactor", {grey, grey, grey, 1}}, {"metallicFactor", 0}}}}};
        builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}}});
        builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
        builder.add("nodes", {{"camera", 0}});
        builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", lux}}};
        builder.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        GltfBuilder::save(folder_ / "sunny.glb", builder.glb());
    }

    // Renders and writes the image. Returns the linear value of its middle pixel.
    [[nodiscard]] float written() {
        SceneRenderer renderer(request_);
        renderer.write(folder_ / "a.png", renderer.render());
        return readImage(folder_ / "a.png").at(16, 12)[1];
    }

    ScratchFolder folder_;
    Request request_;
};

// The meter exposes a uniform surface to a linear value of 0.4, for any illuminance of the sun.
TEST_F(MeteredRender, showsAWallUnderTheSun) {
    EXPECT_NEAR(written(), 0.4f, 0.02f);
    request_.exposure = ExposureValue{0};
    EXPECT_EQ(written(), 1);
}

// A nearly black wall in front of a light sky is not exposed to middle grey, because the sky would become white.
TEST_F(MeteredRender, keepsALightSkyBelowWhite) {
    saveWall(0.002, 0.1);
    request_.cameraPosition = Vector3{0, 0, 40};
    EXPECT_LT(written(), 0.1f);
    EXPECT_NEAR(readImage(folder_ / "a.png").at(0, 12)[1], 0.5f, 0.15f);
    const float before = written();
    request_.background = TransparentBackground{};
    EXPECT_NEAR(written(), before, 0.01f) << "the exposure doesn't depend on whether the sky is shown";
}

// The first written image sets the exposure of all images, so that the brightness of a video does not fluctuate.
TEST_F(MeteredRender, metersOnce) {
    SceneRenderer renderer(request_);
    renderer.write(folder_ / "a.png", renderer.render());
    Request closer = request_;
    closer.cameraPosition = Vector3{0, 0, -3};
    renderer.write(folder_ / "b.png", renderer.render(closer));
    EXPECT_NEAR(readImage(folder_ / "b.png").at(16, 12)[1], readImage(folder_ / "a.png").at(16, 12)[1], 0.02f);
}

// The meter always draws one subpixel position per sample. The exposure therefore does not depend on
// Request::positions.
TEST_F(MeteredRender, measuresTheSameWithFourPositions) {
    saveWall(0.002, 0.1);
    request_.cameraPosition = Vector3{3, 2, 40};  // the wall's edges cross the image
    Request four = request_;
    four.positions = 4;
    SceneRenderer first(four), second(request_);
    first.write(folder_ / "a.png", first.render());
    first.write(folder_ / "a.png", first.render(request_));
    second.write(folder_ / "b.png", second.render());
    EXPECT_EQ(readImage(folder_ / "a.png").pixels, readImage(folder_ / "b.png").pixels);
}

}  // namespace
}  // namespace defocus::engine
