// Tests that SceneRenderer renders frames of a scene in its own OpenGL context.

#include <epoxy/egl.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "cli/two_quads.h"
#include "frame/driver/small_request.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "render/methods.h"

namespace defocus::engine {
namespace {

TEST_F(SceneRendererTest, stepsEndInTheImageOfRender) {
    const Image full = render(smallRequest());
    ASSERT_EQ(full.width, 96);
    ASSERT_EQ(full.height, 72);
    ASSERT_EQ(full.channels, 4);
    EXPECT_GT(std::set<float>(full.pixels.begin(), full.pixels.end()).size(), 100u);  // the image is not empty

    SceneRenderer renderer(smallRequest());
    EXPECT_EQ(renderer.samples(), 0u);
    renderer.start();
    EXPECT_EQ(renderer.sampleTotal(), 16u);
    std::vector<std::uint32_t> steps;
    bool more = true;
    while (more) {
        more = renderer.advance();
        steps.push_back(renderer.samples());
        EXPECT_FALSE(renderer.image().empty());
    }
    EXPECT_EQ(steps, (std::vector<std::uint32_t>{4, 8, 12, 16}));
    EXPECT_EQ(renderer.image().pixels, full.pixels);
    const RenderStatistics statistics = renderer.statistics();
    EXPECT_EQ(statistics.samples, 16u);
    EXPECT_GT(statistics.trianglesDrawn, 0u);
    EXPECT_GT(statistics.trianglesAtFullDetail, statistics.trianglesDrawn);
    EXPECT_GT(statistics.gpuBytes, 0u);
    EXPECT_FALSE(statistics.device.empty());
}

// Methods that draw one subpixel position per sample ignore a request for four.
TEST_F(SceneRendererTest, otherMethodsHaveOnePosition) {
    for (const Method& method : methods()) {
        if (method.drawsPositions) continue;
        Request one = smallRequest();
        one.method = method.name;
        Request four = one;
        four.positions = 4;
        EXPECT_EQ(render(four).pixels, render(one).pixels) << method.name;
    }
}

// Each of several frames that one renderer draws equals the image of a new renderer.
TEST_F(SceneRendererTest, everyFrameIsThatOfAFreshRenderer) {
    std::vector<Request> requests(11, smallRequest());
    requests[1] = movedRequest();
    requests[2].lod = LodMode::off;
    requests[4].method = "circular";
    requests[5].background = Color{0.5f, 0.25f, 0.125f};
    requests[6].size.width = 64;
    requests[6].layerFormat = LayerFormat::rgba32f;
    requests[7] = movedRequest();
    requests[7].lod = LodMode::off;
    // Requests 8 and 10 need pyramids with LevelVertices::surviving. The default is LevelVertices::fitted.
    requests[8].levelVertices = LevelVertices::surviving;
    requests[10] = requests[8];
    SceneRenderer renderer(requests[0]);
    for (std::size_t i = 0; i < requests.size(); ++i)
        EXPECT_EQ(renderer.render(requests[i]).pixels, render(requests[i]).pixels) << "request " << i;
    EXPECT_NE(render(requests[0]).pixels, render(requests[1]).pixels);
    EXPECT_NE(render(requests[0]).pixels, render(requests[2]).pixels);
    EXPECT_NE(render(requests[0]).pixels, render(requests[8]).pixels);
}

// By default, levels of the preset jeong2011 change the image. With a blur threshold of 0, it equals full detail.
TEST_F(SceneRendererTest, publishedLevelsEndInFullDetail) {
    Request published = smallRequest();
    setSetting(published, "preset", "jeong2011");
    published.lens.fStop = 0.3;
    Request sharp = published;
    sharp.lod = LodMode::off;
    const Image fullDetail = render(sharp);
    EXPECT_NE(render(published).pixels, fullDetail.pixels);
    published.blurThreshold = 0;
    EXPECT_EQ(render(published).pixels, fullDetail.pixels);
    // Without depth of field, all objects are drawn at full detail.
    published.lens.dofEnabled = sharp.lens.dofEnabled = false;
    published.blurThreshold = 1000;
    EXPECT_EQ(render(published).pixels, render(sharp).pixels);
}

TEST_F(SceneRendererTest, pyramidsAreBuiltWhereThereAreNone) {
    std::vector<std::string> stages;
    const Progress progress = [&](std::string_view stage, auto...) {
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    };
    const auto stagesOf = [&](SceneRenderer& renderer, const Request& request) {
        stages.clear();
        renderer.render(request, progress);
        return stages;
    };
    using Stages = std::vector<std::string>;
    Request sharp = smallRequest();
    sharp.lod = LodMode::off;
    SceneRenderer renderer(sharp);
    const double before = renderer.statistics().pyramidMilliseconds;
    EXPECT_EQ(stagesOf(renderer, sharp), Stages{"samples"});
    EXPECT_EQ(stagesOf(renderer, smallRequest()), (Stages{"pyramids", "samples"}));
    EXPECT_GT(renderer.statistics().pyramidMilliseconds, before);
    EXPECT_EQ(stagesOf(renderer, movedRequest()), Stages{"samples"});
    EXPECT_EQ(stagesOf(renderer, sharp), Stages{"samples"});
    EXPECT_EQ(stagesOf(renderer, movedRequest()), Stages{"samples"});  // pyramids are kept while the level mode is off
}

TEST_F(SceneRendererTest, aProgressThatThrowsCancelsAndTheRendererGoesOn) {
    struct Cancelled {};
    const Image full = render(smallRequest());
    SceneRenderer renderer(smallRequest());
    EXPECT_THROW(renderer.render([](std::string_view, std::uint64_t done, std::uint64_t) {
        if (done >= 8) throw Cancelled();
    }),
                 Cancelled);
    EXPECT_EQ(renderer.samples(), 8u);
    EXPECT_FALSE(renderer.image().empty());
    EXPECT_EQ(renderer.render().pixels, full.pixels);
    EXPECT_THROW(SceneRenderer(smallRequest(), [](auto...) { throw Cancelled(); }), Cancelled);

    // The renderer remains usable after its first build of pyramids was cancelled.
    Request sharp = smallRequest();
    sharp.lod = LodMode::off;
    SceneRenderer late(sharp);
    const Image sharpImage = late.render();
    EXPECT_THROW(late.render(smallRequest(), [](auto...) { throw Cancelled(); }), Cancelled);
    EXPECT_EQ(late.image().pixels, sharpImage.pixels);  // the previous frame is still available
    EXPECT_EQ(late.render(smallRequest()).pixels, full.pixels);
}

TEST_F(SceneRendererTest, aStopThatIsAskedForEndsWithWhatThereIs) {
    SceneRenderer renderer(smallRequest());
    std::stop_source stop;
    const Image early = renderer.render(
        [&](std::string_view, std::uint64_t done, std::uint64_t) {
            if (done == 8) stop.request_stop();
        },
        stop.get_token());
    EXPECT_EQ(early.width, 96);
    EXPECT_EQ(renderer.samples(), 8u);
    EXPECT_EQ(renderer.render({}, stop.get_token()).width, 96);
    EXPECT_EQ(renderer.samples(), 4u);
}

TEST_F(SceneRendererTest, faultsLeaveTheFrameBeforeAsItIs) {
    SceneRenderer renderer(smallRequest());
    EXPECT_THROW(static_cast<void>(renderer.image()), Error);
    EXPECT_THROW(renderer.advance(), Error);
    EXPECT_THROW(static_cast<void>(renderer.aovs()), Error);
    EXPECT_THROW(static_cast<void>(renderer.plan()), Error);
    renderer.start();
    EXPECT_THROW(static_cast<void>(renderer.image()), Error);  // throws, since no sample has been rendered
    const Image full = renderer.render();

    std::vector<Request> bad(5, smallRequest());
    bad[0].fishCount = 3;  // another number of fish is another scene, which this renderer cannot draw
    bad[1].camera = NamedCamera{"none such"};
    bad[2].samples = 65'537;
    bad[3].environment = folder_ / "missing.hdr";
    bad[4].nodeBlur["none such"] = 1;
    for (const Request& request : bad) EXPECT_THROW(renderer.start(request), Error);
    EXPECT_EQ(renderer.image().pixels, full.pixels);
}

TEST_F(SceneRendererTest, aSceneIsSharedAndNobodyChangesIt) {
    const defocus::Scene school = defocus::Scene::schoolOfFish(2, 1'000);
    const std::string fish = school.info().nodes.front();
    const Image plain = render(smallRequest());
    Request sharp = smallRequest();
    for (const std::string& name : school.info().nodes)
        if (!name.empty()) sharp.nodeBlur[name] = 0;
    SceneRenderer first(school, sharp);
    SceneRenderer second(school, smallRequest());
    EXPECT_EQ(first.scene().engineScene(), school.engineScene());
    const Image sharpImage = first.render();
    EXPECT_NE(sharpImage.pixels, plain.pixels);
    EXPECT_EQ(second.render().pixels, plain.pixels);
    EXPECT_EQ(first.render(smallRequest()).pixels, plain.pixels);
    EXPECT_EQ(first.render(sharp).pixels, sharpImage.pixels);
}

TEST_F(SceneRendererTest, aovsPlanAndFilesAreOfTheFrame) {
    writeTwoQuads(folder_ / "quads.gltf");
    Request request;
    request.scene = folder_ / "quads.gltf";
    request.noCache = true;
    request.size.width = 64;
    request.size.height = 48;
    request.samples = 4;
    request.lens.fStop = 0.2;  // an aperture so wide that the plan does not use a pinhole
    request.focus = FocusDistance{4};
    SceneRenderer renderer(request);
    const Image image = renderer.render();
    const Aovs aovs = renderer.aovs();
    EXPECT_EQ(aovs.depth.width, 64);
    EXPECT_EQ(aovs.depth.channels, 1);
    // The centre of the square "Near", 0.3 m above the axis at a depth of 2 m, is 13 px above the centre row.
    EXPECT_NEAR(*aovs.depth.at(32, 11), 2, 1e-4);
    EXPECT_EQ(*aovs.depth.at(2, 45), std::numeric_limits<float>::infinity());
    EXPECT_EQ(*aovs.level.at(2, 45), -1);
    EXPECT_LT(*aovs.coc.at(32, 11), 0);
    EXPECT_GT(*aovs.coc.at(2, 45), 0);
    EXPECT_EQ(renderer.plan().objects.size(), 2u);
    EXPECT_EQ(toJson(renderer.plan()), toJson(plan(request)));

    renderer.write(folder_ / "a.exr", image);
    Metadata metadata;
    EXPECT_EQ(readImage(folder_ / "a.exr", metadata).pixels, image.pixels);
    EXPECT_EQ(std::get<std::string>(metadata.at("cameraLabel")), "Main");
    EXPECT_EQ(std::get<std::string>(metadata.at("defocus:scene")), "quads.gltf");
    EXPECT_TRUE(renderer.warnings().empty());
}

// ---- contexts and threads -----------------------------------------------------------------------------------------

TEST_F(SceneRendererTest, theCallersContextIsCurrentAfterEachCall) {
    const std::unique_ptr<GlContext> callers = createHeadlessContext();
    const EGLContext own = eglGetCurrentContext();
    ASSERT_NE(own, EGL_NO_CONTEXT);
    const auto check = [&](const char* call) { EXPECT_EQ(eglGetCurrentContext(), own) << call; };
    {
        // Worker threads, which have no OpenGL context, also report progress; only the caller's reports are checked.
        const std::thread::id caller = std::this_thread::get_id();
        SceneRenderer renderer(smallRequest(), [&](auto...) {
            if (std::this_thread::get_id() == caller) check("progress of the constructor");
        });
        check("constructor");
        renderer.start();
        check("start");
        renderer.advance();
        check("advance");
        static_cast<void>(renderer.image());
        check("image");
        static_cast<void>(renderer.statistics());
        check("statistics");
        static_cast<void>(renderer.aovs());
        check("aovs");
        Request bad = smallRequest();
        bad.camera = NamedCamera{"none such"};
        EXPECT_THROW(renderer.start(bad), Error);
        check("start that throws");
        renderer.render([&](auto...) { check("progress"); });
        check("render");
        renderer.write(folder_ / "a.png", renderer.image());
        check("write");
    }
    check("destructor");
}

TEST_F(SceneRendererTest, noContextIsCurrentWhereNoneWas) {
    ASSERT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    {
        SceneRenderer renderer(smallRequest());
        EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
        renderer.render();
        EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    }
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
}

TEST_F(SceneRendererTest, interleavedRenderersDrawWhatTheyDrawAlone) {
    const Image one = render(smallRequest());
    const Image other = render(movedRequest());
    SceneRenderer first(smallRequest());
    SceneRenderer second(movedRequest());
    first.start();
    second.start();
    bool more = true;
    while (more) {
        const bool firstMore = first.advance();
        more = second.advance() || firstMore;
    }
    EXPECT_EQ(first.image().pixels, one.pixels);
    EXPECT_EQ(second.image().pixels, other.pixels);
}

TEST_F(SceneRendererTest, anotherThreadMayGoOn) {
    const Image full = render(smallRequest());
    auto renderer = std::make_unique<SceneRenderer>(smallRequest());
    renderer->start();
    renderer->advance();
    Image image;
    std::thread([&] {
        while (renderer->advance()) {
        }
        image = renderer->image();
    }).join();
    EXPECT_EQ(image.pixels, full.pixels);
    EXPECT_EQ(renderer->render().pixels, full.pixels);
    std::thread([&] { renderer.reset(); }).join();
}

TEST_F(SceneRendererTest, threadsMayRenderAtOnce) {
    const Image one = render(smallRequest());
    const Image other = render(movedRequest());
    Image first;
    Image second;
    std::thread a([&] { first = render(smallRequest()); });
    std::thread b([&] { second = render(movedRequest()); });
    a.join();
    b.join();
    EXPECT_EQ(first.pixels, one.pixels);
    EXPECT_EQ(second.pixels, other.pixels);
}

}  // namespace
}  // namespace defocus::engine
