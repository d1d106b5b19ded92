// Tests the public API without a GPU: scenes, settings, plans, and invalid requests.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "cli/two_quads.h"
#include "defocus/defocus.h"
#include "scene/scene.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Library : public testing::Test {
protected:
    void SetUp() override {
        writeTwoQuads(folder_ / "quads.gltf");
        request_.scene = folder_ / "quads.gltf";
        request_.cacheFolder = folder_ / "cache";
    }

    ScratchFolder folder_;
    Request request_;
};

TEST_F(Library, sceneInfoNamesWhatARequestMayName) {
    const SceneInfo info = defocus::Scene::load(request_.scene).info();
    EXPECT_EQ(info.cameras, std::vector<std::string>{"Main"});
    EXPECT_EQ(info.nodes, (std::vector<std::string>{"Near", "Far", "Tripod"}));
    EXPECT_TRUE(info.clips.empty());
    EXPECT_EQ(info.triangles, 2u);  // the mesh of two triangles counts once, although it is drawn twice
    EXPECT_TRUE(info.ignored.empty());
    EXPECT_EQ(defocus::Scene::schoolOfFish(3, 400).info().cameras.size(), 1u);
}

TEST_F(Library, scenesThatCannotBeOpened) {
    const std::string missing = messageOf<Error>([&] { (void)defocus::Scene::load(folder_ / "missing.glb"); });
    EXPECT_NE(missing.find("missing.glb"), std::string::npos) << missing;
    EXPECT_THROW((void)defocus::Scene::load(""), UsageError);
    EXPECT_THROW((void)defocus::Scene::schoolOfFish(0), UsageError);
    EXPECT_THROW((void)defocus::Scene::schoolOfFish(1, 3), UsageError);
}

TEST_F(Library, camerasInMemoryHaveALens) {
    const std::array<float, 3> corners[] = {{-1, -1, -3}, {1, -1, -3}, {0, 1, -3}};
    const MeshData meshes[] = {{.name = "Sail", .positions = corners}};
    const InstanceData instances[] = {{.mesh = 0}};
    CameraData camera{.name = "Main", .transform = lookAt({0, 0, 4}, {0, 0, 0}), .focusDistance = 300};
    camera.lens.fStop = 1.4;
    camera.lens.focalLength = 85;
    camera.lens.focusRangeFront = 0.5;
    const auto create = [&] {
        return defocus::Scene::create(
            {.meshes = meshes, .instances = instances, .cameras = std::span(&camera, 1), .metresPerUnit = 0.01});
    };
    const auto& lens = create().engineScene()->cameras.at(0).lens;
    EXPECT_EQ(lens.at("fStop"), 1.4);
    EXPECT_EQ(lens.at("focalLength"), 85);
    EXPECT_EQ(lens.at("focusDistance"), 300);
    EXPECT_EQ(lens.at("focusRangeFront"), 50) << "metres become scene units";
    camera.lens.fStop = 0;
    const std::string refused = messageOf<UsageError>([&] { static_cast<void>(create()); });
    EXPECT_TRUE(refused.starts_with("camera 'Main' (0): fStop must be")) << refused;
    camera.lens = {};
    camera.lens.apertureImage = "heart.png";
    EXPECT_THROW(static_cast<void>(create()), UsageError);
}

