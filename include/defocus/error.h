#pragma once
// What defocus throws. A runtime failure (a file, a setting, a shader, the driver) is an Error whose text is ONE line:
// what was being done, the file or name concerned, and what to do about it.

#include <stdexcept>

#include "defocus/export.h"

namespace defocus {

class DEFOCUS_API Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// What was asked for makes no sense by itself, whatever the files hold: a value out of its range, an unknown name.
class DEFOCUS_API UsageError : public Error {
public:
    using Error::Error;
};

}  // namespace defocus
