#pragma once
// Keeps the picture of the document up to date: renderer, exposure meter, warnings.

#include "view/document/document.h"
#include "view/picture/view_picture.h"

namespace defocus::engine {

struct LivePicture {
    std::optional<ViewPicture> image;   // none: no scene yet
    std::uint64_t worldVersion = 0;     // Document::worldVersion that `image` was made for
    std::vector<std::string> warnings;  // about the picture, once the view is still

    bool meterDue = false;                                       // the view has moved since the last metering
    std::vector<std::string> clipping;                           // clipping warnings
    std::optional<std::pair<double, ToneMap>> clippingKnownFor;  // exposure and tone map that `clipping` is about
};

// Returns the label of a side of the divider.
std::string sideLabel(const PictureSide& side);

// Adds samples to a still picture; see ViewPicture::grow.
void growPicture(LivePicture& picture, const Document& document, const ViewState& state);

// Brings the picture up to date with document and state. A method or comparison that fails is switched off with a
// message. `restOfFrame`: see PictureRequest. `exporting`: the exposure must not change.
void updatePicture(LivePicture& picture, Document& document, ViewState& state, bool software, double restOfFrame,
                   bool exporting);

}  // namespace defocus::engine
