#pragma once
// The one exception of defocus. A runtime failure (a file, user input, a shader, the driver) throws `Error` with what
// was being done, the file or name concerned, and what to do about it, as ONE line. Broken invariants are assertions
// instead; a miss that callers expect is a std::optional. Only `main` catches.

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace defocus {

class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// What was asked for makes no sense by itself: a wrong command line (exit code 2) or request.
class UsageError : public Error {
public:
    using Error::Error;
};

// Throws Error with a formatted one-line message, e.g. fail("{}: not a glTF file", path).
template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace defocus
