#include "cli/options/method_list.h"

#include "core/parse.h"

namespace defocus::engine {

std::vector<MethodUse> parseMethods(const std::string& text) {
    std::vector<std::string> names;
    for (const std::string& part : splitAt(text, ',')) {
        const std::size_t equals = part.find('=');
        const bool more = equals != std::string::npos && part.find(':') > equals;
        if (more && !names.empty())
            names.back() += "," + part;
        else
            names.push_back(part);
    }
    std::vector<MethodUse> uses;
    uses.reserve(names.size());
    for (const std::string& name : names) uses.push_back(parseMethodUse(name));
    return uses;
}

}  // namespace defocus::engine
