#include "refocus/refocus_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "frame/setup/prepared_frame.h"
#include "lens/lens_fields.h"

namespace defocus {

std::vector<std::string> refocusSettings() {
    return {"focusDistance",  "focusPixel",      "fStop",       "bladeCount",          "bladeRotation",
            "bladeCurvature", "anamorphicRatio", "obstruction", "sphericalAberration", "apertureImage"};
}

}  // namespace defocus

namespace defocus::engine {

std::optional<Lens> apertureShape(const LensSettings& settings) {
    const std::vector<std::string> allowed = refocusSettings();
    Lens lens;
    bool given = !settings.apertureImage.empty();
    for (const auto& [name, value] : givenLensValues(settings)) {
        if (std::ranges::find(allowed, name) == allowed.end())
            throw UsageError(fmt::format(
                "{}: this setting cannot be changed after rendering; render the lens images again with it", name));
        try {
            setLensField(lens, *lensFieldNamed(name), value);
        } catch (const Error& error) {
            throw UsageError(error.what());
        }
        given = given || name != "fStop";
    }
    if (!settings.apertureImage.empty()) lens.apertureImage = loadApertureImage(settings.apertureImage);
    return given ? std::optional(lens) : std::nullopt;
}

Refocusing refocusingOf(const RefocusSettings& settings, LightField& field) {
    Refocusing refocusing = asRendered(field.info());
    if (const auto* const distance = std::get_if<FocusDistance>(&settings.focus))
        refocusing.focusDistance = distance->metres;
    else if (const auto* const at = std::get_if<FocusPixel>(&settings.focus))
        refocusing.focusDistance = focusAtPixel(field, at->pixel);
    else if (!std::holds_alternative<CameraFocus>(settings.focus))
        throw UsageError("to refocus lens images, give the focus as a distance or as a pixel");
    refocusing.fStop = settings.lens.fStop.value_or(refocusing.fStop);
    refocusing.shape = apertureShape(settings.lens);
    refocusing.fillGaps = settings.fillGaps;
    return refocusing;
}

}  // namespace defocus::engine
