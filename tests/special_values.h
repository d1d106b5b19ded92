#pragma once
// Lists special and extreme floating-point values for tests.

#include <limits>

namespace defocus::engine {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

}  // namespace defocus::engine
