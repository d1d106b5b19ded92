// Tests the library's class LightField: it gives the same images as the program, and rejects settings outside the
// rendered range.

#include <cmath>
#include <limits>

#include "refocus/focal_stack.h"
#include "refocus/lens_images.h"

namespace defocus::engine {
namespace {

class LightFieldLibrary : public LightFieldTest {
protected:
    void SetUp() override {
        LightFieldTest::SetUp();
        request_.samples = 16;
        path_ = folder_ / "b.lens.exr";
    }

    Request request_ = smallSchool();
    std::filesystem::path path_;
};

TEST_F(LightFieldLibrary, givesThePicturesOfTheEngine) {
    std::uint64_t reports = 0;
    defocus::LightField field =
        defocus::LightField::render(request_, path_, FocusRange{1.5, 3}, [&](auto, auto, auto) { ++reports; });
    EXPECT_GT(reports, 16u);
    LightField own(lensImages(request_, FocusRange{1.5, 3}));
    Refocusing refocusing{2.5, 1.4, Lens()};
    refocusing.shape->bladeCount = 5;
    RefocusSettings settings{FocusDistance{2.5}, {}};
    settings.lens.fStop = 1.4;
    settings.lens.bladeCount = 5;
    refocusing.fillGaps = true;
    EXPECT_EQ(field.refocus(settings).pixels, refocused(own, refocusing).pixels);
    RefocusSettings sharp;
    sharp.fillGaps = false;
    EXPECT_EQ(field.refocus(sharp).pixels, refocused(own, asRendered(own.info())).pixels);
    EXPECT_EQ(field.allInFocus().pixels, allInFocus(own).pixels);
    EXPECT_EQ(field.depth().pixels, centralDepth(own).pixels);
    EXPECT_EQ(defocus::LightField(path_).refocus(settings).pixels, field.refocus(settings).pixels);

    const FocalStack stack = field.stack(3, {{}, settings.lens});
    ASSERT_EQ(stack.pictures.size(), 3u);
    EXPECT_EQ(stack.focusDistances.front(), 1.5);
    EXPECT_NEAR(stack.focusDistances[1], 2, 1e-12);  // focus distances are evenly spaced in 1/distance
    EXPECT_EQ(stack.focusDistances.back(), 3);
    settings.focus = FocusDistance{3};
    EXPECT_EQ(stack.pictures.back().pixels, field.refocus(settings).pixels);
}

TEST_F(LightFieldLibrary, describesTheFile) {
    request_.lens.focalLength = 35;
    const auto scene = defocus::Scene::schoolOfFish(3, 2000);
    const defocus::LightField field = defocus::LightField::render(scene, request_, path_, FocusRange{1.5, 3});
    const defocus::LightFieldInfo info = field.info();
    EXPECT_EQ(info.width, 128);
    EXPECT_EQ(info.height, 96);
    EXPECT_EQ(info.focusDistance, 2);
    EXPECT_EQ(info.fStop, 0.95);
    EXPECT_EQ(info.focalLength, 35);
    EXPECT_EQ(info.horizontalAperture, 36);
    EXPECT_NEAR(info.focusRange.nearest, 1.5, 1e-9);
    EXPECT_NEAR(info.focusRange.farthest, 3, 1e-9);
    EXPECT_TRUE(info.fullDisk);
    EXPECT_EQ(info.lensPoints.size(), 16u);
    // A·W/(4·tan(θx/2)), with the aperture diameter A = 35 mm/0.95, the image width W = 128 px and tan(θx/2) = 18/35
    EXPECT_NEAR(info.pixelsPerDioptre, 0.035 / 0.95 * 128 / (4 * 18.0 / 35), 1e-9);
}

// The CoC for another focus distance and f-number agrees with the CoC in the AOVs of a direct render.
TEST_F(LightFieldLibrary, cocIsThatOfTheChosenFocusAndAperture) {
    defocus::LightField field = defocus::LightField::render(request_, path_, FocusRange{1.5, 3});
    RefocusSettings settings{FocusDistance{2.5}, {}};
    settings.lens.fStop = 2;
    const Image coc = field.coc(settings);
    request_.focus = settings.focus;
    request_.lens.fStop = 2;
    SceneRenderer renderer(request_);
    renderer.start();
    const Aovs direct = renderer.aovs();
    const Image depth = field.depth();
    std::size_t compared = 0;
    for (std::size_t i = 0; i < coc.pixels.size(); ++i) {
        if (std::isinf(direct.coc.pixels[i]) || std::isinf(depth.pixels[i]) ||
            std::abs(depth.pixels[i] - direct.depth.pixels[i]) > 0.002f * depth.pixels[i])
            continue;  // the two depth images show different surfaces, since their viewpoints differ slightly
        ++compared;
        EXPECT_NEAR(coc.pixels[i], direct.coc.pixels[i], 0.15);
    }
    EXPECT_GT(compared, coc.pixels.size() / 20);
}

TEST_F(LightFieldLibrary, refusesWrongUse) {
    const auto refusal = [&](const Request& request, const std::filesystem::path& path, FocusRange range) {
        return messageOf<UsageError>([&] { static_cast<void>(defocus::LightField::render(request, path, range)); });
    };
    Request other = request_;
    other.method = "circular";
    EXPECT_NE(refusal(other, path_, {2, 2}).find("accumulation"), std::string::npos);
    EXPECT_NE(refusal(request_, folder_ / "a.png", {2, 2}).find("a.png"), std::string::npos);
    EXPECT_NE(refusal(request_, path_, {3, 2}).find("3 to 2 m"), std::string::npos);
    EXPECT_NE(refusal(request_, path_, {std::nan(""), 2}), "");
    EXPECT_FALSE(std::filesystem::exists(path_));

    defocus::LightField field = defocus::LightField::render(request_, path_, FocusRange{1.5, 3});
    const auto refused = [&](const auto& set) {
        RefocusSettings settings;
        set(settings);
        return messageOf<Error>([&] { static_cast<void>(field.refocus(settings)); });
    };
    EXPECT_TRUE(refused([](auto& s) { s.lens.focalLength = 35; }).starts_with("focalLength: "));
    EXPECT_NE(refused([](auto& s) { s.lens.bladeCount = 2; }).find("bladeCount"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.focus = FocusNode{"0"}; }).find("distance or as a pixel"), std::string::npos);
    for (const double wrong : {-1.0, 0.0, std::nan(""), 4.0})
        EXPECT_NE(refused([&](auto& s) { s.focus = FocusDistance{wrong}; }).find("rendered range"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.lens.fStop = 0.5; }).find("wider than"), std::string::npos);
    EXPECT_THROW(static_cast<void>(field.stack(1)), UsageError);
    EXPECT_THROW(static_cast<void>(field.stack(2, {FocusDistance{2}, {}})), UsageError);
}

}  // namespace
}  // namespace defocus::engine
