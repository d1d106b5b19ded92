// Compares images refocused from lens images (views from lens points) with direct renders of the built-in school of
// fish.

#include <glm/geometric.hpp>

#include "image/image_io.h"
#include "plan/frame_plan.h"
#include "refocus/focal_stack.h"
#include "refocus/lens_images.h"
#include "render/accumulation/accumulation.h"
#include "render/rendered.h"

namespace defocus::engine {
namespace {

// The accumulation method stores the image of each sample in half floats. With a transparent background, nothing is
// added to these values afterwards, so a file of lens images (views from lens points) stores them without loss.
TEST_F(LightFieldTest, atTheRenderedFocusHasTheBitsOfAccumulation) {
    Request request = smallSchool();
    request.background = TransparentBackground{};
    request.samples = 100;  // more than one block of 64 samples
    LightField field(lensImages(request, FocusRange{1.5, 3}));
    const LightFieldInfo& info = field.info();
    ASSERT_EQ(info.points.size(), 100u);

    const auto context = createHeadlessContext();
    PreparedFrame frame = prepareFrame(request);
    RenderSettings settings = frame.settings;
    settings.refocus = info.range;
    const FramePlan plan = planFrame(frame.world, withMargin(frame.view, info.size.margin), settings);
    const Image image = imageOf(*makeAccumulationRenderer(frame.world, {}), plan);
    EXPECT_EQ(refocused(field, asRendered(info)).pixels, within(image, info.size.margin).pixels);
}

// In coordinates of the unit disk, point p of the wide lens is point 2·p of the lens that is stopped down by two stops.
TEST_F(LightFieldTest, stoppingDownIsARenderOfTheRemainingSamples) {
    Request request = smallSchool();
    request.samples = 256;
    request.lod = LodMode::off;
    LightField field(lensImages(request, FocusRange{2, 2}));
    Refocusing refocusing = asRendered(field.info());
    refocusing.fStop = 1.9;
    const Image stopped = refocused(field, refocusing);

    const auto context = createHeadlessContext();
    request.lens.fStop = 1.9;
    PreparedFrame frame = prepareFrame(request);
    std::vector<LensSample> remaining = lensSamples(Lens(), Sequence::sobol, 0, 256, 0);
    std::erase_if(remaining, [](const LensSample& sample) { return glm::length(sample.lens) > 0.5f; });
    for (LensSample& sample : remaining) sample.lens *= 2;
    RenderSettings settings = frame.settings;
    settings.sampleCount = static_cast<std::uint32_t>(remaining.size());
    FramePlan plan = planFrame(frame.world, withMargin(frame.view, field.info().size.margin), settings);
    plan.samples = remaining;
    const Image image = imageOf(*makeAccumulationRenderer(frame.world, {}), plan);
    EXPECT_NEAR(static_cast<double>(remaining.size()), 64, 3);
    EXPECT_GT(compareImages(within(image, field.info().size.margin), stopped).psnr, 60);
}

TEST_F(LightFieldTest, findsTheFocusOfAPixel) {
    Request request = smallSchool();
    LightField field(lensImages(request, {}));
    request.focus = FocusPixel{{64, 48}};
    SceneDriver driver(nullptr, request, {}, {});
    EXPECT_NEAR(focusAtPixel(field, {64, 48}), driver.frame().view.lens.focusDistance, 0.03);
    EXPECT_THROW(focusAtPixel(field, {128, 0}), Error);
}

// The image with everything in focus equals an antialiased pinhole image. Only outlines may differ, where the surface
// is visible from only a few lens points.
TEST_F(LightFieldTest, theSharpPictureIsThatOfAPinhole) {
    Request request = smallSchool();
    request.lod = LodMode::off;
    LightField field(lensImages(request, FocusRange{1.5, 3}));
    const Image sharp = allInFocus(field);
    Request pinhole = request;
    pinhole.lens.dofEnabled = false;
    EXPECT_GT(compareImages(render(pinhole), sharp).psnr, 30);
    const Image depth = centralDepth(field);
    EXPECT_EQ(*depth.at(64, 48), static_cast<float>(focusAtPixel(field, {64, 48})));
}

TEST_F(LightFieldTest, refusesObjectsWithTheirOwnBlur) {
    Request request = smallSchool();
    request.nodeBlur["0"] = 0.5;
    EXPECT_NE(refusalOf(request).find("--node-blur"), std::string::npos);
}

TEST_F(LightFieldTest, refusesDamagedFiles) {
    Request request = smallSchool();
    request.samples = 4;
    const std::filesystem::path path = lensImages(request, FocusRange{2, 2});
    const auto size = std::filesystem::file_size(path);
    const auto messageAfter = [&](std::uintmax_t bytes) -> std::string {
        std::filesystem::resize_file(path, bytes);
        try {
            LightField field(path);
            refocused(field, asRendered(field.info()));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    for (const std::uintmax_t bytes :
         {size - 100, size / 2, std::uintmax_t{3000}, std::uintmax_t{100}, std::uintmax_t{0}}) {
        const std::string message = messageAfter(bytes);
        EXPECT_NE(message.find("a.lens.exr"), std::string::npos) << bytes << " bytes: " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    writeImage(path, Image(4, 4, 4), Metadata());
    EXPECT_THROW(LightField{path}, Error);
}

}  // namespace
}  // namespace defocus::engine
