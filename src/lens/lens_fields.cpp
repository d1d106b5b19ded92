#include "lens/lens_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace defocus {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Infinity is no value that anybody types; a default of infinity stands for "none".
const LensField fields[] = {
    {"focalLength", "--focal-length", "MM", 1e-2, 1e6, &Lens::focalLength, &LensSettings::focalLength,
     "Sets the field of view; without it, it follows from the camera's"},
    {"fStop", "--fstop", "N", 1e-3, 1e6, &Lens::fStop, &LensSettings::fStop,
     "f-number; without it, the camera's own, else 2.8"},
    {"focusDistance", "--focus-distance", "M", 1e-6, 1e12, &Lens::focusDistance, &LensSettings::focusDistance,
     "Distance of the focus plane along the view axis; without any focus option, the camera's own, else the median "
     "depth of what the middle of the image shows"},
    {"horizontalAperture", "--horizontal-aperture", "MM", 1e-2, 1e6, &Lens::horizontalAperture,
     &LensSettings::horizontalAperture, "Width of the sensor; without it, the camera's own, else 36"},
    {"dofEnabled", "--dof", "", 0, 1, &Lens::dofEnabled, &LensSettings::dofEnabled, "Off: a pinhole, everything sharp"},
    {"blurScale", "--blur-scale", "R", 0, 1e3, &Lens::blurScale, &LensSettings::blurScale,
     "Exaggerates the blur; 1 is physical"},
    {"focusBreathing", "--focus-breathing", "", 0, 1, &Lens::focusBreathing, &LensSettings::focusBreathing,
     "The textbook thin lens, whose field of view narrows as the focus comes nearer"},
    {"exposureTime", "--exposure-time", "S", 0, 1e6, &Lens::exposureTime, &LensSettings::exposureTime,
     "Exposes .png, .jpg and film as a camera does, with the f-number and --iso: seconds, as 0.008 or 1/125; a scene's "
     "value of 1 is 1 cd/m2 (glTF's lights have cd and lx). Without it (or 0), --exposure. Motion blur has a --shutter "
     "of its own"},
    {"iso", "--iso", "N", 1, 1e7, &Lens::iso, &LensSettings::iso,
     "Sensitivity for --exposure-time; without it, the camera's own, else 100"},
    {"bladeCount", "--blades", "N", 0, 64, &Lens::bladeCount, &LensSettings::bladeCount,
     "Blades of the aperture: 3 to 64, or 0 for a disk"},
    {"bladeRotation", "--blade-rotation", "DEG", -1e6, 1e6, &Lens::bladeRotation, &LensSettings::bladeRotation,
     "Turns the blades; at 0 a corner points to the right. Blender has the middle of an edge there: add 180/N for its "
     "picture. Extras of files that Blender wrote are turned so as they are read"},
    {"bladeCurvature", "--blade-curvature", "R", 0, 1, &Lens::bladeCurvature, &LensSettings::bladeCurvature,
     "Bends the blades outwards, from 0 (straight) to 1 (a circle)"},
    {"anamorphicRatio", "--anamorphic-ratio", "R", 1e-2, 1e2, &Lens::anamorphicRatio, &LensSettings::anamorphicRatio,
     "Above 1, blurred points are tall ovals"},
    {"obstruction", "--obstruction", "R", 0, 0.999, &Lens::obstruction, &LensSettings::obstruction,
     "Rings, as of a mirror lens: the inner diameter over the outer"},
    {"sphericalAberration", "--spherical-aberration", "R", -1, 1, &Lens::sphericalAberration,
     &LensSettings::sphericalAberration,
     "Above 0, blurred points are brighter at their rim (soap bubbles), below 0 in their middle (creamy)"},
    {"catEye", "--cat-eye", "R", 0, 1, &Lens::catEye, &LensSettings::catEye,
     "Blurred points narrow towards the image's corners: how far the barrel hides the aperture there, in radii"},
    {"axialChromaticAberration", "--axial-chromatic-aberration", "D", -100, 100, &Lens::axialChromaticAberration,
     &LensSettings::axialChromaticAberration, "Colour fringes: dioptres by which red focuses farther away than blue"},
    {"astigmatism", "--astigmatism", "MM", -100, 100, &Lens::astigmatism, &LensSettings::astigmatism,
     "Points in focus become lines that point to the image's centre: their length on the sensor at its left and right "
     "edge. Below 0, they are blurred as lines where the focus lies on the other side"},
    {"coma", "--coma", "MM", -100, 100, &Lens::coma, &LensSettings::coma,
     "Points grow tails, away from the image's centre (above 0) or towards it: their length on the sensor at its left "
     "and right edge"},
    {"foregroundLimit", "--foreground-limit", "PX", 0, 1e6, &Lens::foregroundLimit, &LensSettings::foregroundLimit,
     "Largest blur in front of the focus plane"},
    {"backgroundLimit", "--background-limit", "PX", 0, 1e6, &Lens::backgroundLimit, &LensSettings::backgroundLimit,
     "Largest blur behind the focus plane"},
    {"focusRangeFront", "--focus-range-front", "M", 0, 1e12, &Lens::focusRangeFront, &LensSettings::focusRangeFront,
     "How much in front of the focus distance is in focus too; the blur grows from there"},
    {"focusRangeBehind", "--focus-range-behind", "M", 0, 1e12, &Lens::focusRangeBehind, &LensSettings::focusRangeBehind,
     "How much behind the focus distance is in focus too"},
    {"focusRangeRefocuses", "--focus-range-refocuses", "", 0, 1, &Lens::focusRangeRefocuses,
     &LensSettings::focusRangeRefocuses,
     "Behind the focus range, the blur of a lens that is focused at the range's far end; off: it grows from there to "
     "what "
     "it is far away without a range"},
    {"focusTilt", "--focus-tilt", "DEG", -89.9, 89.9, &Lens::focusTilt, &LensSettings::focusTilt,
     "Turns the focus plane about the horizontal axis: above 0, its top comes nearer"},
    {"focusSwing", "--focus-swing", "DEG", -89.9, 89.9, &Lens::focusSwing, &LensSettings::focusSwing,
     "Turns the focus plane about the vertical axis: above 0, its right side comes nearer"},
    {"fieldCurvature", "--field-curvature", "R", -1e3, 1e3, &Lens::fieldCurvature, &LensSettings::fieldCurvature,
     "Bends the focus surface: at the image's left and right edge it lies at the focus distance over 1 + R"},
    {"radialBlurGain", "--radial-blur-gain", "R", 0, 1e3, &Lens::radialBlurGain, &LensSettings::radialBlurGain,
     "More blur away from the image's centre: 1 + R times as much at the left and right edge"},
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

void setLensField(Lens& lens, const LensField& field, double value) {
    const bool whole = !std::holds_alternative<double Lens::*>(field.member);
    if (!(value >= field.least && value <= field.most) || (whole && value != std::floor(value)))
        fail("{} must be {} from {} to {}, not {}", field.name, whole ? "a whole number" : "a number", field.least,
             field.most, value);
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
        [&](auto member) {
            const auto& value = given.*member;
            return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
        },
        field.given);
}

void giveLensValue(LensSettings& given, const LensField& field, std::optional<double> value) {
    if (value) {
        Lens scratch;
        setLensField(scratch, field, *value);  // finds fault with what no lens can have
    }
    std::visit(
        [&](auto member) {
            using Value = typename std::decay_t<decltype(given.*member)>::value_type;
            (given.*member).reset();
            if (value) given.*member = static_cast<Value>(*value);
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

}  // namespace defocus
