#pragma once
// Length unit of a scene. glTF prescribes metres, but many files use centimetres, millimetres or arbitrary units.

#include <string>

namespace defocus::engine {

// Returns the metres per unit of a text: "m", "cm", "mm", or a number from 1e-9 to 1e9. Throws Error otherwise.
double metresOfUnit(const std::string& text);

// Inverse of metresOfUnit: returns "m", "cm" or "mm" if `metres` matches, else the number.
std::string unitOfMetres(double metres);

// Guesses the metres per unit of a scene whose framed extent is `extent` units. Returns 1 if the extent in metres lies
// between a thumb (5 cm) and a building (30 m). Otherwise returns the power of ten that brings the extent closest to 75
// cm. Returns 1 for extents that are not positive and finite.
double guessedMetresPerUnit(double extent);

}  // namespace defocus::engine
