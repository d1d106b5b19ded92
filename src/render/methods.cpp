#include "render/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parse.h"
#include "plan/lens_cells/automatic_cells.h"
#include "render/accumulation/accumulation.h"
#include "render/circular/circular.h"
#include "render/layered/layered.h"
#include "render/line/line.h"
#include "render/scheuermann/scheuermann.h"
#include "render/stochastic/stochastic.h"

namespace defocus::engine {

namespace {

// Returns `method` with a function `make` that first adds the defaults of missing settings to the renderer's options.
Method completing(Method method) {
    method.make = [make = std::move(method.make), name = method.name, known = method.settings](
                      const World& world, const RendererOptions& options) {
        RendererOptions complete = options;
        complete.settings = completeSettings(name, known, options.settings);
        return make(world, complete);
    };
    return method;
}

std::vector<Method>& table() {
    static std::vector<Method> methods = {
        {.name = automaticMethod,
         .description = "multirate if at least 1 % of the image is blurred by 8 px or more, else accumulation",
         .blursCells = true,
         .sumsBlocks = true,
         .drawsTiles = true,
         .drawsLayers = true,
         .drawsPositions = true,
         .usesThreads = true,
         .settings = {},
         .make = makeAutomaticRenderer},
        {.name = "accumulation",
         .description = "accumulation of lens samples with levels of detail (Jeong, Kim and Lee 2011)",
         .sumsBlocks = true,
         .drawsTiles = true,
         .drawsLayers = true,
         .drawsPositions = true,
         .usesThreads = true,
         .settings = {},
         .make = makeAccumulationRenderer},
        {.name = "multirate",
         .description =
             "accumulation of images, each blurred as its cell (its part of the lens) would blur it; needs fewer "
             "samples than accumulation",
         .blursCells = true,
         .sumsBlocks = true,
         .drawsPositions = true,
         .usesThreads = true,
         .settings = {},
         .make = makeMultirateRenderer},
        completing(scheuermannMethod()),
        completing(circularMethod()),
        completing(layeredMethod()),
        completing(stochasticMethod()),
        completing(lineMethod()),
    };
    return methods;
}

std::string accepted(const MethodSetting& setting) {
    if (!setting.choices.empty()) return fmt::format("one of {}", fmt::join(setting.choices, ", "));
    return fmt::format("{} from {:g} to {:g}", setting.integer ? "an integer" : "a number", setting.min, setting.max);
}

bool takes(const MethodSetting& setting, const std::string& value) {
    if (!setting.choices.empty())
        return std::find(setting.choices.begin(), setting.choices.end(), value) != setting.choices.end();
    const std::optional<double> number = parsedNumber<double>(value);
    return number && std::isfinite(*number) && *number >= setting.min && *number <= setting.max &&
           (!setting.integer || *number == std::floor(*number));
}

const MethodSetting& settingNamed(std::string_view method, const std::vector<MethodSetting>& known,
                                  const std::string& name) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& s) { return s.name == name; });
    if (found != known.end()) return *found;
    if (known.empty()) fail("method {} has no settings, so '{}' cannot be set", method, name);
    std::string names;
    for (const MethodSetting& setting : known) names += (names.empty() ? "" : ", ") + setting.name;
    fail("method {} has no setting '{}'; it has: {}", method, name, names);
}

}  // namespace

const std::vector<Method>& methods() {
    return table();
}

void registerMethod(Method method) {
    table().push_back(std::move(method));
}

const Method& methodNamed(std::string_view name) {
    const auto found = std::find_if(table().begin(), table().end(), [&](const Method& m) { return m.name == name; });
    if (found != table().end()) return *found;
    std::string known;
    for (const Method& method : table()) known += (known.empty() ? "" : ", ") + method.name;
    fail("there is no method '{}'; the methods are: {}", name, known);
}

MethodUse drawnMethod(const MethodUse& use, const FramePlan& plan) {
    if (use.method->name != automaticMethod) return use;
    return {&methodNamed(reasonForAccumulation(plan).empty() ? "multirate" : "accumulation"), {}};
}

std::string MethodUse::text() const {
    const std::string differing = settingsText(method->settings, settings);
    return differing.empty() ? method->name : method->name + ":" + differing;
}

MethodUse parseMethodUse(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const Method& method = methodNamed(text.substr(0, colon));
    MethodSettings given;
    if (colon == text.size()) return {&method, completeSettings(method.name, method.settings, given)};
    for (const std::string& part : splitAt(text.substr(colon + 1), ',')) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos)
            fail("'{}': '{}' is not SETTING=VALUE, as in {}:setting=value,setting=value", text, part, method.name);
        given[part.substr(0, equals)] = part.substr(equals + 1);
    }
    return {&method, completeSettings(method.name, method.settings, given)};
}

MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given) {
    for (const auto& [name, value] : given) {
        const MethodSetting& setting = settingNamed(method, known, name);
        if (!takes(setting, value)) fail("method {}: {} must be {}, not '{}'", method, name, accepted(setting), value);
    }
    MethodSettings complete = given;
    for (const MethodSetting& setting : known) complete.try_emplace(setting.name, setting.defaultValue);
    return complete;
}

double numberOf(const MethodSettings& settings, const std::string& name) {
    return parsedNumber<double>(settings.at(name)).value_or(0);
}

double valueAt(const View& view, const MethodSettings& settings, const std::string& name) {
    const auto keyed = view.methodValues.find(name);
    return keyed == view.methodValues.end() ? numberOf(settings, name) : keyed->second;
}

std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings) {
    std::string text;
    for (const MethodSetting& setting : known) {
        const auto found = settings.find(setting.name);
        if (found == settings.end() || found->second == setting.defaultValue) continue;
        text += (text.empty() ? "" : ",") + setting.name + "=" + found->second;
    }
    return text;
}

}  // namespace defocus::engine
