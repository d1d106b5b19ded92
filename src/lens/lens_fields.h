#pragma once
// Lists the numeric fields of a Lens by name, for the command line, glTF camera extras, shot files, image metadata and
// control panels.

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

// Kind of effect that a lens value has. Values whose effect a frame does not show are reported as unused.
enum class LensFeature {
    camera,    // changes the field of view, or turns depth of field off
    exposure,  // changes only the brightness of PNG, JPEG and video
    fStop,     // changes the size of the blur, and the exposure
    blur,      // changes the size of the blur
    shape,     // changes the shape of the aperture
    // Makes the blur depend on the colour or on the image position: cat's eye, axial chromatic aberration, astigmatism,
    // coma.
    lensPoint,
};

// Scale on which numbers are interpolated between keyframes.
enum class KeyScale {
    linear,
    logarithmic,  // for values whose ratios matter, such as f-numbers
    reciprocal,   // for distances: their reciprocals, in dioptres, are interpolated
};

// Section of control panels and help texts in which a lens value is listed.
enum class LensSection { focus, lens, aperture };

struct LensField {
    const char* name;    // name in glTF extras and shot files: "bladeRotation"
    const char* option;  // name on the command line: "--blade-rotation"
    LensSection section;
    // "MM", "M", "DEG", "PX", "D" (dioptres), "N" (a count), "R" (a ratio), "S", or "" (a boolean).
    const char* unit;
    double min = 0;  // range of the value, in `unit`
    double max = 0;
    std::variant<double Lens::*, int Lens::*, bool Lens::*> member;
    // Member of LensSettings that holds the value in a request, in `unit`. monostate: there is no such member, because
    // Request::focus sets the value.
    std::variant<std::monostate, std::optional<double> LensSettings::*, std::optional<int> LensSettings::*,
                 std::optional<bool> LensSettings::*>
        given;
    const char* description;  // help text of the option
    const char* example;      // typical value as text
    LensFeature feature = LensFeature::blur;
    bool everyday = false;    // true: listed by --help; false: only by --help-all
    const char* schema = "";  // JSON schema of a value with gaps in its range; empty: min and max suffice
    // Booleans and integers are not interpolated: each value holds until the next keyframe.
    KeyScale keyScale = KeyScale::linear;
};

// Returns all fields, in the order of Lens.
std::span<const LensField> lensFields();

// Returns the field with this name, or null if there is none.
const LensField* lensFieldNamed(std::string_view name);

// Returns the value in the field's unit: degrees where a Lens holds radians, 0 or 1 for booleans.
double lensFieldValue(const Lens& lens, const LensField& field);

// Returns true if the field has no effect because of the lens's other values. Example: an aperture image replaces the
// blades.
bool overridden(const Lens& lens, const LensField& field);

// Sets the field. Throws Error if the value is out of range, or fractional for an integer field. checkLens checks
// constraints between fields.
void setLensField(Lens& lens, const LensField& field, double value);

// givenLensValue returns, and giveLensValue sets, a request's value of a field, in the field's unit. nullopt: the value
// of the file's camera applies. giveLensValue throws Error like setLensField.
std::optional<double> givenLensValue(const LensSettings& given, const LensField& field);
void giveLensValue(LensSettings& given, const LensField& field, std::optional<double> value);

// Values by field name, in the fields' units.
using LensValues = std::map<std::string, double, std::less<>>;
LensValues givenLensValues(const LensSettings& given);

// Sets those fields of a lens that `values` contains. Unknown names and values out of range are ignored. Returns one
// message per value out of range.
std::vector<std::string> setLensFields(Lens& lens, const LensValues& values);

}  // namespace defocus::engine
