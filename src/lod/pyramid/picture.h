#pragma once
// Draws pictures of a level, from afar and without a lens. Each cell shows what is nearest to the eye at its middle,
// under an even sky and the lights that a scene without lights gets (scene/defaults.h).

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/memory.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Cells of a grid, the ends not included. Values of its cells lie row by row.
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
inline constexpr int boxAlignment = 32;  // cells, of the sides of an eye's box

// A square grid at right angles to a direction, over a ball around the mesh.
struct Eye {
    glm::dvec3 centre{0}, right{0}, up{0}, towards{0};  // towards: from the mesh to the eye, unit
    double cellsPerUnit = 0;
    int resolution = 0;  // cells a side
    CellBox box;         // that may show the mesh; its sides are multiples of boxAlignment, or the grid's

    // Returns where a position lies, in cells; z grows towards the eye.
    [[nodiscard]] glm::vec3 place(const glm::vec3& position) const;
};

Eye eyeAlong(const Pyramid& pyramid, const glm::dvec3& towards, int resolution);

struct Picture {
    LargeVector<glm::vec3> light;  // linear, of the cells of the eye's box; 0 where nothing is
    std::size_t covered = 0;       // cells
    double sum = 0;                // of the light's mean channels
};

// Draws levels one after the other, in the same memory. `finishes` has one finish for each primitive of the mesh.
class Painter {
public:
    Painter(const Pyramid& pyramid, const Eye& eye, std::span<const Finish> finishes);
    void draw(std::size_t level, Picture& picture);

private:
    void drawTriangle(std::uint32_t first);

    const Pyramid& pyramid_;
    const Eye& eye_;
    std::span<const Finish> finishes_;
    std::vector<glm::vec3> places_;  // of the level's vertices
    // What is nearest to the eye at the middle of each cell of its box.
    LargeVector<float> depths_;          // z, or −∞
    LargeVector<std::uint32_t> firsts_;  // of the triangle's three indices, among the pyramid's
};

// Draws level `number`.
Picture pictureOf(const Pyramid& pyramid, std::size_t number, const Eye& eye, std::span<const Finish> finishes);

}  // namespace defocus::engine
