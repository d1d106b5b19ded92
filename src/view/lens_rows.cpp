#include "view/lens_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "view/widgets.h"

namespace defocus {

namespace {

const char* unitText(const LensField& field) {
    const std::string_view unit = field.unit;
    return unit == "MM"    ? " mm"
           : unit == "M"   ? " m"
           : unit == "DEG" ? "°"
           : unit == "PX"  ? " px"
           : unit == "D"   ? " D"
                           : "";
}

double dragStep(const LensField& field, double value) {
    const std::string_view unit = field.unit;
    if (unit == "DEG") return 0.25;
    if (unit == "PX") return 0.5;
    if (unit == "R") return 0.005;
    if (unit == "S") return std::max(1e-5, 0.005 * value);
    return std::max(1e-3, 0.005 * std::abs(value));
}

// Sets the field if the lens stays possible with it.
bool trySet(Lens& lens, const LensField& field, double value) {
    Lens changed = lens;
    try {
        setLensField(changed, field, std::clamp(value, field.least, field.most));
        checkLens(changed);
    } catch (const Error&) {
        return false;
    }
    lens = changed;
    return true;
}

bool countRow(Lens& lens, const LensField& field, double value) {
    int count = static_cast<int>(value);
    const int before = count;
    if (!ImGui::SliderInt("##value", &count, 0, 16, count == 0 ? "round" : "%d")) return false;
    if (count == 1 || count == 2) count = before >= 3 ? 0 : 3;  // no polygon has fewer than three corners
    return trySet(lens, field, count);
}

// A value of the field that means none at all, and one to begin with instead.
struct NoneValue {
    double none = 0;
    double first = 0;
};

std::optional<NoneValue> noneValue(const LensField& field) {
    if (field.name == std::string_view("exposureTime")) return NoneValue{0, 1.0 / 125};
    const double standard = lensFieldValue(Lens{}, field);
    return std::isinf(standard) ? std::optional(NoneValue{standard, 16}) : std::nullopt;
}

// As ImGui prints the number.
std::string numberFormat(const LensField& field, double value) {
    if (field.unit == std::string_view("S")) return secondsFormat(value);
    return (std::abs(value) >= 1e4 ? "%.0f" : std::abs(value) >= 100 ? "%.4g" : "%.3g") + std::string(unitText(field));
}

bool numberRow(Lens& lens, const LensField& field, double value) {
    if (const std::optional<NoneValue> none = noneValue(field)) {
        bool given = value != none->none;
        if (ImGui::Checkbox("##given", &given)) {
            lens.*std::get<double Lens::*>(field.member) = given ? none->first : none->none;
            return true;
        }
        ImGui::SameLine();
        if (!given) {
            ImGui::TextDisabled("none");
            return false;
        }
        ImGui::SetNextItemWidth(-1);
    }
    double edited = value;
    const bool bounded = field.most <= 1 && field.least >= -1;
    const bool changed =
        bounded
            ? ImGui::SliderScalar("##value", ImGuiDataType_Double, &edited, &field.least, &field.most, "%.2f")
            : ImGui::DragScalar("##value", ImGuiDataType_Double, &edited, static_cast<float>(dragStep(field, value)),
                                &field.least, &field.most, numberFormat(field, value).c_str());
    return changed && trySet(lens, field, edited);
}

// Without what it says something with, a value says nothing.
bool saysNothing(const Lens& lens, std::string_view name) {
    if (name == "iso") return !(lens.exposureTime > 0);
    if (name == "bladeRotation") return lens.bladeCount == 0 && !lens.apertureImage;
    if (name == "bladeCurvature") return lens.bladeCount == 0 || lens.apertureImage;
    const bool ofShape = name == "bladeCount" || name == "obstruction" || name == "sphericalAberration";
    return ofShape && lens.apertureImage;
}

}  // namespace

std::string secondsFormat(double seconds) {
    const bool fraction = seconds > 0 && seconds < 0.4;
    return (fraction ? fmt::format("1/{:.0f}   ", 1 / seconds) : "") + "%.3g s";
}

std::string fieldLabel(std::string_view name) {
    std::string label;
    for (const char letter : name) {
        const bool capital = letter >= 'A' && letter <= 'Z';
        if (capital) label += ' ';
        label += capital ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    if (label == "f stop") return "f-stop";
    if (label == "dof enabled") return "Depth of field";
    if (label == "iso") return "ISO";
    if (label == "axial chromatic aberration") return "Axial colour";
    if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] = static_cast<char>(label[0] - 'a' + 'A');
    return label;
}

bool lensFieldRow(Lens& lens, const LensField& field) {
    const double value = lensFieldValue(lens, field);
    ImGui::PushID(field.name);
    rowLabel(fieldLabel(field.name).c_str(), fmt::format("{} ({})", field.description, field.option).c_str());
    bool changed = false;
    ImGui::BeginDisabled(saysNothing(lens, field.name));
    if (std::holds_alternative<bool Lens::*>(field.member)) {
        bool on = value != 0;
        if (ImGui::Checkbox("##value", &on)) changed = trySet(lens, field, on ? 1 : 0);
    } else {
        changed = std::holds_alternative<int Lens::*>(field.member) ? countRow(lens, field, value)
                                                                    : numberRow(lens, field, value);
    }
    ImGui::EndDisabled();
    ImGui::PopID();
    return changed;
}

}  // namespace defocus
