#pragma once
// Names of enumerators.

#include <cstddef>

namespace defocus::engine {

// Returns the name of `value`. `names` has one name per enumerator, in the order of declaration, up to `last`.
template <auto last, std::size_t count>
constexpr const char* enumName(decltype(last) value, const char* const (&names)[count]) {
    static_assert(count == static_cast<std::size_t>(last) + 1);
    return names[static_cast<std::size_t>(value)];
}

}  // namespace defocus::engine
