#pragma once
// Pyramid of the farthest depth in square tiles of a depth buffer (Greene, Kass and Miller 1993, Hierarchical Z-Buffer
// Visibility). Depth is reversed: 0 at infinity, 1 at the near plane.

#include <span>
#include <vector>

namespace defocus::engine {

class DepthTiles {
public:
    // Builds the pyramid from `depths`: width · height values, row by row from the bottom.
    void build(std::span<const float> depths, int width, int height);

    // Returns a lower bound of the depth values of pixels [left, right) × [bottom, top); depth is reversed, so no pixel
    // is farther away. The rectangle must be inside the buffer and not empty.
    [[nodiscard]] float farthest(int left, int right, int bottom, int top) const;

private:
    struct Level {
        int columns = 0, rows = 0;
        std::vector<float> min;
    };
    std::vector<Level> levels_;  // levels with tiles of 4, 8, 16, … px; the last level is one tile
};

}  // namespace defocus::engine