TEST(LookAt, placesACameraInFrontOfItsTarget) {
    const Matrix4 matrix = lookAt({1, 2, 3}, {1, 2, -5});
    EXPECT_EQ(matrix, (Matrix4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
    const Matrix4 down = lookAt({0, 4, 0}, {0, 0, 0}, {0, 0, -1});
    EXPECT_EQ(down, (Matrix4{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 4, 0, 1}));
    EXPECT_THROW(lookAt({0, 0, 0}, {0, 0, 0}), UsageError);
    EXPECT_THROW(lookAt({0, 4, 0}, {0, 0, 0}), UsageError);
    EXPECT_THROW(lookAt({0, nan, 0}, {0, 0, 0}), UsageError);
}

TEST_F(Library, settingsByNameAreThoseOfTheStruct) {
    setSetting(request_, "fStop", "1.4");
    setSetting(request_, "size", "64x48");
    setSetting(request_, "lod", "off");
    setSetting(request_, "far-components", "5");
    EXPECT_EQ(request_.lens.fStop, 1.4);
    EXPECT_EQ(request_.size.width, 64);
    EXPECT_EQ(request_.size.height, 48);
    EXPECT_EQ(request_.lod, LodMode::off);
    EXPECT_EQ(request_.methodSettings.at("far-components"), "5");
    const std::string unknown = messageOf<UsageError>([&] { setSetting(request_, "fStopp", "2"); });
    EXPECT_NE(unknown.find("fStop"), std::string::npos) << unknown;
    const std::string outside = messageOf<UsageError>([&] { setSetting(request_, "samples", "0"); });
    EXPECT_TRUE(outside.starts_with("samples: ")) << outside;
}

TEST_F(Library, planListsEachObject) {
    const Plan planned = plan(request_);
    ASSERT_EQ(planned.objects.size(), 2u);
    EXPECT_GT(planned.trianglesDrawn, 0u);
    EXPECT_LE(planned.objects[0].nearestDepth, planned.objects[1].nearestDepth);
    const json document = json::parse(toJson(planned));
    EXPECT_EQ(document.at("objects").size(), 2u);
    EXPECT_EQ(document.at("samples"), planned.samples);
    EXPECT_EQ(document.at("objects")[0].at("lambda"), planned.objects[0].lambda);
    EXPECT_FALSE(document.at("objects")[0].contains("boundaryShare"));
    EXPECT_EQ(document.at("lens").at("fStop"), planned.lens.fStop);
}

TEST_F(Library, planOfContinuousLevelsHasBoundaryShares) {
    request_.scene.clear();
    request_.fishCount = 2;
    request_.trianglesPerFish = 2000;
    request_.lod = LodMode::continuous;
    request_.lens.fStop = 0.5;
    const Plan planned = plan(request_);
    const json document = json::parse(toJson(planned));
    EXPECT_EQ(document.at("lod").at("mode"), "continuous");
    bool anyShared = false;
    for (std::size_t i = 0; i < planned.objects.size(); ++i) {
        const PlannedObject& object = planned.objects[i];
        const json& written = document.at("objects")[i];
        ASSERT_EQ(written.contains("boundaryShare"), object.boundaryShare.has_value());
        if (!object.boundaryShare) continue;
        anyShared = true;
        EXPECT_EQ(written.at("boundaryShare"), *object.boundaryShare);
    }
    EXPECT_TRUE(anyShared);
}

TEST_F(Library, pyramidsListEachLevel) {
    request_.scene.clear();
    request_.fishCount = 2;
    request_.trianglesPerFish = 600;
    const std::vector<defocus::Pyramid> built = pyramids(request_);
    ASSERT_EQ(built.size(), 2u);
    for (const defocus::Pyramid& pyramid : built) {
        ASSERT_GT(pyramid.levels.size(), 1u);
        EXPECT_EQ(pyramid.levels[0].error, 0);
        for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
            EXPECT_LT(pyramid.levels[l].triangles, pyramid.levels[l - 1].triangles);
            EXPECT_GT(pyramid.levels[l].meanEdge, pyramid.levels[l - 1].meanEdge);
        }
    }
    const json meshes = json::parse(toJson(built)).at("meshes");
    ASSERT_EQ(meshes.size(), 2u);
    EXPECT_EQ(meshes[1].at("levels").size(), built[1].levels.size());
    EXPECT_EQ(meshes[1].at("levels")[1].at("triangles"), built[1].levels[1].triangles);
}

TEST_F(Library, progressMayCancelAPlan) {
    struct Cancelled {};
    EXPECT_THROW(plan(request_, [](auto...) { throw Cancelled(); }), Cancelled);
}

// A function that sets an invalid value in a request, bypassing the checks of the text parser. The error message begins
// with `name`.
struct BadValue {
    const char* name;
    std::function<void(Request&)> set;
};

TEST_F(Library, valuesOutOfRangeAreUsageErrorsThatNameThem) {
    const std::vector<BadValue> values = {
        {"fStop", [](Request& r) { r.lens.fStop = 0; }},
        {"fStop", [](Request& r) { r.lens.fStop = nan; }},
        {"fStop", [](Request& r) { r.lens.fStop = 1e300; }},
        {"focusDistance", [](Request& r) { r.focus = FocusDistance{-1}; }},
        {"focusDistance", [](Request& r) { r.focus = FocusDistance{infinity}; }},
        {"bladeCount", [](Request& r) { r.lens.bladeCount = 2; }},
        {"bladeCount", [](Request& r) { r.lens.bladeCount = -5; }},
        {"nodeBlur", [](Request& r) { r.nodeBlur["Near"] = -1; }},
        {"size", [](Request& r) { r.size.width = 0; }},
        {"size", [](Request& r) { r.size.height = -3; }},
        {"size", [](Request& r) { r.size.width = maxImageSide + 1; }},
        {"samples", [](Request& r) { r.samples = maxSamples + 1; }},
        {"cocTolerance", [](Request& r) { r.cocTolerance = 0; }},
        {"cocTolerance", [](Request& r) { r.cocTolerance = nan; }},
        {"blurThreshold", [](Request& r) { r.blurThreshold = -0.1; }},
        {"lightThreshold", [](Request& r) { r.lightThreshold = -0.1; }},
        {"lod", [](Request& r) { r.lod = static_cast<LodMode>(17); }},
        {"sequence", [](Request& r) { r.sequence = static_cast<Sequence>(-1); }},
        {"layerFormat", [](Request& r) { r.layerFormat = static_cast<LayerFormat>(99); }},
        {"wave", [](Request& r) { r.wave = 65; }},
        {"threads", [](Request& r) { r.threads = 65; }},
        {"memory", [](Request& r) { r.memory = 0; }},
        {"time", [](Request& r) { r.time = infinity; }},
        {"shutter", [](Request& r) { r.shutter = -1; }},
        {"motionSegments", [](Request& r) { r.motionSegments = 0u; }},
        {"cameraPosition",
         [](Request& r) {
             r.cameraPosition = Vector3{0, nan, 0};
         }},
        {"focusPixel",
         [](Request& r) {
             r.focus = FocusPixel{{-1, 0}};
         }},
        {"background",
         [](Request& r) {
             r.background = Color{0, -1, 0};
         }},
        {"fishCount", [](Request& r) { r.fishCount = -1; }},
        {"exposure", [](Request& r) { r.exposure = ExposureValue{nan}; }},
        {"method", [](Request& r) { r.method = "none such"; }},
        {"method", [](Request& r) { r.methodSettings["far-components"] = "5"; }},  // a setting of another method
    };
    for (const BadValue& value : values) {
        Request request = request_;
        value.set(request);
        const std::string message = messageOf<UsageError>([&] { plan(request); });
        EXPECT_TRUE(message.starts_with(value.name)) << value.name << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

// A request with random values either throws an Error or gives a plan with finite numbers.
TEST_F(Library, anyRequestIsPlannedOrRefused) {
    std::mt19937 generator(3);
    const std::vector<double> numbers = {nan,  infinity, -infinity, 0, -0.0, -1,  1e-300,
                                         1e-9, 0.5,      1,         3, 64,   1e6, 1e300};
    const auto number = [&] { return numbers[generator() % numbers.size()]; };
    const auto integer = [&] {
        const std::vector<std::int64_t> integers = {-2147483648LL, -1, 0, 1, 2, 3, 63, 64, 16'384, 2147483647LL};
        return integers[generator() % integers.size()];
    };
    const std::vector<std::function<void(Request&)>> setters = {
        [&](Request& r) { r.lens.focalLength = number(); },
        [&](Request& r) { r.lens.fStop = number(); },
        [&](Request& r) { r.focus = FocusDistance{number()}; },
        [&](Request& r) { r.lens.horizontalAperture = number(); },
        [&](Request& r) { r.lens.blurScale = number(); },
        [&](Request& r) { r.lens.focusBreathing = true; },
        [&](Request& r) { r.lens.anamorphicRatio = number(); },
        [&](Request& r) { r.lens.bladeCount = static_cast<int>(integer()); },
        [&](Request& r) { r.lens.bladeCurvature = number(); },
        [&](Request& r) { r.lens.catEye = number(); },
        [&](Request& r) { r.lens.axialChromaticAberration = number(); },
        [&](Request& r) { r.lens.astigmatism = number(); },
        [&](Request& r) { r.lens.coma = number(); },
        [&](Request& r) { r.lens.foregroundLimit = number(); },
        [&](Request& r) { r.lens.focusRangeFront = number(); },
        [&](Request& r) { r.lens.focusRangeRefocuses = true; },
        [&](Request& r) { r.lens.focusTilt = number(); },
        [&](Request& r) { r.lens.fieldCurvature = number(); },
        [&](Request& r) { r.lens.radialBlurGain = number(); },
        [&](Request& r) { r.size.width = static_cast<int>(integer()); },
        [&](Request& r) { r.size.height = static_cast<int>(integer()); },
        [&](Request& r) { r.time = number(); },
        [&](Request& r) { r.shutter = number(); },
        [&](Request& r) {
            r.cameraPosition = Vector3{number(), number(), number()};
        },
        [&](Request& r) {
            r.cameraTarget = Vector3{number(), number(), number()};
        },
        [&](Request& r) {
            r.cameraUp = Vector3{number(), number(), number()};
        },
        [&](Request& r) {
            r.focus = FocusPixel{{static_cast<int>(integer()), static_cast<int>(integer())}};
        },
        [&](Request& r) { r.samples = static_cast<std::uint32_t>(integer() & 0xff); },
        [&](Request& r) { r.seed = static_cast<std::uint32_t>(integer()); },
        [&](Request& r) { r.sequence = static_cast<Sequence>(integer()); },
        [&](Request& r) { r.lod = static_cast<LodMode>(integer()); },
        [&](Request& r) { r.lodMetric = static_cast<LodMetric>(integer()); },
        [&](Request& r) { r.levelVertices = static_cast<LevelVertices>(integer()); },
        [&](Request& r) { r.blurThreshold = number(); },
        [&](Request& r) { r.sizeThreshold = number(); },
        [&](Request& r) { r.lightThreshold = number(); },
        [&](Request& r) { r.cocTolerance = number(); },
        [&](Request& r) { r.nodeBlur["Far"] = number(); },
        [&](Request& r) { r.camera = FramingCamera{}; },
    };
    int planned = 0;
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        Request request = request_;
        request.noCache = true;
        const std::size_t changes = 1 + generator() % 4;
        for (std::size_t k = 0; k < changes; ++k) setters[generator() % setters.size()](request);
        try {
            const json document = json::parse(toJson(plan(request)));
            EXPECT_TRUE(document.at("triangles").is_object());
            ++planned;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(planned, 50);
    EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace defocus::engine
