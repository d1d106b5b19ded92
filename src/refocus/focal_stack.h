#pragma once
// Sharp picture and depths of the scene from its lens images, for data sets of depth from defocus.

#include "core/progress.h"
#include "refocus/light_field.h"

namespace defocus::engine {

// Returns the depths in m of the surfaces that the lens's centre sees, one channel, without the margin; +∞ where no
// surface writes depth.
Image centralDepth(LightField& field);

// Returns the picture in which everything is in focus, as the lens's centre sees it: linear, premultiplied RGBA. Each
// pixel is the mean over the lens images that show its surface, each at the position to which a focus on the surface
// moves it. An image shows the surface if its depth there differs by at most one pixel of blur.
Image allInFocus(LightField& field, const Progress& progress = {});

}  // namespace defocus::engine
