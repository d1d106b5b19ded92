#include "plan/motion/shutter.h"

#include <algorithm>

#include "lens/lens_samples.h"

namespace defocus::engine {

namespace {

// Returns the time of the shutter's opening, in s relative to the frame's time.
double openingOffset(const ShutterSettings& shutter) {
    if (shutter.opening) return *shutter.opening;
    switch (shutter.position) {
        case ShutterPosition::start:
            return 0;
        case ShutterPosition::centre:
            return -0.5 * shutter.seconds;
        case ShutterPosition::end:
            return -shutter.seconds;
    }
    return 0;
}

// Returns the shutter times, the times at which poses are needed, as fractions of the exposure.
std::vector<double> shutterShares(const ShutterSettings& shutter, const Lens& lens, const RenderSettings& settings) {
    std::vector<double> shares;
    if (const auto* const segments = std::get_if<std::uint32_t>(&shutter.motionSegments)) {
        for (std::uint32_t i = 0; i <= *segments; ++i) shares.push_back(static_cast<double>(i) / *segments);
    } else {
        for (const LensSample& sample :
             lensSamples(lens, settings.sequence, settings.firstSample, settings.sampleCount, settings.seed))
            shares.push_back(static_cast<double>(sample.time));
    }
    return shares;
}

}  // namespace

double shutterMiddle(const ShutterSettings& shutter) {
    return openingOffset(shutter) + 0.5 * shutter.seconds;
}

void openShutter(const ShutterSettings& shutter, const RenderSettings& settings,
                 const std::function<ShutterMoment(double)>& momentAt, Shutter& opened, View& view) {
    opened = {};
    view.shutterCameras.clear();
    if (!(shutter.seconds > 0)) return;
    opened.perSample = shutter.exactMotion();
    for (const double share : shutterShares(shutter, view.lens, settings)) {
        ShutterMoment moment = momentAt(openingOffset(shutter) + share * shutter.seconds);
        opened.poses.push_back(std::move(moment.pose));
        view.shutterCameras.push_back(moment.worldFromCamera);
    }
    if (std::all_of(view.shutterCameras.begin(), view.shutterCameras.end(),
                    [&](const glm::dmat4& camera) { return camera == view.worldFromCamera; }))
        view.shutterCameras.clear();
}

}  // namespace defocus::engine
