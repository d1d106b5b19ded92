#pragma once
// The numbers of a Lens by their names: one table for the command line, the extras of glTF cameras, shot files, image
// metadata and panels.

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "defocus/lens.h"
#include "lens/lens.h"

namespace defocus::engine {

// What a value of the lens shapes, which decides whether it has an effect.
enum class LensFeature {
    camera,     // field of view, focus mechanics, exposure
    fStop,      // blur and exposure
    blur,       // the size of the blur
    shape,      // the shape of the aperture
    lensPoint,  // a blur that depends on the colour or on the position in the image
};

struct LensField {
    const char* name;    // as in glTF extras and shot files: "bladeRotation"
    const char* option;  // on the command line: "--blade-rotation"
    const char* unit;  // "MM", "M", "DEG", "PX", "D" (dioptres), "N" (a count), "R" (a ratio), "S", "" (true or false)
    double min = 0;    // range of the value, in `unit`
    double max = 0;
    std::variant<double Lens::*, int Lens::*, bool Lens::*> member;
    std::variant<std::monostate, std::optional<double> LensSettings::*, std::optional<int> LensSettings::*,
                 std::optional<bool> LensSettings::*>
        given;                // the request's value, in `unit`; none: Request::focus has it
    const char* description;  // of the option
    const char* example;      // a value to begin with
    LensFeature feature = LensFeature::blur;
    bool everyday = false;    // shown by --help
    const char* schema = "";  // JSON schema of the value, if its range has gaps
};

// All of them, in the order of Lens.
std::span<const LensField> lensFields();

// Null where there is no such field.
const LensField* lensFieldNamed(std::string_view name);

// In the field's unit: degrees where a Lens holds radians, 0 or 1 for truth values.
double lensFieldValue(const Lens& lens, const LensField& field);

// Throws Error for a value out of the field's range or with a fraction where integers are meant. What depends on
// several fields is for checkLens.
void setLensField(Lens& lens, const LensField& field, double value);

// What a request says of a field, in the field's unit; none where it leaves the field to the camera. Setting it throws
// Error as setLensField does.
std::optional<double> givenLensValue(const LensSettings& given, const LensField& field);
void giveLensValue(LensSettings& given, const LensField& field, std::optional<double> value);

// Values by the names of their fields, in the fields' units.
using LensValues = std::map<std::string, double, std::less<>>;
LensValues givenLensValues(const LensSettings& given);

// Sets those of `values` that are fields of a lens; what isn't, or is out of range, is left as it was. Returns a line
// for each value out of range.
std::vector<std::string> setLensFields(Lens& lens, const LensValues& values);

}  // namespace defocus::engine
