#pragma once
// What is drawn over the picture: the line with lens and samples, the divider, legends, messages, the keys, and what is
// being opened.

#include "view/input.h"
#include "view/picture.h"
#include "view/scene_loader.h"
#include "view/state.h"
#include "view/still_export.h"
#include "view/widgets.h"

namespace defocus {

struct HudContext {
    PictureArea area;
    const PreparedFrame* frame = nullptr;
    const ViewPicture* picture = nullptr;
    const SceneLoader* loader = nullptr;
    InterfaceColors colors{};
    float scale = 1;
    double now = 0;
    double frameMilliseconds = 0;
    std::string leftLabel, rightLabel;  // of the two sides; empty: one image
    bool mouseOnInterface = false;
    std::vector<std::string> warnings;       // of the picture, a line each
    const StillExport* exporting = nullptr;  // null: nothing is being written
};

void drawHud(const HudContext& context, ViewState& state);

}  // namespace defocus
