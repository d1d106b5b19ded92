#include "lens/lens_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Infinity is not a valid input; a default of infinity is shown as "none".
const LensField fields[] = {
    {"focalLength", "--focal-length", LensSection::lens, "MM", 1e-2, 1e6, &Lens::focalLength,
     &LensSettings::focalLength,
     "Focal length in mm, which sets the field of view. Default: from the camera's field of view", "50",
     LensFeature::camera, true, "", KeyScale::logarithmic},
    {"fStop", "--fstop", LensSection::lens, "N", 1e-3, 1e6, &Lens::fStop, &LensSettings::fStop,
     "f-number of the lens, such as 1.4 or f/1.4. Default: from the camera, else 2.8", "1.4", LensFeature::fStop, true,
     "", KeyScale::logarithmic},
    {"focusDistance", "--focus-distance", LensSection::focus, "M", 1e-6, 1e12, &Lens::focusDistance, std::monostate(),
     "Distance of the focus plane along the view axis in m. All lengths accept a suffix mm, cm or m, such as 50cm. "
     "Default: from the camera, else the median depth of the surfaces in the middle of the image",
     "2.5", LensFeature::blur, true, "", KeyScale::reciprocal},
    {"horizontalAperture", "--horizontal-aperture", LensSection::lens, "MM", 1e-2, 1e6, &Lens::horizontalAperture,
     &LensSettings::horizontalAperture, "Width of the sensor in mm. Default: from the camera, else 36", "36",
     LensFeature::camera},
    {"dofEnabled", "--dof", LensSection::lens, "", 0, 1, &Lens::dofEnabled, &LensSettings::dofEnabled,
     "Depth of field; --no-dof renders the image of a pinhole camera. Default: from the camera, else on", "false",
     LensFeature::camera},
    {"blurScale", "--blur-scale", LensSection::lens, "R", 0, 1e3, &Lens::blurScale, &LensSettings::blurScale,
     "Multiplier for the blur diameter; 1 is physically correct. Default: from the camera, else 1", "2",
     LensFeature::blur, true},
    {"focusBreathing", "--focus-breathing", LensSection::lens, "", 0, 1, &Lens::focusBreathing,
     &LensSettings::focusBreathing,
     "Focus breathing: the field of view narrows as the focus distance decreases, as with a thin lens. Default: from "
     "the camera, else off",
     "true", LensFeature::camera},
    {"exposureTime", "--exposure-time", LensSection::lens, "S", 0, 1e6, &Lens::exposureTime,
     &LensSettings::exposureTime,
     "Exposure time in seconds for PNG, JPEG and video, such as 0.008 or 1/125. With --fstop and --iso, it sets the "
     "brightness as on a camera; a radiance of 1 counts as a luminance of 1 cd/m2. Does not blur motion (see "
     "--shutter). 0: --exposure sets the brightness. Default: from the camera, else 0",
     "0.02", LensFeature::exposure, false, "", KeyScale::logarithmic},
    {"iso", "--iso", LensSection::lens, "N", 1, 1e7, &Lens::iso, &LensSettings::iso,
     "ISO sensitivity, used with --exposure-time. Default: from the camera, else 100", "400", LensFeature::exposure,
     false, "", KeyScale::logarithmic},
    {"bladeCount", "--blades", LensSection::aperture, "N", 0, 64, &Lens::bladeCount, &LensSettings::bladeCount,
     "Number of aperture blades: 3 to 64, or 0 for a disk. Default: from the camera, else 0", "7", LensFeature::shape,
     false, R"({"anyOf": [{"enum": [0]}, {"type": "integer", "minimum": 3, "maximum": 64}]})"},
    {"bladeRotation", "--blade-rotation", LensSection::aperture, "DEG", -1e6, 1e6, &Lens::bladeRotation,
     &LensSettings::bladeRotation,
     "Rotation of the aperture blades in degrees. At 0, a corner points to the right. Blender's value differs by 180 "
     "degrees divided by the number of blades; files exported by Blender are converted. Default: from the camera, else "
     "0",
     "15", LensFeature::shape},
    {"bladeCurvature", "--blade-curvature", LensSection::aperture, "R", 0, 1, &Lens::bladeCurvature,
     &LensSettings::bladeCurvature,
     "Curvature of the aperture blades, from 0 (straight) to 1 (a circle). Default: from the camera, else 0", "0.5",
     LensFeature::shape},
    {"anamorphicRatio", "--anamorphic-ratio", LensSection::aperture, "R", 1e-2, 1e2, &Lens::anamorphicRatio,
     &LensSettings::anamorphicRatio,
     "Ratio of the aperture's height to its width; above 1, blurred points are tall ovals. Default: from the camera, "
     "else 1",
     "2", LensFeature::blur},
    {"obstruction", "--obstruction", LensSection::aperture, "R", 0, 0.999, &Lens::obstruction,
     &LensSettings::obstruction,
     "Diameter of the central obstruction relative to the aperture, as in a mirror lens, which gives ring-shaped "
     "bokeh; 0: none. Default: from the camera, else 0",
     "0.3", LensFeature::shape},
    {"sphericalAberration", "--spherical-aberration", LensSection::aperture, "R", -1, 1, &Lens::sphericalAberration,
     &LensSettings::sphericalAberration,
     "Strength of the spherical aberration. Above 0, blurred points are brighter at the rim, like soap bubbles; below "
     "0, they are brighter in the middle, with soft rims. Default: from the camera, else 0",
     "0.5", LensFeature::shape},
    {"catEye", "--cat-eye", LensSection::aperture, "R", 0, 1, &Lens::catEye, &LensSettings::catEye,
     "Cat's-eye bokeh: fraction of the aperture's radius that the lens barrel cuts off in the corners of the image; 0: "
     "none. Default: from the camera, else 0",
     "0.5", LensFeature::lensPoint},
    {"axialChromaticAberration", "--axial-chromatic-aberration", LensSection::aperture, "D", -100, 100,
     &Lens::axialChromaticAberration, &LensSettings::axialChromaticAberration,
     "Axial chromatic aberration, which gives colour fringes: red light focuses farther away than blue light by this "
     "number of dioptres. Default: from the camera, else 0",
     "0.2", LensFeature::lensPoint},
    {"astigmatism", "--astigmatism", LensSection::aperture, "MM", -100, 100, &Lens::astigmatism,
     &LensSettings::astigmatism,
     "Astigmatism: at the left and right edges, a point in focus becomes a radial streak of this length, in mm on the "
     "sensor. At a certain depth, points become tangential streaks: in front of the focus plane if the value is above "
     "0, behind the focus plane if it is below 0. Default: from the camera, else 0",
     "0.2", LensFeature::lensPoint},
    {"coma", "--coma", LensSection::aperture, "MM", -100, 100, &Lens::coma, &LensSettings::coma,
     "Coma: length, in mm on the sensor, of the tail that a point gets at the left and right edges. Above 0, the tail "
     "points outwards. Default: from the camera, else 0",
     "0.2", LensFeature::lensPoint},
    {"foregroundLimit", "--foreground-limit", LensSection::lens, "PX", 0, 1e6, &Lens::foregroundLimit,
     &LensSettings::foregroundLimit,
     "Maximum blur diameter in front of the focus plane, in px. Default: from the camera, else unlimited", "20"},
    {"backgroundLimit", "--background-limit", LensSection::lens, "PX", 0, 1e6, &Lens::backgroundLimit,
     &LensSettings::backgroundLimit,
     "Maximum blur diameter behind the focus plane, in px. Default: from the camera, else unlimited", "40"},
    {"focusRangeFront", "--focus-range-front", LensSection::focus, "M", 0, 1e12, &Lens::focusRangeFront,
     &LensSettings::focusRangeFront,
     "Length in m of the range in front of the focus plane in which everything stays sharp. Default: from the camera, "
     "else 0",
     "0.5"},
    {"focusRangeBehind", "--focus-range-behind", LensSection::focus, "M", 0, 1e12, &Lens::focusRangeBehind,
     &LensSettings::focusRangeBehind,
     "Length in m of the range behind the focus plane in which everything stays sharp. Default: from the camera, else "
     "0",
     "1"},
    {"focusRangeRefocuses", "--focus-range-refocuses", LensSection::focus, "", 0, 1, &Lens::focusRangeRefocuses,
     &LensSettings::focusRangeRefocuses,
     "Blur everything behind the sharp range (--focus-range-behind) as if the lens were focused at the range's far "
     "end. If off, the blur at infinity is the same as without a sharp range. Default: from the camera, else off",
     "true"},
    {"focusTilt", "--focus-tilt", LensSection::focus, "DEG", -89.9, 89.9, &Lens::focusTilt, &LensSettings::focusTilt,
     "Tilt of the focus plane about the horizontal axis, in degrees; above 0, its top is nearer. Default: from the "
     "camera, else 0",
     "10"},
    {"focusSwing", "--focus-swing", LensSection::focus, "DEG", -89.9, 89.9, &Lens::focusSwing,
     &LensSettings::focusSwing,
     "Swing of the focus plane about the vertical axis, in degrees; above 0, its right side is nearer. Default: from "
     "the camera, else 0",
     "10"},
    {"fieldCurvature", "--field-curvature", LensSection::focus, "R", -1e3, 1e3, &Lens::fieldCurvature,
     &LensSettings::fieldCurvature,
     "Field curvature R. Above 0, the edges of the image focus nearer than its centre: at focus distance / (1 + R) at "
     "the left and right edges. Default: from the camera, else 0",
     "0.2"},
    {"radialBlurGain", "--radial-blur-gain", LensSection::lens, "R", 0, 1e3, &Lens::radialBlurGain,
     &LensSettings::radialBlurGain,
     "Radial blur gain R: the blur increases with the distance from the image centre and is multiplied by 1 + R at the "
     "left and right edges. Default: from the camera, else 0",
     "1"},
};

