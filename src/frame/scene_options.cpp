#include "frame/scene_options.h"

#include "core/error.h"

namespace defocus {

MethodUse chosenMethod(const SceneOptions& options) try {
    MethodUse use = parseMethodUse(options.method);
    for (const auto& [name, value] : options.methodSettings) use.settings[name] = value;
    use.settings = completeSettings(use.method->name, use.method->settings, use.settings);
    return use;
} catch (const Error& error) {
    throw UsageError(error.what());
}

}  // namespace defocus
