#pragma once
// Computes refocused images from lens images (one image per lens sample): images with another focus distance, f-number
// and aperture shape. The method is shift and add (Levoy and Hanrahan 1996; Isaksen, McMillan and Gortler 2000,
// Dynamically Reparameterized Light Fields).
//
// Each lens image is shifted by the distance that is derived in light_field.h. A lens image has one sample per pixel,
// at a known position in the pixel. The shift moves this position; the sample's colour is added unchanged to the pixel
// that contains the shifted position, so the lens image moves by whole pixels. A pixel of the refocused image is thus
// the mean of samples within it, one from each lens image, as in a rendered image. Interpolation would soften the
// refocused image, even with more lens images.
//
// A smaller aperture uses the images of the lens points within it. An aperture shape weights each image by the relative
// amount of light that passes through the shape at the image's lens point.

#include <optional>
#include <vector>

#include "core/progress.h"
#include "lens/lens.h"
#include "refocus/light_field.h"

namespace defocus::engine {

struct Refocusing {
    double focusDistance = 1;        // distance in m, within LightFieldInfo::range
    double fStop = 1;                // at least LightFieldInfo::fStop
    std::optional<Lens> shape = {};  // lens with the shape of the aperture; nullopt: shape as rendered
    bool fillGaps = false;  // true: blur each image, so that blurred points don't appear as copies (gap_filling.h)
};

// Returns the focus and the aperture with which the lens images were rendered.
Refocusing asRendered(const LightFieldInfo& info);

// Shift and weight with which the image of one lens point is added to a refocused picture.
struct ShiftedImage {
    std::size_t image = 0;  // index of the image in LightFieldInfo::points
    glm::ivec2 move{0};     // displacement of the lens image in px, to the right and up
    double weight = 1;      // weight of the lens image, > 0
};

// Returns the displacement of an image in whole px, to the right and up. `shift`: displacement in px of the image seen
// from lens point (1, 1). The result is the offset to the pixel that contains the shifted position of the image's
// sample.
glm::ivec2 integerMove(const LightFieldInfo& info, std::size_t image, double shift);

// Returns the shift and the weight of each lens image that contributes to the refocused picture, in the order of
// LightFieldInfo::points. Throws Error, with `name` in its message, in three cases: the focus distance or f-number is
// outside the rendered range; the aperture must change, but was not rendered as a full disk; no lens point lies within
// the aperture.
std::vector<ShiftedImage> shiftedImages(const LightFieldInfo& info, const Refocusing& refocusing,
                                        const std::string& name);

// Returns the refocused picture: linear, premultiplied RGBA. Throws Error in the same cases as shiftedImages(), and if
// the file is damaged. Keeps only a few lens images in memory at a time.
Image refocused(LightField& field, const Refocusing& refocusing, const Progress& progress = {});
// Returns the refocused picture without gap filling: the weighted mean of the shifted images.
Image sharpSum(LensImages& images, const Refocusing& refocusing, const Progress& progress = {});

// Returns the diameter in px of the circle of confusion of a surface that is one dioptre out of focus.
double diameterPerDioptre(const LightFieldInfo& info, const Refocusing& refocusing);

// Returns the distance in m of the surface at a pixel. Throws Error if the pixel is outside the image or shows no
// surface.
double focusAtPixel(LightField& field, const Pixel& pixel);

// Returns the metadata of the refocused picture.
Metadata refocusedMetadata(const LightFieldInfo& info, const Refocusing& refocusing);

// Returns the exposure (EV) of refocused 8-bit pictures. If the rendered lens has an exposure time, the exposure
// depends on the f-number, as in a camera.
double refocusedExposure(const LightFieldInfo& info, const Refocusing& refocusing);

}  // namespace defocus::engine
