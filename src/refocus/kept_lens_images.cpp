#include "refocus/kept_lens_images.h"

namespace defocus::engine {

KeptLensImages::KeptLensImages(FrameDriver& driver, const View& view, const RenderSettings& settings,
                               const FocusRange& range, const std::function<void(double)>& step)
    : info_(lightFieldInfo(view, range)) {
    FrameOrder order{.view = withMargin(view, info_.size.margin), .settings = settings};
    order.settings.refocus = range;
    order.untiledReason = "refocusing cannot use images that are drawn in tiles";
    order.takeSample = [this](std::uint32_t, Image&& colour, Image&&) {
        images_.push_back(std::make_shared<const HalfImage>(halfImage(colour)));
    };
    driver.start(std::move(order));
    addSamples(info_, driver.plan());
    do {
        step(driver.share());
    } while (driver.advance());
}

std::uint64_t KeptLensImages::bytes(const PartSize& size, std::size_t count) {
    return std::uint64_t(size.fullWidth()) * std::uint64_t(size.fullHeight()) * 4 * sizeof(std::uint16_t) * count;
}

}  // namespace defocus::engine
