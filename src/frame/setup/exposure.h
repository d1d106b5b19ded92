#pragma once
// How 8-bit images and films are exposed: as they are asked to be, as the lens does it, or as a meter reads the scene.

#include <filesystem>
#include <optional>

#include "frame/request.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

// Returns whether the exposure comes from a meter: where the request asks for that, or where it says nothing, the lens
// has no exposure time, and the lights are the file's own, which may be as bright as the sun.
bool metersExposure(const Request& request, const Scene& scene, const Lens& lens);

// The exposure (EV) for a linear image whose alpha is the coverage of what counts. The log-average of the luminance
// becomes middle grey, 18 % (Reinhard et al. 2002, Photographic Tone Reproduction for Digital Images), but within
// bounds: the brightest fiftieth of the pixels comes to no more than white, and to no less than 40 %. 0 for an image
// without light.
double meteredExposure(const ImageView& image);

// The same for what a view shows without blur, in a small image of its surfaces without their surroundings. Needs a
// current GL context and pyramids; the world's surroundings are hidden meanwhile.
double meteredExposure(World& world, const View& view, const RenderSettings& settings,
                       const std::filesystem::path& shaderFolder = {});

// The exposure (EV) that the request gives as a value; none if it leaves the exposure to the lens or a meter.
std::optional<double> exposureOf(const Request& request);

// The exposure (EV) that the request or the lens gives without a meter.
double unmeteredExposure(const Request& request, const Lens& lens);

// The exposure (EV) of a request's image.
double chosenExposure(const Request& request, World& world, const View& view, const RenderSettings& settings,
                      const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