bool isAngle(const LensField& field) {
    return std::string_view(field.unit) == "DEG";
}

}  // namespace

std::span<const LensField> lensFields() {
    return fields;
}

const LensField* lensFieldNamed(std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(fields), std::end(fields), [&](const LensField& field) { return field.name == name; });
    return found == std::end(fields) ? nullptr : found;
}

double lensFieldValue(const Lens& lens, const LensField& field) {
    const double value = std::visit([&](auto member) { return static_cast<double>(lens.*member); }, field.member);
    return isAngle(field) ? value / degree : value;
}

bool overridden(const Lens& lens, const LensField& field) {
    const std::string_view name = field.name;
    if (name == "iso") return !(lens.exposureTime > 0);
    if (name == "bladeRotation") return lens.bladeCount == 0 && !lens.apertureImage;
    if (name == "bladeCurvature") return lens.bladeCount == 0 || lens.apertureImage;
    return field.feature == LensFeature::shape && lens.apertureImage;
}

void setLensField(Lens& lens, const LensField& field, double value) {
    const bool isInteger = !std::holds_alternative<double Lens::*>(field.member);
    if (!(value >= field.min && value <= field.max) || (isInteger && value != std::floor(value)))
        fail("{} must be {} from {} to {}, not {}", field.name, isInteger ? "an integer" : "a number", field.min,
             field.max, value);
    if (field.name == std::string_view("bladeCount") && (value == 1 || value == 2))
        fail("bladeCount must be 0 (a disk) or 3 to 64, not {}", value);
    if (const auto* number = std::get_if<double Lens::*>(&field.member))
        lens.** number = isAngle(field) ? value * degree : value;
    else if (const auto* count = std::get_if<int Lens::*>(&field.member))
        lens.** count = static_cast<int>(value);
    else
        lens.*std::get<bool Lens::*>(field.member) = value != 0;
}

