#pragma once
// Exceptions of the library. Every runtime failure (file, setting, shader, driver) throws Error. Its message is one
// line: what failed, which file or name, and what to do.

#include <stdexcept>

#include "defocus/export.h"

namespace defocus {

class DEFOCUS_API Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Thrown for a request that is invalid for any scene: an unknown name or a value out of range.
class DEFOCUS_API UsageError : public Error {
public:
    using Error::Error;
};

}  // namespace defocus
