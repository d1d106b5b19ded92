#pragma once
// Builds scenes whose exact images can be computed: upright unlit boards in front of a uniform background.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus::engine {

struct Board {
    double depth = 2;        // depth of the board, m
    glm::dvec2 centre{0};    // centre in m, in the plane at `depth`
    glm::dvec2 halfSize{1};  // half the width and height, m
    glm::vec3 radiance{1};   // radiance in linear RGB
};

// Returns the view of a camera at the origin with a 50 mm f/1 lens and a 36 mm sensor, focused at 2 m.
View boardView(int width = 96, int height = 64);

struct BoardScene {
    BoardScene(const View& boardsView, const std::vector<Board>& boards, const glm::vec3& background = glm::vec3(0));

    std::shared_ptr<Scene> scene = std::make_shared<Scene>();  // the scene that `world` refers to
    World world;
    View view;
    RenderSettings settings;  // settings for full detail without culling
};

// Renders the scene with a method. `method`: name and settings in the format of parseMethodUse.
Image rendered(const BoardScene& boards, const std::string& method = "accumulation",
               const RendererOptions& options = {});

// Returns a square board that appears `pixels` px wide in the image. `offset` is the position of its centre relative to
// the image's centre, px (right, up).
Board squareAt(const View& view, double depth, double pixels, const glm::vec3& radiance,
               const glm::dvec2& offset = glm::dvec2(0));

// Returns three boards: one in front of the focus plane (at depth `nearest`), one in focus (at 2 m), and one behind the
// focus plane (at depth `farthest`).
std::vector<Board> threeBoards(const View& view, double nearest, double farthest);

// Returns the max difference of linear values over all pixels and channels; infinity if a value of either image isn't
// finite. The images must have the same size.
double largestError(const Image& a, const Image& b);

// Returns the blur diameter c = A·|1/s − 1/z|·W / (2 tan(θx/2)) in px, with the aperture diameter A, focus distance s
// and depth z in m, the horizontal field of view θx, and the image width W in px. Computed in double precision.
double blurDiameter(const View& view, double depth);

// Errors of the image of a blurred square light (made by squareAt) relative to the exact image. The blur diameter is
// measured as that of a uniform disk with the same second moment as the light's image.
struct BlurredLight {
    double diameterError = 0;  // error of the measured blur diameter, px
    double placeError = 0;     // distance of the disk's centre from its exact position, px
};

// Arguments of squareAt for a light, and the image channel in which the light is measured. Near the light's disk, this
// channel must contain no other light.
struct LightPlace {
    double depth = 6;      // depth of the light, m
    double pixels = 3;     // width of the light, px
    glm::dvec2 offset{0};  // offset from the image's centre, px (right, up)
    int channel = 0;
};
BlurredLight blurredLight(const Image& image, const View& view, const LightPlace& light);

// Sets blurScale so that the blur at `depth` (m) has a diameter of `pixels` px.
void setBlur(View& view, double depth, double pixels);

}  // namespace defocus::engine
