// Tests that the time of a render grows in proportion to the number of roots, nodes, materials and meshes of its file,
// and that extreme lens values in a file do not make a render much slower.

#include <ctime>
#include <functional>

#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

struct Parts {
    const char* name;
    std::function<void(GltfBuilder& builder, int count)> add;  // adds `count` roots, nodes, materials or meshes
};

void PrintTo(const Parts& parts, std::ostream* out) {
    *out << parts.name;
}

nlohmann::json nodeAt(int part, int mesh = 0) {
    return {{"mesh", mesh}, {"translation", {2 * (part % 100), 2 * (part / 100), 0}}};
}

void addRoots(GltfBuilder& builder, int count) {
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    for (int i = 1; i < count; ++i) builder.add("nodes", nodeAt(i));
}

void addChain(GltfBuilder& builder, int count) {
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    for (int i = 1; i < count; ++i) builder.add("nodes", {{"mesh", 0}, {"translation", {0.01, 0, 0}}});
    for (int i = 1; i < count; ++i) builder.json["nodes"][static_cast<std::size_t>(i) - 1]["children"] = {i};
}

void addMaterials(GltfBuilder& builder, int count) {
    const int positions = builder.positions(unitTriangle);
    nlohmann::json primitives;
    for (int i = 0; i < count; ++i) {
        builder.add("materials", {{"pbrMetallicRoughness", {{"roughnessFactor", i / double(count)}}}});
        primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"material", i}});
    }
    builder.mesh(primitives);
}

void addMeshes(GltfBuilder& builder, int count) {
    const nlohmann::json primitives = {{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}};
    builder.mesh(primitives);
    for (int i = 1; i < count; ++i) {
        builder.add("meshes", {{"primitives", primitives}});
        builder.add("nodes", nodeAt(i, i));
    }
}

class ManyParts : public OwnContextTest, public testing::WithParamInterface<Parts> {
protected:
    // Returns the CPU seconds, summed over all cores, of a render of a file with `count` nodes, materials or meshes.
    static double cost(int count) {
        GltfBuilder builder;
        GetParam().add(builder, count);
        const ScratchFolder folder;
        Request request;
        request.scene = folder / "parts.glb";
        GltfBuilder::save(request.scene, builder.glb());
        request.size = {32, 24};
        request.samples = 1;
        request.noCache = true;
        const std::clock_t begin = std::clock();
        static_cast<void>(render(request));
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }
};

// Eight times the count may take 17.6 times as long: a factor of 2.6 for each doubling. A quadratic cost would grow by
// a factor of 64.
TEST_P(ManyParts, costInProportion) {
    static_cast<void>(cost(100));  // compiles the shaders
    const double few = std::min(cost(1'000), cost(1'000));
    const double many = std::min(cost(8'000), cost(8'000));
    EXPECT_LE(many, 17.6 * few);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ManyParts,
                         testing::Values(Parts{"roots", addRoots}, Parts{"chain", addChain},
                                         Parts{"materials", addMaterials}, Parts{"meshes", addMeshes}),
                         [](const auto& parts) { return std::string(parts.param.name); });

class ExtremeLens : public OwnContextTest {};

// The triangle's blur disk has millions of times the area of the image, so hardly any of 1,024 samples would show the
// triangle.
TEST_F(ExtremeLens, takesFewSamples) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}}});
    builder.add("cameras", {{"type", "perspective"},
                            {"perspective", {{"yfov", 0.6}, {"znear", 0.01}}},
                            {"extras",
                             {{"fieldCurvature", 1000},
                              {"radialBlurGain", 1000},
                              {"coma", 100},
                              {"astigmatism", -100},
                              {"focusTilt", 89.9},
                              {"axialChromaticAberration", 100},
                              {"fStop", 0.001},
                              {"focusDistance", 2}}}});
    builder.add("nodes", {{"camera", 0}, {"translation", {0.3, 0.3, 3}}});
    const ScratchFolder folder;
    Request request;
    request.scene = folder / "lens.glb";
    GltfBuilder::save(request.scene, builder.glb());
    request.size = {64, 48};
    request.noCache = true;
    SceneRenderer renderer(request);
    renderer.start();
    while (renderer.advance()) {
    }
    EXPECT_LE(renderer.samples(), 64u);
}

}  // namespace
}  // namespace defocus::engine
