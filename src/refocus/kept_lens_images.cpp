#include "refocus/kept_lens_images.h"

namespace defocus::engine {

KeptLensImages::KeptLensImages(SceneDriver& driver, const Request& request, FrameMoment moment, const FocusRange& range,
                               const std::function<void(double)>& step)
    : info_(lightFieldInfo(moment.view, range)) {
    moment.view = withMargin(moment.view, info_.size.margin);
    moment.settings.refocus = range;
    driver.pose(request, moment);
    driver.start(
        {.takeSample = [this](std::uint32_t, Image&& colour,
                              Image&&) { images_.push_back(std::make_shared<const HalfImage>(halfImage(colour))); },
         .untiledReason = "refocusing cannot use images that are drawn in tiles"});
    addSamples(info_, driver.driver().plan());
    do {
        step(driver.driver().share());
    } while (driver.advance());
}

std::uint64_t KeptLensImages::bytes(const PartSize& size, std::size_t count) {
    return std::uint64_t(size.fullWidth()) * std::uint64_t(size.fullHeight()) * 4 * sizeof(std::uint16_t) * count;
}

}  // namespace defocus::engine
