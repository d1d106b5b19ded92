#pragma once
// Converts the length units of scenes and of values that users type. glTF prescribes metres, but many files use
// centimetres, millimetres or arbitrary units.

#include <string>

namespace defocus::engine {

// Returns the metres per unit from a string: "m", "cm", "mm", or a number of metres from 1e-9 to 1e9. Throws Error
// otherwise.
double metresOfUnit(const std::string& text);

// Inverse of metresOfUnit: returns "m", "cm" or "mm" if `metres` is the length of that unit, else the number as text.
std::string unitOfMetres(double metres);

// Converts a length with a suffix mm, cm or m to a plain number in `unit`, which is "mm" or "m". For example,
// lengthsIn("m", "50cm") returns "0.5". Each part of a comma-separated list is converted by itself. Parts that are not
// a number with a suffix stay unchanged.
std::string lengthsIn(const std::string& unit, const std::string& text);

// Guesses the metres per unit of a scene from the size `extent` of the framed objects in scene units. Returns 1 for
// extents from 0.05 to 30: from the size of a thumb to that of a building, in metres. For other extents, returns the
// power of ten that brings the extent closest to 0.75 m. Returns 1 for extents that are not positive and finite.
double guessedMetresPerUnit(double extent);

}  // namespace defocus::engine
