// Tests the length of a scene unit, which the request or the file sets, or which is guessed from the scene's size.

#include "frame/setup/scene_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "scene/gltf/builder.h"
#include "scene/units.h"

namespace defocus::engine {
namespace {

// Returns a file with a square of this width that faces the camera, and a triangle that extends one width behind it.
GltfBuilder squareOf(float width) {
    GltfBuilder builder;
    const float h = width / 2;
    const int positions = builder.positions({-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0, -h, -h, -width, h, -h, -width});
    const int indices = builder.indices({0, 1, 2, 0, 2, 3, 0, 4, 1});
    builder.mesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}});
    return builder;
}

class SceneScale : public testing::Test {
protected:
    void save(const GltfBuilder& builder) const { GltfBuilder::save(folder_ / "scene.glb", builder.glb()); }

    [[nodiscard]] Request request() const {
        Request request;
        request.scene = folder_ / "scene.glb";
        request.size.width = 320;
        request.size.height = 240;
        request.noCache = true;
        request.lens.fStop = 1;
        return request;
    }

    [[nodiscard]] double scaleOf(const Request& asked) const { return placeFrame(asked).scene->metresPerUnit; }

    [[nodiscard]] static double blurOf(const Request& asked) {
        const PreparedFrame frame = prepareFrame(asked);
        return planFrame(frame.world, frame.view, frame.settings).largestBlur;
    }

    ScratchFolder folder_;
};

TEST(GuessedUnits, bringEverythingBetweenAHandAndAPerson) {
    EXPECT_EQ(guessedMetresPerUnit(1.8), 1);
    EXPECT_EQ(guessedMetresPerUnit(0.05), 1);
    EXPECT_EQ(guessedMetresPerUnit(30), 1);
    EXPECT_EQ(guessedMetresPerUnit(154), 0.01);   // the size of a fox in centimetres
    EXPECT_EQ(guessedMetresPerUnit(555), 0.001);  // the size of the Cornell box in millimetres
    EXPECT_EQ(guessedMetresPerUnit(0), 1);
    EXPECT_EQ(guessedMetresPerUnit(std::nan("")), 1);
    EXPECT_EQ(guessedMetresPerUnit(INFINITY), 1);
    for (double extent = 1e-9; extent < 1e12; extent *= 1.3) {
        const double size = extent * guessedMetresPerUnit(extent);
        EXPECT_GE(size, 0.05 - 1e-12) << extent;
        EXPECT_LE(size, 30 + 1e-12) << extent;
    }
}

TEST(Units, haveNamesOrAreNumbers) {
    for (const char* text : {"m", "cm", "mm", "0.0254", "100"}) EXPECT_EQ(unitOfMetres(metresOfUnit(text)), text);
    for (const char* text : {"", "km", "-1", "0", "1e10", "cm "}) EXPECT_THROW(metresOfUnit(text), Error) << text;
}

TEST_F(SceneScale, whatIsSaidCountsThenTheFileThenAGuess) {
    GltfBuilder builder = squareOf(200);
    save(builder);
    EXPECT_EQ(scaleOf(request()), 0.01);
    EXPECT_TRUE(placeFrame(request()).scaleNote);

    builder.json["asset"]["extras"] = {{"units", "mm"}};
    save(builder);
    EXPECT_EQ(scaleOf(request()), 0.001);
    EXPECT_FALSE(placeFrame(request()).scaleNote);

    Request said = request();
    said.units = 0.0254;
    EXPECT_EQ(scaleOf(said), 0.0254);

    builder.json["asset"]["extras"] = {{"units", "miles"}};
    save(builder);
    EXPECT_THROW(static_cast<void>(scaleOf(request())), Error);
}

TEST_F(SceneScale, lengthsThatAreGivenAreInMetresOfTheFile) {
    GltfBuilder builder = squareOf(200);
    save(builder);
    Request distance = request();
    distance.focus = FocusDistance{400};
    EXPECT_EQ(scaleOf(distance), 1);
    Request place = request();
    place.cameraPosition = Vector3{0, 0, 500};
    EXPECT_EQ(scaleOf(place), 1);

    // The scale is guessed from the scene's size unless the camera has its own focus distance.
    nlohmann::json camera = {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 1}}}};
    builder.json["cameras"] = {camera};
    builder.add("nodes", {{"camera", 0}, {"translation", {0, 0, 120}}});
    save(builder);
    EXPECT_EQ(scaleOf(request()), 0.01);
    camera["extras"] = {{"focusDistance", 120}};
    builder.json["cameras"] = {camera};
    save(builder);
    EXPECT_EQ(scaleOf(request()), 1);
}

// An object has the same blur whether its file is in metres or in centimetres. With a wrong unit, the blur differs.
TEST_F(SceneScale, blurIsThatOfTheThing) {
    save(squareOf(2));
    const double inMetres = blurOf(request());
    save(squareOf(200));
    EXPECT_NEAR(blurOf(request()), inMetres, 1e-5 * inMetres);
    Request wrong = request();
    wrong.units = 1;
    EXPECT_NEAR(blurOf(wrong), inMetres / 100, 1e-5 * inMetres);
}

}  // namespace
}  // namespace defocus::engine
