#pragma once
// Measures the pops of a shot: how much an image changes because objects change their levels of detail from one frame
// to the next.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "render/methods.h"
#include "render/renderer.h"

namespace defocus::engine {

struct FramePop {
    int frame = 0;       // number of the frame after the change of level
    std::string object;  // name of the object that changes its level
    double rmse = 0;     // RMSE of display values (sRGB, [0, 1], EV 0) over the pixels that show the object or its blur
    double seedRmse = 0;  // RMSE over the same pixels between this frame and a rendering with another random seed
};

class PopCheck {
public:
    // `world` must outlive the check.
    PopCheck(const World& world, const MethodUse& method, RendererOptions options);

    // Compares the objects' levels of detail in `plan` with their levels in the preceding frame. If any differ, draws
    // the frame with the new and with the old levels and compares the two images. If there was no call for the
    // preceding frame, only stores `plan` for the next call. The world must be posed for this frame. Needs a current GL
    // context.
    void note(int frame, const FramePlan& plan);

    [[nodiscard]] const std::optional<FramePop>& largest() const { return largest_; }
    [[nodiscard]] int compared() const { return compared_; }  // number of pairs of frames that were compared
    // Returns the number of pairs of frames that can't be compared because their numbers of lens samples differ.
    [[nodiscard]] int incomparable() const { return incomparable_; }

private:
    const World* world_;
    std::filesystem::path shaderFolder_;
    std::unique_ptr<Renderer> renderer_;
    FramePlan previous_;
    std::optional<int> previousFrame_;
    std::optional<FramePop> largest_;
    int compared_ = 0;
    int incomparable_ = 0;
};

}  // namespace defocus::engine
