#pragma once
// Renders small images of a level of detail by parallel projection, without a lens. Each pixel (called cell in the
// code) shows the surface that is nearest to the eye at the pixel's centre. The lighting is a uniform sky and the
// lights that a scene without lights gets by default (scene/defaults.h).

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/memory.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// A rectangle of pixels; `right` and `top` are exclusive. Arrays of pixel values are ordered row by row.
struct CellBox {
    int left = 0, right = 0;
    int bottom = 0, top = 0;

    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] std::size_t count() const { return indexOf(left, top); }
    [[nodiscard]] std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y - bottom) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(x - left);
    }
};
inline constexpr int boxAlignment = 32;  // the sides of Eye::box are multiples of this number of pixels

// View direction of an image, and its square grid of pixels. The grid is perpendicular to the direction and covers a
// bounding sphere of the mesh.
struct Eye {
    glm::dvec3 centre{0}, right{0}, up{0}, towards{0};  // towards: unit vector from the mesh to the eye
    double cellsPerUnit = 0;
    int resolution = 0;  // pixels per side of the grid
    // Rectangle of the pixels that the mesh may cover. Its sides are multiples of boxAlignment, or equal to the side of
    // the grid.
    CellBox box;

    // Projects a position to the pixel coordinates of the image; z increases towards the eye.
    [[nodiscard]] glm::vec3 place(const glm::vec3& position) const;
};

Eye eyeAlong(const Pyramid& pyramid, const glm::dvec3& towards, int resolution);

struct Picture {
    // Linear radiance of the pixels in Eye::box. 0 marks a pixel without a surface; black surfaces have a tiny positive
    // value.
    LargeVector<glm::vec3> light;
    std::size_t covered = 0;  // number of pixels that show a surface
    double sum = 0;           // sum over all pixels of the mean of the three colour channels
};

// Renders images of a mesh's levels, with one finish (simplified material) per primitive. Reuses memory from level to
// level.
class Painter {
public:
    Painter(const Pyramid& pyramid, const Eye& eye, std::span<const Finish> finishes);
    void draw(std::size_t level, Picture& picture);

private:
    void drawTriangle(std::uint32_t first);

    const Pyramid& pyramid_;
    const Eye& eye_;
    std::span<const Finish> finishes_;
    std::vector<glm::vec3> places_;  // projected vertices of the level
    // Depth and triangle of the nearest surface at the centre of each pixel of Eye::box.
    LargeVector<float> depths_;          // z of the nearest surface; −∞ for pixels without a surface
    LargeVector<std::uint32_t> firsts_;  // offset of the triangle's first index in Pyramid::indices
};

// Renders one image of level `number`, for callers that need no further level.
Picture pictureOf(const Pyramid& pyramid, std::size_t number, const Eye& eye, std::span<const Finish> finishes);

}  // namespace defocus::engine
