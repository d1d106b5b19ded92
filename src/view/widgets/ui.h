#pragma once
// Bundles the data that panels, dialogs and the heads-up display read and change during a frame.

#include "view/export/still_export.h"
#include "view/picture/live_picture.h"
#include "view/state/input_latency.h"
#include "view/widgets/look.h"

namespace defocus::engine {

struct FrameTimes {
    double frame = 0;           // duration of the latest frame, ms
    double interface = 0;       // time for drawing widgets and swapping buffers, ms
    std::vector<float> recent;  // durations of the latest frames, ms
    InputLatency latency;
};

struct Ui {
    ViewState& state;
    ViewActions& actions;
    const Document& document;
    const LivePicture& picture;
    const std::optional<StillExport>& still;
    const FrameTimes& times;
    const std::string& device;  // name of the GPU
    float scale = 1;            // scale in px per interface unit

    [[nodiscard]] const Scene& scene() const { return *document.frame->scene; }
    [[nodiscard]] const Pose& pose() const { return document.frame->world.pose; }
};

}  // namespace defocus::engine
