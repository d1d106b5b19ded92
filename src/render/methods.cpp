#include "render/methods.h"

#include <algorithm>

#include "core/error.h"
#include "render/accumulation.h"

namespace defocus {

namespace {

std::vector<Method>& table() {
    static std::vector<Method> methods = {
        {"accumulation", "lens samples accumulated from a pyramid of levels (Jeong, Kim and Lee 2011)", true,
         makeAccumulationRenderer},
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

}  // namespace defocus
