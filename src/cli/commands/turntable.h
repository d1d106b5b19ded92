#pragma once
// Draws a contact sheet of a mesh's levels: one row per level, one column per view angle. The object rotates in front
// of a fixed camera and fixed lights. The views are drawn with the method "accumulation".

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

inline constexpr int turntableViews = 6;  // number of views, at equal angles; the first is from the front (+z)

// Position of a view's image on the contact sheet, px; row 0 is at the top.
struct TurntableCell {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

struct TurntableSheet {
    Image image;                                    // linear RGB
    std::vector<std::vector<TurntableCell>> cells;  // positions by level, then by view
};

// Camera and rotations of the views on a contact sheet. Both are the same for all levels of detail, so that levels can
// be compared.
struct TurntableView {
    View view;                          // pinhole camera with the size of a cell
    std::vector<glm::dmat4> worldTurn;  // rotation about the object's vertical axis, by view
};

// Returns the views of `mesh` in the pose of `object`, with a camera that sees the complete mesh from all sides.
TurntableView turntableView(const Mesh& mesh, const Object& object);

// Returns settings that draw the only object of `world` at `level`, with a threshold equal to the error of that level.
RenderSettings settingsForLevel(const World& world, const View& view, std::uint32_t level);

// Draws `object`, in its pose, at each level of its mesh's pyramid, in the environment of `world`. Replaces the pose
// and the lights of `world`. `title`: heading of the sheet. Needs a current GL context.
TurntableSheet turntableSheet(World& world, const Object& object, const std::string& title,
                              const std::filesystem::path& shaderFolder = {}, const Progress& progress = {});

}  // namespace defocus::engine
