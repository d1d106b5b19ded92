#pragma once
// Keeps the window's picture, its exposure and its warnings up to date.

#include "view/document/document.h"
#include "view/picture/view_picture.h"

namespace defocus::engine {

struct LivePicture {
    std::optional<ViewPicture> image;   // nullopt: no scene is open
    std::uint64_t worldVersion = 0;     // Document::worldVersion for which `image` was created
    std::vector<std::string> warnings;  // warnings about the picture; empty while the view moves

    bool meterDue = false;                                       // true: the view has moved since the last metering
    std::vector<std::string> clipping;                           // warnings that the picture is mostly white or black
    std::optional<std::pair<double, ToneMap>> clippingKnownFor;  // EV and tone map of the last clipping check
};

// Returns the label of the picture on one side of the divider.
std::string sideLabel(const PictureSide& side);

// Adds samples to the picture of a view at rest; see ViewPicture::grow.
void growPicture(LivePicture& picture, const Document& document, const ViewState& state);

// Updates the picture so that it matches document and state. If a method or comparison fails, turns it off and shows a
// message. `restOfFrame`: see PictureRequest. `exporting`: whether an export is running; if so, the exposure is not
// metered again.
void updatePicture(LivePicture& picture, Document& document, ViewState& state, bool software, double restOfFrame,
                   bool exporting);

}  // namespace defocus::engine
