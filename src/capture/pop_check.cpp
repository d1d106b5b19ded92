#include "capture/pop_check.h"

#include <utility>

#include "render/aov/aov.h"
#include "render/pops/level_change.h"

namespace defocus::engine {

namespace {

Image differenceOf(const Image& a, const Image& b) {
    Image difference = a;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= b.pixels[i];
    return difference;
}

}  // namespace

PopCheck::PopCheck(const World& world, const MethodUse& method, RendererOptions options)
    : world_(&world), shaderFolder_(options.shaderFolder) {
    options.settings = method.settings;
    renderer_ = method.method->make(world, options);
}

void PopCheck::note(int frame, const FramePlan& plan) {
    const FramePlan before = std::exchange(previous_, plan);
    const bool follows = std::exchange(previousFrame_, frame) == frame - 1;
    if (!follows) return;
    if (before.samples.size() != plan.samples.size()) {
        ++incomparable_;
        return;
    }
    ++compared_;
    const std::optional<HeldPlan> held = asBefore(plan, before);
    if (!held) return;

    const Image image = displayColours(imageOf(*renderer_, plan));
    const Image step = differenceOf(image, displayColours(imageOf(*renderer_, held->plan)));
    const AovImages aovs = renderAovs(*world_, plan, shaderFolder_);
    const Image objects = objectPixels(aovs.level, aovs.coc);
    const ObjectPlan* worst = nullptr;
    for (const ObjectPlan* object : held->changed) {
        const Image pixels = pixelsOf({object}, plan, objects);
        const double rmse = rootMeanSquare(step, &pixels);
        if (largest_ && rmse <= largest_->rmse) continue;
        largest_ = FramePop{frame, object->name, rmse, 0};
        worst = object;
    }
    if (worst == nullptr) return;
    RenderSettings otherSeed = plan.settings;
    ++otherSeed.seed;
    const Image other = displayColours(imageOf(*renderer_, planFrame(*world_, plan.view, otherSeed)));
    const Image pixels = pixelsOf({worst}, plan, objects);
    largest_->seedRmse = rootMeanSquare(differenceOf(image, other), &pixels);
}

}  // namespace defocus::engine
