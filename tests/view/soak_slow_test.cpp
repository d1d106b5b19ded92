// Tests that a viewer that opens scene after scene does not leak memory or file descriptors. scripts/soak opens more
// scenes.

#include <fmt/format.h>

#include <algorithm>

#include "cli/two_quads.h"
#include "process_memory.h"
#include "view/view_program.h"

#ifdef DEFOCUS_XCB
#include "view/drop_source.h"

namespace defocus::engine {
namespace {

class ViewSoak : public ViewProgram {};

TEST_F(ViewSoak, scenesInTurnTakeNoMoreMemoryAndLeaveNoHandleOpen) {
    const int scenes = roundsOr("DEFOCUS_SOAK_SCENES", 90);
    const int early = std::max(scenes / 10, 20);
    for (int i = 0; i < 2; ++i) writeTwoQuads(folder() / fmt::format("scene{}.gltf", i));
    start({"scene0.gltf", "--size", "320x240"});
    ASSERT_TRUE(showsScene("scene0.gltf")) << state();
    DropSource hand(display());
    Held before, after;
    // A memory reading depends on what the viewer draws at that moment, and varies by 20 MB. The minimum of ten
    // readings is steady.
    const auto keepLeast = [this](Held& least) {
        const Held now = heldBy(process());
        least.megabytes = least.megabytes > 0 ? std::min(least.megabytes, now.megabytes) : now.megabytes;
        least.handles = now.handles;
    };
    for (int i = 1; i <= scenes; ++i) {
        const std::string name = fmt::format("scene{}.gltf", i % 2);
        ASSERT_TRUE(hand.drop("file://" + (folder() / name).string() + "\r\n", 120, 100)) << i;
        ASSERT_TRUE(showsScene(name)) << i << " " << state();
        if (i > early - 10 && i <= early) keepLeast(before);
        if (i > scenes - 10) keepLeast(after);
    }
    fmt::print("{} scenes: {:.1f} MB after {}, {:.1f} MB at the end; {} and {} handles\n", scenes, before.megabytes,
               early, after.megabytes, before.handles, after.handles);
    // The memory that allocators hold stops growing after a few dozen scenes. A short run finds leaks of one image of
    // the window's size per scene; a long run finds any leak.
    const double settled = 0.02 * before.megabytes;
    const double imagesKept = (scenes - early) * 320 * 240 * 4e-6;
    EXPECT_LE(after.megabytes - before.megabytes, scenes < 500 ? imagesKept : settled);
    // the file of one scene may still be open; a leak per scene would add dozens of file descriptors
    EXPECT_LT(after.handles, before.handles + 5);
}

}  // namespace
}  // namespace defocus::engine

#endif
