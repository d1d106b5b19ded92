#pragma once
// Scenes with closed-form images: upright unlit boards before a uniform background.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus {

struct Board {
    double depth = 2;        // m
    glm::dvec2 centre{0};    // m, at that depth
    glm::dvec2 halfSize{1};  // m
    glm::vec3 radiance{1};   // linear
};

// A camera at the origin, 50 mm on 36 mm, f/1 focused at 2 m.
View boardView(int width = 96, int height = 64);

// Owns what its world points to: not copied or moved.
class BoardScene {
public:
    BoardScene(const View& boardsView, const std::vector<Board>& boards, const glm::vec3& background = glm::vec3(0));
    BoardScene(const BoardScene&) = delete;
    BoardScene& operator=(const BoardScene&) = delete;

    Scene scene;
    World world;
    View view;
    RenderSettings settings;  // full detail, everything kept
};

// The rendered image, by `method` (as parseMethodUse has it).
Image rendered(const BoardScene& boards, const std::string& method = "accumulation",
               const RendererOptions& options = {});

// A square board that is `pixels` wide around the image's middle, moved by `offset` px (right, up).
Board squareAt(const View& view, double depth, double pixels, const glm::vec3& radiance,
               const glm::dvec2& offset = glm::dvec2(0));

// In front of the focus, at it and behind it: nearest and farthest depth as given, the middle one 2 m.
std::vector<Board> threeBoards(const View& view, double nearest, double farthest);

// Of any channel of any pixel of two images of one size, linear; infinite where one image has a value that isn't
// finite.
double largestError(const Image& a, const Image& b);

// The blur diameter in px of DESIGN's formula, c = A·|1/s − 1/z|·W / (2 tan(θx/2)), in double from the lens alone.
double blurDiameter(const View& view, double depth);

// How far a light that squareAt made is from the closed form: its disk's diameter by the second moment, and its centre.
struct BlurredLight {
    double diameterError = 0;  // px
    double placeError = 0;     // px
};

// `light` is as the view's squareAt took it. By one channel of the image, which shows nothing else near the disk.
struct LightPlace {
    double depth = 6;      // m
    double pixels = 3;     // wide
    glm::dvec2 offset{0};  // px from the image's middle (right, up)
    int channel = 0;
};
BlurredLight blurredLight(const Image& image, const View& view, const LightPlace& light);

// Sets blurScale so that depth `depth` is blurred by `pixels`.
void setBlur(View& view, double depth, double pixels);

}  // namespace defocus
