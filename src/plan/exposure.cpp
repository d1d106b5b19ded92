#include "plan/exposure.h"

#include <algorithm>

#include "lens/lens_samples.h"

namespace defocus {

namespace {

// From the frame's time to the opening of its shutter, s.
double openingOffset(const Exposure& exposure) {
    switch (exposure.position) {
        case ShutterPosition::start:
            return 0;
        case ShutterPosition::centre:
            return -0.5 * exposure.seconds;
        case ShutterPosition::end:
            return -exposure.seconds;
    }
    return 0;
}

// Of the moments whose poses are needed: which share of the exposure has passed.
std::vector<double> shutterShares(const Exposure& exposure, const Lens& lens, const RenderSettings& settings) {
    std::vector<double> shares;
    if (exposure.exactMotion)
        for (const LensSample& sample :
             lensSamples(lens, settings.sequence, settings.firstSample, settings.sampleCount, settings.seed))
            shares.push_back(static_cast<double>(sample.time));
    else
        for (std::uint32_t i = 0; i <= exposure.motionSegments; ++i)
            shares.push_back(static_cast<double>(i) / exposure.motionSegments);
    return shares;
}

}  // namespace

double exposureMiddle(const Exposure& exposure) {
    return openingOffset(exposure) + 0.5 * exposure.seconds;
}

void openShutter(const Exposure& exposure, const RenderSettings& settings,
                 const std::function<ShutterMoment(double)>& momentAt, Shutter& shutter, View& view) {
    shutter = {};
    view.shutterCameras.clear();
    if (!(exposure.seconds > 0)) return;
    shutter.perSample = exposure.exactMotion;
    for (const double share : shutterShares(exposure, view.lens, settings)) {
        ShutterMoment moment = momentAt(openingOffset(exposure) + share * exposure.seconds);
        shutter.poses.push_back(std::move(moment.pose));
        view.shutterCameras.push_back(moment.worldFromCamera);
    }
    if (std::all_of(view.shutterCameras.begin(), view.shutterCameras.end(),
                    [&](const glm::dmat4& camera) { return camera == view.worldFromCamera; }))
        view.shutterCameras.clear();
}

}  // namespace defocus
