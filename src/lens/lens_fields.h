#pragma once
// The numbers of a Lens by their names: one table for the command line, the extras of glTF cameras, shot files, image
// metadata and panels.

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lens/lens.h"

namespace defocus {

struct LensField {
    const char* name;    // as in glTF extras and shot files: "bladeRotation"
    const char* option;  // on the command line: "--blade-rotation"
    const char* unit;  // "MM", "M", "DEG", "PX", "D" (dioptres), "N" (a count), "R" (a ratio), "S", "" (true or false)
    double least = 0;  // range of the value, in `unit`
    double most = 0;
    std::variant<double Lens::*, int Lens::*, bool Lens::*> member;
    const char* description;  // of the option
};

// All of them, in the order of Lens.
std::span<const LensField> lensFields();

// Null where there is no such field.
const LensField* lensFieldNamed(std::string_view name);

// In the field's unit: degrees where a Lens holds radians, 0 or 1 for truth values.
double lensFieldValue(const Lens& lens, const LensField& field);

// Throws Error for a value out of the field's range or with a fraction where whole numbers are meant. What depends on
// several fields is for checkLens.
void setLensField(Lens& lens, const LensField& field, double value);

// Sets those of `values` that are fields of a lens; what isn't, or is out of range, is left as it was. Returns a line
// for each value out of range.
std::vector<std::string> setLensFields(Lens& lens, const std::map<std::string, double, std::less<>>& values);

}  // namespace defocus
