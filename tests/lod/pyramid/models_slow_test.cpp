// Tests that real models with all kinds of surfaces yield valid pyramids.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lod/invariants.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/pyramid.h"
#include "lod/pyramid/surface_distance.h"
#include "lod/simplify/manifold.h"
#include "models.h"
#include "scene/gltf/gltf.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

bool isModel(const fs::path& path) {
    return path.extension() == ".glb" || path.extension() == ".gltf";
}

// Returns the path of each public model once, even if both folders contain the model.
std::vector<fs::path> publicModels() {
    std::vector<fs::path> models;
    for (const fs::path& folder : {keptModelsDirectory(), modelsDirectory()}) {
        if (!fs::exists(folder)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const fs::path& path = entry.path();
            const bool valid = isModel(path) && path.parent_path().filename() != "invalid";
            if (valid && modelPath(path.lexically_relative(folder)) == path) models.push_back(path);
        }
    }
    std::sort(models.begin(), models.end());
    return models;
}

struct BuiltModel {
    std::vector<Mesh> meshes;
    std::vector<Pyramid> pyramids;
};

// Returns a model with its pyramids, which are built once per process.
const BuiltModel& built(const fs::path& path) {
    static std::map<fs::path, BuiltModel> known;
    const auto found = known.find(path);
    if (found != known.end()) return found->second;
    BuiltModel model;
    model.meshes = loadGltf(path).meshes;
    model.pyramids = buildPyramids(model.meshes);
    return known.emplace(path, std::move(model)).first->second;
}

TEST(RealModels, AllBecomePyramids) {
    const std::vector<fs::path> models = publicModels();
    EXPECT_GE(models.size(), 15u);
    for (const fs::path& path : models) {
        SCOPED_TRACE(path.filename().string());
        const auto& [meshes, pyramids] = built(path);
        ASSERT_EQ(pyramids.size(), meshes.size());
        for (std::size_t m = 0; m < pyramids.size(); ++m) {
            SCOPED_TRACE(testing::Message() << "mesh " << m << " " << meshes[m].name);
            expectPyramidInvariants(meshes[m], pyramids[m]);
            if (pyramids[m].levels.size() == 1) continue;  // no half-edge structure was built, so nothing was repaired
            EXPECT_EQ(pyramids[m].repairedFaces, repairsOf(meshes[m]).faces);
        }
    }
}

// Compares the stored error of each level with a far denser measurement. The ratio of the stored to the measured error
// is at least 0.9, and its median is below 1.3.
TEST(RealModels, StoredErrorsAreThoseOfTheFittedSurfaces) {
    constexpr std::size_t points = 8'192;
    const std::vector<fs::path> models = publicModels();
    std::vector<double> ratios;
    for (const fs::path& path : models) {
        const auto& [meshes, pyramids] = built(path);
        for (std::size_t m = 0; m < pyramids.size(); ++m) {
            const Pyramid& pyramid = pyramids[m];
            const Surface mesh = prepareSurface(pyramid.levels[0].positions, levelIndices(pyramid, 0));
            for (const std::size_t l : {1u, 2u, 5u, 8u}) {
                if (l >= pyramid.levels.size()) continue;
                const PyramidLevel& level = pyramid.levels[l];
                const Surface surface = prepareSurface(level.positions, levelIndices(pyramid, l));
                const double measured = surfaceDistance(mesh, surface, points).both.percentile99;
                EXPECT_GE(level.error, 0.9 * measured)
                    << path.filename().string() << " mesh " << m << " " << meshes[m].name << " level " << l;
                if (measured > 0) ratios.push_back(level.error / measured);
            }
        }
    }
    ASSERT_FALSE(ratios.empty());
    std::sort(ratios.begin(), ratios.end());
    const double median = ratios[ratios.size() / 2];
    RecordProperty("median_stored_to_measured", std::to_string(median));
    EXPECT_LT(median, 1.3);
}

TEST(RealModels, ClosedScansComeDownToTheFloor) {
    for (const char* name : {"skull.glb", "hammer.glb"}) {
        DEFOCUS_MODEL_OR_SKIP(path, name);
        const Pyramid& pyramid = built(path).pyramids.at(0);
        ASSERT_TRUE(isClosed(pyramid.vertices.positions, levelIndices(pyramid, 0))) << name;
        EXPECT_EQ(pyramid.levels.back().triangleCount, 64u) << name;
    }
}

TEST(RealModels, ClosedMeshesStayClosed) {
    const std::vector<fs::path> models = publicModels();
    std::size_t closed = 0;
    for (const fs::path& path : models) {
        const auto& [meshes, pyramids] = built(path);
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            const Mesh& mesh = meshes[m];
            std::vector<std::uint32_t> indices;
            for (const Primitive& primitive : mesh.primitives)
                indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
            if (indices.empty() || !isClosed(mesh.vertices.positions, indices)) continue;
            ++closed;
            const Pyramid& pyramid = pyramids.at(m);
            for (std::size_t l = 1; l < pyramid.levels.size(); ++l)
                EXPECT_TRUE(isClosed(pyramid.levels[l].positions, levelIndices(pyramid, l)))
                    << path.filename().string() << " mesh " << mesh.name << " level " << l;
        }
    }
    RecordProperty("closed_meshes", std::to_string(closed));
    EXPECT_GT(closed, 0u);
}

// The leather cap keeps its shape in every level in which its straps have more triangles than the cap. The cap has four
// fifths of the area. The straps have the most triangles, because simplification preserves their many holes.
TEST(RealModels, LeatherCapOutlastsItsStraps) {
    DEFOCUS_MODEL_OR_SKIP(path, "FlightHelmet/FlightHelmet.gltf");
    const auto& [meshes, pyramids] = built(path);
    const auto leather =
        std::find_if(meshes.begin(), meshes.end(), [](const Mesh& mesh) { return mesh.name == "LeatherParts_low"; });
    ASSERT_NE(leather, meshes.end());
    expectMainPartLasts(*leather, pyramids.at(static_cast<std::size_t>(leather - meshes.begin())));
}

TEST(RealModels, OpenMountainKeepsItsOutline) {
    // Each side of the mountain's bounding box moves inwards by at most the stored error.
    DEFOCUS_MODEL_OR_SKIP(path, "mountain.glb");
    const Pyramid& pyramid = built(path).pyramids.at(0);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        Bounds bounds;
        for (const std::uint32_t v : levelIndices(pyramid, l)) bounds.extend(glm::dvec3(pyramid.vertices.positions[v]));
        const glm::dvec3 lost = pyramid.bounds.size() - bounds.size();
        EXPECT_LE(std::max(lost.x, lost.z), 2 * pyramid.levels[l].error) << "level " << l;
    }
}

TEST(RealModels, SoupOfHundredLooseTrianglesLosesWholeOnes) {
    DEFOCUS_MODEL_OR_SKIP(path, "nasty/soup.glb");
    const Pyramid& pyramid = built(path).pyramids.at(0);
    EXPECT_EQ(pyramid.levels[0].triangleCount, 100u);
    ASSERT_EQ(pyramid.levels.size(), 2u);
    EXPECT_EQ(pyramid.levels[1].triangleCount, 64u);
}

}  // namespace
}  // namespace defocus::engine
