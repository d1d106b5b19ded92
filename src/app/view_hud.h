#pragma once
// What is drawn over the picture: the line with lens and samples, the divider, legends, messages, the keys, and what is
// being opened.

#include "app/scene_loader.h"
#include "app/view_input.h"
#include "app/view_picture.h"
#include "app/view_state.h"
#include "app/view_widgets.h"

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
};

void drawHud(const HudContext& context, ViewState& state);

}  // namespace defocus
