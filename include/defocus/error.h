#pragma once
// Exceptions of the library. Every runtime failure (file, setting, shader, driver) throws Error. The text of an Error
// is one line: the failed action, the file or name concerned, and what to do about it.

#include <stdexcept>

#include "defocus/export.h"

namespace defocus {

class DEFOCUS_API Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// An invalid request, whatever the files contain: a value out of its range or an unknown name.
class DEFOCUS_API UsageError : public Error {
public:
    using Error::Error;
};

}  // namespace defocus
