#include "render/methods.h"

#include <algorithm>

#include "core/error.h"
#include "render/accumulation/accumulation.h"
#include "render/circular/circular.h"
#include "render/multirate/multirate.h"
#include "render/scheuermann/scheuermann.h"

namespace defocus {

namespace {

std::vector<Method>& table() {
    static std::vector<Method> methods = {
        {.name = "accumulation",
         .description = "lens samples accumulated from a pyramid of levels (Jeong, Kim and Lee 2011)",
         .sumsBlocks = true,
         .settings = {},
         .make = makeAccumulationRenderer},
        {.name = "multirate",
         .description = "the same, with fewer images of what is hardly blurred and larger pixels of what is strongly blurred",
         .sumsBlocks = true,
         .settings = {},
         .make = makeMultirateRenderer},
        scheuermannMethod(),
        circularMethod(),
    };
    return methods;
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
    fail("no method is called '{}'; there are: {}", name, known);
}

std::string MethodUse::text() const {
    const std::string differing = settingsText(method->settings, settings);
    return differing.empty() ? method->name : method->name + ":" + differing;
}

MethodUse parseMethodUse(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const Method& method = methodNamed(text.substr(0, colon));
    MethodSettings given;
    for (std::size_t begin = colon + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos)
            fail("'{}': '{}' is not SETTING=VALUE, as in {}:setting=value,setting=value", text, part, method.name);
        given[std::string(part.substr(0, equals))] = part.substr(equals + 1);
        begin = end + 1;
    }
    return {&method, completeSettings(method.name, method.settings, given)};
}

}  // namespace defocus
