#include "view/document/scene_loader.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

std::optional<LoadedScene> waitedFor(SceneLoader& loader) {
    while (loader.busy())
        if (auto loaded = loader.take()) return loaded;
    return std::nullopt;
}

// The loader returns each result (a scene or an error) exactly once, even if loading ends while take() runs.
TEST(SceneLoader, handsOverWhatItOpenedOnce) {
    SceneLoader loader;
    Request absent;
    absent.scene = "absent.glb";
    for (int i = 0; i < 200; ++i) {
        loader.open(absent);
        const std::optional<LoadedScene> loaded = waitedFor(loader);
        ASSERT_TRUE(loaded) << "round " << i;
        EXPECT_NE(loaded->fault.find("absent.glb"), std::string::npos) << loaded->fault;
        EXPECT_FALSE(loader.take());
    }
}

TEST(SceneLoader, givesUpASceneForTheNext) {
    SceneLoader loader;
    Request first;
    first.scene = "absent.glb";
    Request second;
    second.fishCount = 1;
    second.trianglesPerFish = 200;
    second.noCache = true;
    loader.open(first);
    loader.open(second);
    const std::optional<LoadedScene> loaded = waitedFor(loader);
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(loaded->frame) << loaded->fault;
    EXPECT_FALSE(loader.busy());
}

}  // namespace
}  // namespace defocus::engine
