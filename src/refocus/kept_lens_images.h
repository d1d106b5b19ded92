#pragma once
// Renders lens images (one image per lens sample) and keeps them in memory, for the frames of a shot.

#include <functional>
#include <string>
#include <vector>

#include "frame/driver/scene_driver.h"
#include "refocus/light_field.h"

namespace defocus::engine {

class KeptLensImages : public LensImages {
public:
    // Draws the lens images of a moment of the driver's scene, for focus distances in `range`. The request must have
    // the method accumulation and a fixed number of samples. `step` receives the finished fraction of the work, 0 to 1.
    // Throws Error if lightFieldInfo or addSamples throws it, or if the images need tiles.
    KeptLensImages(SceneDriver& driver, const Request& request, FrameMoment moment, const FocusRange& range,
                   const std::function<void(double)>& step);

    [[nodiscard]] const LightFieldInfo& info() const override { return info_; }
    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] std::shared_ptr<const HalfImage> colour(std::size_t i) override { return images_[i]; }

    // Returns the memory in bytes that `count` images take.
    static std::uint64_t bytes(const PartSize& size, std::size_t count);

private:
    std::string name_ = "lens images";
    LightFieldInfo info_;
    std::vector<std::shared_ptr<const HalfImage>> images_;
};

}  // namespace defocus::engine
