#include "frame/request.h"

#include "core/error.h"

namespace defocus {

MethodUse chosenMethod(const Request& request) try {
    MethodUse use = parseMethodUse(request.method);
    for (const auto& [name, value] : request.methodSettings) use.settings[name] = value;
    use.settings = completeSettings(use.method->name, use.method->settings, use.settings);
    return use;
} catch (const Error& error) {
    throw UsageError(error.what());
}

}  // namespace defocus
