#pragma once
// What a length of 1 in a scene is. glTF has metres; many files hold centimetres, millimetres or nothing in particular.

#include <string>

namespace defocus::engine {

// Metres of a unit: "m", "cm", "mm", or a number of metres from 1e-9 to 1e9. Throws Error for anything else.
double metresOfUnit(const std::string& text);

// The text that metresOfUnit reads as `metres`: a unit's name where it has one.
std::string unitOfMetres(double metres);

// A guess for a scene of which the image frames `extent` units: metres, where that is a thing from the size of a thumb
// (5 cm) to that of a building (30 m); else the power of ten that makes of it what comes nearest to 75 cm. 1 for an
// extent that is no positive number.
double guessedMetresPerUnit(double extent);

}  // namespace defocus::engine
