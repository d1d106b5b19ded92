#pragma once
// A pyramid of the farthest depth of square tiles (Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility).
// Depth is reversed: 0 at infinity, 1 at the near plane.

#include <span>
#include <vector>

namespace defocus::engine {

class DepthTiles {
public:
    // `depths`: width·height values, row by row from the bottom.
    void build(std::span<const float> depths, int width, int height);

    // Returns a lower bound (farthest value) of the depths of pixels [left, right) × [bottom, top). This rectangle must
    // lie in the buffer and not be empty.
    [[nodiscard]] float farthest(int left, int right, int bottom, int top) const;

private:
    struct Level {
        int columns = 0, rows = 0;
        std::vector<float> min;
    };
    std::vector<Level> levels_;  // tiles of 4, 8, 16, … px; the last level has one tile
};

}  // namespace defocus::engine
