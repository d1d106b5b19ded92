#pragma once
// Gives reasons why a setting has no effect in a request. Each function returns a reason, or an empty string if its
// condition doesn't apply.

#include <initializer_list>
#include <string>

#include "frame/settings/settings.h"

namespace defocus::engine {

using Condition = std::string (*)(const SettingContext&);

// A comment beside a function states when it returns a reason; functions without a comment have names that say so.
std::string methodWithoutSamples(const SettingContext& context);     // if the method draws no lens samples
std::string methodWithoutPositions(const SettingContext& context);   // if a sample has at most one pixel position
std::string methodWithoutShapes(const SettingContext& context);      // if only round and oval apertures are supported
std::string methodWithoutLensPoints(const SettingContext& context);  // if the lens can't vary by pixel or by colour
std::string methodWithoutThreads(const SettingContext& context);     // if the method draws in one thread
std::string methodWithoutMotion(const SettingContext& context);
std::string withoutLayers(const SettingContext& context);
std::string withoutShutter(const SettingContext& context);
std::string withoutEnvironment(const SettingContext& context);
std::string withoutAnimation(const SettingContext& context);
std::string withoutVariant(const SettingContext& context);
std::string withoutShadows(const SettingContext& context);
std::string withoutBlur(const SettingContext& context);
std::string withoutBlurOrExposure(const SettingContext& context);
std::string withFixedSamples(const SettingContext& context);  // if the request gives the number of samples
std::string withoutLevels(const SettingContext& context);
std::string withMeasuredLevels(const SettingContext& context);

// Returns the first reason that isn't empty; empty if no condition gives a reason.
std::string firstOf(const SettingContext& context, std::initializer_list<Condition> conditions);

}  // namespace defocus::engine
