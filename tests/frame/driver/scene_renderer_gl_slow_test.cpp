// Tests that SceneRenderer uses tiles to render a frame that exceeds the memory limit.

#include <algorithm>
#include <string>
#include <vector>

#include "core/memory_limits.h"
#include "frame/driver/small_request.h"
#include "gl/context.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

// A frame that needs tiles to stay within the memory limit is bit-identical to a frame without tiles. Tiles are drawn
// from top to bottom.
TEST_F(SceneRendererTest, aFrameInTilesHasTheBitsOfOnePiece) {
    if (!createHeadlessContext()->software()) GTEST_SKIP() << "a GPU keeps the pixels in its own memory";
    Request request = smallRequest();
    request.size.width = 1600;
    request.size.height = 1200;
    request.wave.reset();
    request.samples = 4;
    // the method auto draws tiles by accumulation, but might choose multirate without tiles
    request.method = "accumulation";
    (void)render(smallRequest());
    const std::uint64_t held = residentMemory();  // memory in use before the driver allocates buffers for large images
    Image full;
    std::vector<std::string> warnings;
    {
        SceneRenderer renderer(request);
        full = renderer.render();
        warnings = renderer.warnings();
    }

    // Without tiles, the pixels alone take 370 MiB.
    constexpr std::uint64_t little = std::uint64_t{300} << 20;
    // the driver may have freed memory since the measurement
    request.memory = std::min(held, residentMemory()) + little;
    SceneRenderer other(request);
    other.start();
    EXPECT_EQ(other.sampleTotal(), 4u);
    EXPECT_EQ(other.samples(), 0u);
    std::uint32_t before = 0;
    int steps = 0;
    for (bool more = true; more; ++steps) {
        more = other.advance();
        EXPECT_GE(other.samples(), before);
        before = other.samples();
    }
    EXPECT_EQ(other.samples(), 4u);
    EXPECT_GT(steps, 1) << "a frame in one piece is drawn in a single step";
    EXPECT_TRUE(other.image().pixels == full.pixels);
    EXPECT_EQ(other.statistics().samples, 4u);
    EXPECT_EQ(other.warnings(), warnings);
    EXPECT_THROW(other.aovs(), std::exception);
    other.write(folder_ / "image.exr", other.image());
    EXPECT_TRUE(readImage(folder_ / "image.exr").pixels == full.pixels);

    // Another frame of the same size also needs tiles.
    Request moved = request;
    moved.cameraPosition = movedRequest().cameraPosition;
    const Image movedImage = other.render(moved);
    moved.memory.reset();
    EXPECT_TRUE(movedImage.pixels == render(moved).pixels);
    // A small frame needs no tiles, although the renderer still occupies memory for the large frame.
    Request small = request;
    small.size.width = 96;
    small.size.height = 72;
    const Image smallImage = other.render(small);
    small.memory.reset();
    EXPECT_TRUE(smallImage.pixels == render(small).pixels);

    request.memory = 1 << 20;
    EXPECT_THROW(other.start(request), std::exception);
    request.memory = residentMemory() + little;
    request.method = "circular";
    EXPECT_THROW(other.start(request), std::exception);
}

}  // namespace
}  // namespace defocus::engine
