#pragma once
// Chooses the exposure of 8-bit images and videos: from the request, from the lens, or by metering the scene.

#include <filesystem>
#include <optional>

#include "frame/request.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

// Returns whether the exposure is metered. By default, scenes with lights are metered, because a light may be as bright
// as the sun. Exceptions are the built-in school of fish and scenes whose lens has an exposure time.
bool metersExposure(const Request& request, const Scene& scene, const Lens& lens);

// Returns the exposure (EV) that maps the log-average luminance of the surfaces in a linear image to middle grey, 18 %
// (Reinhard et al. 2002, Photographic Tone Reproduction for Digital Images). Alpha is the coverage by surfaces: above
// 0.5, a pixel shows a surface, else the background. The exposure is clamped so that the 98th percentile of the
// surfaces' luminances lies between 40 % and 100 % of white. It is then lowered until the background's log average is
// at most 50 % of white, so a dark object in front of a light background stays dark. Returns 0 for an image without lit
// surfaces.
double meteredExposure(const ImageView& image);

// Renders a small image of the view without blur and meters it. Returns the exposure (EV). A background of one colour
// is not metered, because the user chose it. A transparent background is metered as if it showed the environment. Needs
// a current GL context and pyramids. Changes the environment's visibility during the call.
double meteredExposure(World& world, const View& view, const RenderSettings& settings,
                       const std::filesystem::path& shaderFolder = {});

// Returns the exposure (EV) if the request sets it to a number; nullopt if the lens or metering determines it.
std::optional<double> exposureOf(const Request& request);

// Returns the exposure (EV) that follows from the request or the lens without metering.
double unmeteredExposure(const Request& request, const Lens& lens);

// Returns the exposure (EV) of a request's image, metered if metersExposure() returns true.
double chosenExposure(const Request& request, World& world, const View& view, const RenderSettings& settings,
                      const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
