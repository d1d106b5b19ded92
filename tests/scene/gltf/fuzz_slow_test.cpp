// Loads real files with pseudo-random damage: each load returns a scene or throws Error. The test is intended for runs
// with sanitizers.

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "core/error.h"
#include "core/file.h"
#include "models.h"
#include "scene/gltf/builder.h"
#include "scene/pose.h"

namespace defocus::engine {
namespace {

constexpr int damagedCopies = 300;  // number of damaged copies of each file

class Damage {
public:
    explicit Damage(std::uint32_t seed) : random_(seed) {}

    // Damages a file in one of four ways: flipped bits, changed digits in the JSON, a removed range, or truncation.
    // Then writes the file's new length into the GLB header. Otherwise the loader would reject the file at once.
    std::string apply(std::string file) {
        const bool glb = file.starts_with("glTF");
        switch (below(4)) {
            case 0:
                for (std::size_t i = below(8) + 1; i > 0; --i)
                    file[below(file.size())] ^= static_cast<char>(1 << below(8));
                break;
            case 1:
                changeDigits(file, glb ? 20 + word(file, 12) : file.size());
                break;
            case 2: {
                const std::size_t start = below(file.size());
                file.erase(start, below(64) + 1);
                break;
            }
            default:
                file.resize(below(file.size()));
                break;
        }
        if (glb && file.size() >= 12)
            for (std::size_t i = 0; i < 4; ++i) file[8 + i] = static_cast<char>((file.size() >> (8 * i)) & 0xFF);
        return file;
    }

private:
    std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }

    static std::size_t word(const std::string& file, std::size_t offset) {
        std::uint32_t value = 0;
        std::memcpy(&value, file.data() + offset, 4);
        return value;
    }

    void changeDigits(std::string& file, std::size_t jsonEnd) {
        std::vector<std::size_t> digits;
        for (std::size_t i = 0; i < std::min(jsonEnd, file.size()); ++i)
            if (file[i] >= '0' && file[i] <= '9') digits.push_back(i);
        for (std::size_t i = below(4) + 1; i > 0 && !digits.empty(); --i)
            file[digits[below(digits.size())]] = static_cast<char>('0' + below(10));
    }

    std::mt19937 random_;
};

class DamagedModel : public testing::TestWithParam<const char*> {};

TEST_P(DamagedModel, loadsOrIsAnError) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam());
    const std::vector<std::byte> bytes = readFile(path);
    const std::string original(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const ScratchFolder folder;
    const std::filesystem::path copy = folder / ("damaged" + path.extension().string());
    int loaded = 0;
    for (int i = 0; i < damagedCopies; ++i) {
        SCOPED_TRACE(i);
        GltfBuilder::save(copy, Damage(static_cast<std::uint32_t>(i)).apply(original));
        try {
            const Scene scene = loadGltf(copy);
            for (int clip = -1; clip < static_cast<int>(scene.clips.size()); ++clip) (void)poseAt(scene, 0.3, clip);
            ++loaded;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos) << error.what();
        }
    }
    // The damage is neither too weak nor too strong: the loader rejects some copies and loads others.
    EXPECT_LT(loaded, damagedCopies);
    EXPECT_GT(loaded, 0);
}

INSTANTIATE_TEST_SUITE_P(Gltf, DamagedModel,
                         testing::Values("meshes/reed.glb", "meshes/fish.glb", "meshes/bokeh.gltf", "BoxAnimated.glb",
                                         "AnimatedMorphCube-Quantized.glb", "SimpleInstancing.glb", "CornellBox.glb",
                                         "RiggedFigure.glb", "MorphPrimitivesTest.glb", "InterpolationTest.glb",
                                         "MultiUVTest.glb", "MeshPrimitiveModes.gltf", "SimpleSparseAccessor.gltf",
                                         "tests/data/compressed/fish-draco.glb",
                                         "tests/data/compressed/reed-meshopt.glb"),
                         [](const auto& tested) { return testNameOf(tested.param); });

}  // namespace
}  // namespace defocus::engine
