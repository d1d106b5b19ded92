#pragma once
// The farthest that a depth buffer shows, over square tiles of growing size (Greene, Kass and Miller 1993, Hierarchical
// Z-Buffer Visibility). Depth is reversed: 0 at infinity, 1 at the near plane.

#include <span>
#include <vector>

namespace defocus::engine {

class DepthTiles {
public:
    // `depths`: width·height values, row by row from the bottom.
    void build(std::span<const float> depths, int width, int height);

    // Returns a lower bound of the depths of the pixels [left, right) × [bottom, top), which must lie in the buffer and
    // not be empty.
    [[nodiscard]] float farthest(int left, int right, int bottom, int top) const;

private:
    struct Level {
        int columns = 0, rows = 0;
        std::vector<float> min;
    };
    std::vector<Level> levels_;  // of tiles of 4, 8, 16, … px; the last has one tile
};

}  // namespace defocus::engine
