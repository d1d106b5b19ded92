#pragma once
// Gives reasons why a setting has no effect in a request.

#include <initializer_list>
#include <string>

#include "frame/settings/settings.h"

namespace defocus::engine {

using Condition = std::string (*)(const SettingContext&);

// Each function tests one condition under which a setting has no effect. It returns the reason if the condition is met,
// else an empty string. Functions without a comment are named after their condition.

// Returns why a setting has no effect with a method that has no lens samples; empty for other methods.
std::string methodWithoutSamples(const SettingContext& context);
// Returns why a setting has no effect with a method that has no lens samples, or that draws only one subpixel position
// per lens sample; empty for other methods.
std::string methodWithoutPositions(const SettingContext& context);
// Returns why a setting has no effect with a method that supports only round and oval apertures; empty for other
// methods.
std::string methodWithoutShapes(const SettingContext& context);
// Returns why a setting has no effect with a method that cannot vary the lens across the image or by colour; empty for
// other methods.
std::string methodWithoutLensPoints(const SettingContext& context);
// Returns why a setting has no effect with a method that draws in one thread; empty for other methods.
std::string methodWithoutThreads(const SettingContext& context);
std::string methodWithoutMotion(const SettingContext& context);
std::string withoutLayers(const SettingContext& context);
std::string withoutShutter(const SettingContext& context);
std::string withoutEnvironment(const SettingContext& context);
std::string withoutAnimation(const SettingContext& context);
std::string withoutVariant(const SettingContext& context);
std::string withoutShadows(const SettingContext& context);
std::string withoutBlur(const SettingContext& context);
std::string withoutBlurOrExposure(const SettingContext& context);
// Returns why a setting has no effect if the request gives the number of samples; empty if it does not.
std::string withFixedSamples(const SettingContext& context);
std::string withoutLevels(const SettingContext& context);
std::string withMeasuredLevels(const SettingContext& context);

// Returns the first reason that isn't empty; empty if no condition gives a reason.
std::string firstOf(const SettingContext& context, std::initializer_list<Condition> conditions);

}  // namespace defocus::engine
