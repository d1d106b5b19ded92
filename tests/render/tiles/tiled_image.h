#pragma once
// Fixture that renders an image in tiles of uneven sizes and compares it with the undivided image.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "gl_context_test.h"
#include "likeness.h"
#include "plan/visible/tiles.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class Tiles : public GlContextTest {
protected:
    static PixelRectangle wholeOf(const FramePlan& plan) { return {0, 0, plan.view.width, plan.view.height}; }

    // Returns the image assembled from tiles, each of which is rendered separately. Pixels that no tile covers are NaN.
    static Image joined(Renderer& renderer, const FramePlan& plan, const std::vector<Tile>& tiles) {
        Image image(plan.view.width, plan.view.height, 4);
        std::ranges::fill(image.pixels, std::numeric_limits<float>::quiet_NaN());
        for (const Tile& tile : tiles) {
            const Image part = imageOf(renderer, tileOf(plan, tile));
            if (part.width != tile.area.width || part.height != tile.area.height) {
                ADD_FAILURE() << part.width << " x " << part.height;
                return image;
            }
            for (int y = 0; y < part.height; ++y)
                std::copy_n(part.at(0, y), 4 * part.width, image.at(tile.area.left, tile.area.top + y));
        }
        return image;
    }

    // Returns tiles of uneven sizes that cover the image. All tiles are rasterized with the viewport of the full image.
    static std::vector<Tile> unevenTiles(const FramePlan& plan) {
        const int columns[] = {0, 37, 101, plan.view.width};
        const int rows[] = {0, 13, 64, plan.view.height};
        std::vector<Tile> tiles;
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x)
                tiles.push_back(
                    {{columns[x], rows[y], columns[x + 1] - columns[x], rows[y + 1] - rows[y]}, wholeOf(plan)});
        return tiles;
    }

    static void expectTheBitsOfOnePiece(const SmallWorld& small, const FramePlan& plan, const char* what) {
        RendererOptions options;
        const auto full = makeAccumulationRenderer(small.world, options);
        options.wave = 3;
        const auto parts = makeAccumulationRenderer(small.world, options);
        const Image expected = imageOf(*full, plan);
        const Image found = joined(*parts, plan, unevenTiles(plan));
        std::size_t others = 0, first = found.pixels.size();
        for (std::size_t i = found.pixels.size(); i-- > 0;)
            if (!(found.pixels[i] == expected.pixels[i])) ++others, first = i;
        if (others == 0) return;
        const auto width = static_cast<std::size_t>(4 * expected.width);
        ADD_FAILURE() << what << ": " << others << " values, the first at " << first % width / 4 << ", "
                      << first / width << ", channel " << first % 4 << ": " << found.pixels[first] << " instead of "
                      << expected.pixels[first] << ", by at most " << largestDifference(found, expected);
    }

    static FramePlan planWith(const SmallWorld& small, const View& view, LodMode mode = LodMode::fractional,
                              std::uint32_t samples = 20) {
        const RenderSettings settings{.sampleCount = samples, .lod = mode, .thresholds = {0.5, 2}};
        return planFrame(small.world, view, settings);
    }
};

}  // namespace defocus::engine
