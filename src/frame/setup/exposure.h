#pragma once
// Chooses the exposure of 8-bit images and films: from the request, from the lens, or by metering the scene.

#include <filesystem>
#include <optional>

#include "frame/request.h"
#include "image/image.h"
#include "plan/view.h"

namespace defocus::engine {

// Returns whether the exposure is metered. The request can ask for that. It is also the default for a scene
// with lights, which may be as bright as the sun, if the lens has no exposure time. The school of fish is not metered.
bool metersExposure(const Request& request, const Scene& scene, const Lens& lens);

// Returns the exposure (EV) for a linear image whose alpha is the coverage by metered surfaces. The exposure maps the
// log-average luminance to middle grey, 18 % (Reinhard et al. 2002, Photographic Tone Reproduction for Digital Images).
// It is clamped so that the 98th percentile of the luminances lies between 40 % and 100 % of white. 0 for an image
// without light.
double meteredExposure(const ImageView& image);

// Returns the exposure (EV) for a view, from a small image of its surfaces without blur and environment. Needs a
// current GL context and pyramids. Hides the world's environment during the call.
double meteredExposure(World& world, const View& view, const RenderSettings& settings,
                       const std::filesystem::path& shaderFolder = {});

// Returns the exposure (EV) that the request gives as a value; none if it leaves the exposure to the lens or a meter.
std::optional<double> exposureOf(const Request& request);

// Returns the exposure (EV) that the request or the lens gives without a meter.
double unmeteredExposure(const Request& request, const Lens& lens);

// Returns the exposure (EV) of a request's image.
double chosenExposure(const Request& request, World& world, const View& view, const RenderSettings& settings,
                      const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
