#include "frame/settings/conditions.h"

#include <fmt/format.h>

namespace defocus::engine {

std::string methodWithoutSamples(const SettingContext& context) {
    if (context.method.usesLensSamples) return {};
    return fmt::format("the method {} draws no lens samples", context.method.name);
}

std::string methodWithoutShapes(const SettingContext& context) {
    if (context.method.aperture != ApertureShown::oval) return {};
    return fmt::format("the method {} has a round or oval aperture", context.method.name);
}

std::string methodWithoutLensPoints(const SettingContext& context) {
    if (context.method.aperture == ApertureShown::all) return {};
    return fmt::format("the method {} has the same lens for all colours and pixels", context.method.name);
}

std::string methodWithoutMotion(const SettingContext& context) {
    if (context.method.drawsMotion) return {};
    return fmt::format("the method {} draws no motion", context.method.name);
}

std::string withoutShutter(const SettingContext& context) {
    return context.request.shutter > 0 ? "" : "without --shutter nothing moves during the exposure";
}

std::string withoutEnvironment(const SettingContext& context) {
    return context.request.environment.empty() ? "without --environment the surroundings are the same all around" : "";
}

std::string withoutAnimation(const SettingContext& context) {
    return context.scene.clips.empty() ? "the scene has no animation" : "";
}

std::string withoutShadows(const SettingContext& context) {
    const Request& request = context.request;
    const bool shadows = request.shadows == Shadows::on || (request.shadows == Shadows::automatic && request.ground);
    return shadows ? "" : "without shadows (--shadows on, --ground) the size of a light has no effect";
}

std::string withoutBlur(const SettingContext& context) {
    return context.lens.dofEnabled ? "" : "with --no-dof nothing is blurred";
}

std::string withoutBlurOrExposure(const SettingContext& context) {
    return context.lens.exposureTime > 0 ? "" : withoutBlur(context);
}

std::string withoutLevels(const SettingContext& context) {
    return context.request.lod == LodMode::off ? "with --lod off everything is drawn in full detail" : "";
}

std::string withMeasuredLevels(const SettingContext& context) {
    const Request& request = context.request;
    const LodMetric metric = chosenMetric(request.lodMetric, givenThresholds(request));
    return metric == LodMetric::measured ? "measured levels take the blur over the whole object" : "";
}

std::string firstOf(const SettingContext& context, std::initializer_list<Condition> conditions) {
    for (const Condition condition : conditions)
        if (std::string reason = condition(context); !reason.empty()) return reason;
    return {};
}

}  // namespace defocus::engine