std::optional<double> givenLensValue(const LensSettings& given, const LensField& field) {
    return std::visit(
        [&](auto member) -> std::optional<double> {
            if constexpr (std::is_same_v<decltype(member), std::monostate>)
                return {};
            else
                return given.*member ? std::optional(static_cast<double>(*(given.*member))) : std::nullopt;
        },
        field.given);
}

void giveLensValue(LensSettings& given, const LensField& field, std::optional<double> value) {
    if (value) {
        Lens scratch;
        setLensField(scratch, field, *value);  // throws Error for values out of range
    }
    std::visit(
        [&](auto member) {
            if constexpr (!std::is_same_v<decltype(member), std::monostate>) {
                using Value = typename std::decay_t<decltype(given.*member)>::value_type;
                (given.*member).reset();
                if (value) given.*member = static_cast<Value>(*value);
            }
        },
        field.given);
}

LensValues givenLensValues(const LensSettings& given) {
    LensValues values;
    for (const LensField& field : fields)
        if (const std::optional<double> value = givenLensValue(given, field)) values[field.name] = *value;
    return values;
}

std::vector<std::string> setLensFields(Lens& lens, const LensValues& values) {
    std::vector<std::string> refused;
    for (const auto& [name, value] : values) {
        const LensField* field = lensFieldNamed(name);
        if (field == nullptr) continue;
        try {
            setLensField(lens, *field, value);
        } catch (const Error& error) {
            refused.emplace_back(error.what());
        }
    }
    return refused;
}

}  // namespace defocus::engine
