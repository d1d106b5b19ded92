#pragma once
// The one exception of defocus. A runtime failure (a file, user input, a shader, the driver) throws `Error` with what
// was being done, the file or name concerned, and what to do about it, as ONE line. Broken invariants are assertions
// instead; a miss that callers expect is a std::optional. Only `main` catches.

#include <fmt/format.h>

#include <string>
#include <utility>

#include "defocus/error.h"

namespace defocus::engine {

// Throws Error with a formatted one-line message, e.g. fail("{}: not a glTF file", path).
template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fmt::format(format, std::forward<Args>(args)...));
}

// A name that a scene doesn't have, such as that of a node. What read the name from a file knows where it stands there.
class MissingName : public Error {
public:
    MissingName(std::string name, const std::string& message) : Error(message), name_(std::move(name)) {}
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    std::string name_;
};

}  // namespace defocus::engine
