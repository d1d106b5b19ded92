#include "frame/settings/conditions.h"

#include <fmt/format.h>

namespace defocus::engine {

std::string methodWithoutSamples(const SettingContext& context) {
    if (context.method.usesLensSamples) return {};
    return fmt::format("method {} has no lens samples", context.method.name);
}

std::string methodWithoutPositions(const SettingContext& context) {
    if (context.method.drawsPositions) return {};
    if (!context.method.usesLensSamples) return methodWithoutSamples(context);
    return fmt::format("method {} draws one subpixel position per lens sample", context.method.name);
}

std::string methodWithoutShapes(const SettingContext& context) {
    if (context.method.aperture != ApertureShown::oval) return {};
    return fmt::format("method {} supports only round and oval apertures", context.method.name);
}

std::string methodWithoutLensPoints(const SettingContext& context) {
    if (context.method.aperture == ApertureShown::all) return {};
    return fmt::format("method {} does not support blur that differs across the image or between colours",
                       context.method.name);
}

std::string methodWithoutThreads(const SettingContext& context) {
    if (context.method.usesThreads) return {};
    return fmt::format("method {} draws in a single OpenGL context", context.method.name);
}

std::string methodWithoutMotion(const SettingContext& context) {
    if (context.method.drawsMotion) return {};
    return fmt::format("method {} does not support motion blur", context.method.name);
}

std::string withoutShutter(const SettingContext& context) {
    const bool own = !context.request.shutter && !context.request.cameraFrom.empty();
    return own || context.request.shutter.value_or(0) > 0 ? "" : "there is no motion blur without --shutter";
}

std::string withoutLayers(const SettingContext& context) {
    return context.request.layers.empty() ? "there are no layers without --exr-layers" : "";
}

std::string withoutEnvironment(const SettingContext& context) {
    return context.request.environment.empty() ? "there is no environment map without --environment" : "";
}

std::string withoutAnimation(const SettingContext& context) {
    return context.scene.clips.empty() && !context.scene.cameraTrack ? "the scene has no animation" : "";
}

std::string withoutVariant(const SettingContext& context) {
    return context.request.variant == context.scene.variant ? "" : "the scene was loaded without this variant";
}

std::string withoutShadows(const SettingContext& context) {
    const Request& request = context.request;
    const bool shadows = request.shadows == Shadows::on || (request.shadows == Shadows::automatic && request.ground);
    return shadows ? "" : "the size of lights affects only shadows (--shadows on, --ground)";
}

std::string withoutBlur(const SettingContext& context) {
    return context.lens.dofEnabled ? "" : "--no-dof disables all blur";
}

std::string withoutBlurOrExposure(const SettingContext& context) {
    return context.lens.exposureTime > 0 ? "" : withoutBlur(context);
}

std::string withFixedSamples(const SettingContext& context) {
    return context.request.samples ? "the number of samples is given" : "";
}

std::string withoutLevels(const SettingContext& context) {
    return context.request.lod == LodMode::off ? "--lod off draws full detail" : "";
}

std::string withMeasuredLevels(const SettingContext& context) {
    const Request& request = context.request;
    const LodMetric metric = chosenMetric(request.lodMetric, givenThresholds(request));
    return metric == LodMetric::measured
               ? "with --lod-metric measured, the blur of the whole object chooses the level of detail"
               : "";
}

std::string firstOf(const SettingContext& context, std::initializer_list<Condition> conditions) {
    for (const Condition condition : conditions)
        if (std::string reason = condition(context); !reason.empty()) return reason;
    return {};
}

}  // namespace defocus::engine
