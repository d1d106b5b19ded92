#pragma once
// Draws a contact sheet of a mesh's levels, with a row for each level. The object turns before a fixed camera and fixed
// lights. The accumulation method draws the views.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

inline constexpr int turntableViews = 6;  // equal steps of angle; the first view is from the front (+z)

// Position of a view on the sheet; px, row 0 at the top.
struct TurntableCell {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

struct TurntableSheet {
    Image image;                                    // linear RGB
    std::vector<std::vector<TurntableCell>> cells;  // by level, then by view
};

// View of the object on the sheet. It is the same for all levels and angles, so that these can be compared.
struct TurntableView {
    View view;                          // pinhole camera, with the size of a cell
    std::vector<glm::dmat4> worldTurn;  // rotation for each view, about the object's vertical axis
};

// Returns a view that frames `mesh` from all sides, in the pose of `object`.
TurntableView turntableView(const Mesh& mesh, const Object& object);

// Returns settings with which the only object of `world` is drawn at `level`. Their threshold equals the level's error.
RenderSettings settingsForLevel(const World& world, const View& view, std::uint32_t level);

// Draws `object` in its pose at each level of its mesh's pyramid, in the environment of `world`. Replaces the pose and
// the lights of `world`. `title` heads the sheet. Needs a current GL context.
TurntableSheet turntableSheet(World& world, const Object& object, const std::string& title,
                              const std::filesystem::path& shaderFolder = {}, const Progress& progress = {});

}  // namespace defocus::engine
