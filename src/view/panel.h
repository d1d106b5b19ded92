#pragma once
// The panel beside the picture: everything of ViewState that people set by numbers and names.

#include "frame/prepared_frame.h"
#include "view/input_latency.h"
#include "view/picture.h"
#include "view/state.h"
#include "view/widgets.h"

namespace defocus {

inline constexpr double panelWidth = 364;  // units of the interface

struct PanelContext {
    const PreparedFrame* frame = nullptr;  // null: no scene yet
    const ViewPicture* picture = nullptr;
    InterfaceColors colors{};
    float scale = 1;
    ImVec2 origin, size;                                    // of the panel, window units
    const std::vector<float>* frameMilliseconds = nullptr;  // of the latest frames
    double interfaceMilliseconds = 0;
    InputLatency::Summary latency;
    std::size_t undoSteps = 0;
    std::size_t redoSteps = 0;
    bool exporting = false;
    double exportShare = 0;
    glm::ivec2 pictureSize{0};  // px
    const std::string* device = nullptr;
};

void drawPanel(const PanelContext& context, ViewState& state, ViewActions& actions);

}  // namespace defocus
