#pragma once
// Error is the base class of the exceptions that defocus throws for runtime failures of files, user input, shaders and
// drivers. Its message is one line: the action, the file or name, and the remedy. Broken invariants are assertions
// instead; functions that may find nothing return std::optional. Catch an Error only to add context, to show the
// message, or to continue without an optional file or feature.

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

// Error for a name that is missing from the scene, such as a node name. Code that read the name from a file can catch
// the error and add the name's position in that file.
class MissingName : public Error {
public:
    MissingName(std::string name, const std::string& message) : Error(message), name_(std::move(name)) {}
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    std::string name_;
};

}  // namespace defocus::engine
