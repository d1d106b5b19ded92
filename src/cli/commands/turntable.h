#pragma once
// A contact sheet of a mesh's levels: a row a level, turned before a camera and lights that stand still. What is seen
// is what the accumulation draws.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

inline constexpr int turntableViews = 6;  // evenly around, the first from the front (+z)

// Where a view of a level lies on the sheet; px, row 0 at the top.
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

// How the sheet looks at its object: the same for all levels and angles, so that they can be compared.
struct TurntableView {
    View view;                          // a pinhole, sized as a cell
    std::vector<glm::dmat4> worldTurn;  // of each of the views, about the object's vertical axis
};

// Frames `mesh`, posed as `object` has it, from all sides.
TurntableView turntableView(const Mesh& mesh, const Object& object);

// What plans `level` of the only object of `world`, and no other: a threshold that the level's error just meets.
RenderSettings settingsForLevel(const World& world, const View& view, std::uint32_t level);

// `object` as it is posed, at each level of its mesh's pyramid, before the environment of `world`; its pose and lights
// are replaced. `title` heads the sheet. Needs a current GL context.
TurntableSheet turntableSheet(World& world, const Object& object, const std::string& title,
                              const std::filesystem::path& shaderFolder = {}, const Progress& progress = {});

}  // namespace defocus::engine
