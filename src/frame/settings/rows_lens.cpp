// Defines the settings of the lens and the focus.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "frame/settings/conditions.h"
#include "frame/settings/rows.h"
#include "frame/settings/values.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

std::string unitOf(std::string_view metavar) {
    if (metavar == "MM") return "mm";
    if (metavar == "M") return "m";
    if (metavar == "DEG") return "degrees";
    if (metavar == "PX") return "px";
    if (metavar == "D") return "dioptres";
    if (metavar == "S") return "s";
    return "";
}

// Returns the function that gives the reason why a setting of the lens has no effect.
Setting::Unused unusedLensField(LensFeature feature) {
    switch (feature) {
        case LensFeature::camera:
        case LensFeature::exposure:
            return {};
        case LensFeature::fStop:
            return withoutBlurOrExposure;
        case LensFeature::blur:
            return withoutBlur;
        case LensFeature::shape:
            return [](const SettingContext& context) { return firstOf(context, {methodWithoutShapes, withoutBlur}); };
        case LensFeature::lensPoint:
            return [](const SettingContext& context) {
                return firstOf(context, {methodWithoutLensPoints, withoutBlur});
            };
    }
    return {};
}

Row lensRow(const LensField& field) {
    const SettingKind kind = std::holds_alternative<bool Lens::*>(field.member)  ? SettingKind::boolean
                             : std::holds_alternative<int Lens::*>(field.member) ? SettingKind::integer
                                                                                 : SettingKind::number;
    Row row = Row(kind, field.name, field.option, field.unit, field.description)
                  .unit(unitOf(field.unit))
                  .range(field.min, field.max)
                  .everyday(field.everyday)
                  .example(field.example)
                  .inShot(fmt::format("/lens/{}", field.name))
                  .keyed()
                  .lensField()
                  .json(field.schema)
                  .effect(field.feature == LensFeature::exposure ? SettingEffect::display : SettingEffect::pixels)
                  .unused(unusedLensField(field.feature));
    if (field.name == std::string_view("focusDistance"))
        return std::move(row).values(setFocusDistance, focusDistanceText, clearFocus<FocusDistance>);
    return std::move(row).values(
        [&field](Request& request, const std::string& text) {
            giveLensValue(request.lens, field, parseLensValue(field, text));
        },
        [&field](const Request& request) { return lensText(request.lens, field); },
        [&field](Request& request) { giveLensValue(request.lens, field, std::nullopt); });
}

Rows focusRows() {
    return {
        rows::other("focusNode", "--focus-node", "NAME", setFocusNode, focusNodeText,
                    "Focus on a node, given by name or number: on the centre of its mesh's bounding box, or on its "
                    "origin if it has no mesh")
            .clears(clearFocus<FocusNode>)
            .everyday()
            .excludes({"focusDistance"})
            .unused(withoutBlur),
        rows::other("focusPixel", "--focus-pixel", "X,Y", setFocusPixel, focusPixelText,
                    "Focus on the surface at this pixel; 0,0 is the top left pixel")
            .clears(clearFocus<FocusPixel>)
            .excludes({"focusDistance", "focusNode"})
            .unused(withoutBlur),
        rows::other("focusPoints", "--focus-points", "X,Y,X,Y,X,Y", setFocusPoints, focusPointsText,
                    "Tilt the focus plane through the surfaces at three pixels. With 4 to 16 pixels, fit a curved "
                    "surface of focus to them (least squares of the blur)")
            .clears(clearFocus<FocusPoints>)
            .excludes({"focusDistance", "focusNode", "focusPixel"})
            .unused(withoutBlur),
        rows::other("focusAuto", "--focus-auto", "", setFocusAuto, focusAutoText,
                    "Focus on the median depth of the surfaces in the middle of the image")
            .kind(SettingKind::boolean)
            .clears(clearFocus<FocusAuto>)
            .excludes({"focusDistance", "focusNode", "focusPixel", "focusPoints"})
            .unused(withoutBlur),
    };
}

}  // namespace

Rows lensRows() {
    Rows rows;
    for (const LensField& field : lensFields()) {
        rows.push_back(lensRow(field));
        if (rows.back().name == "focusDistance") std::ranges::move(focusRows(), std::back_inserter(rows));
    }
    rows.push_back(rows::words(SettingKind::path, "apertureImage", "--aperture-image", "FILE",
                               MEMBER(lens.apertureImage),
                               "Image of the aperture; bright pixels transmit light. Its longer side is as long as the "
                               "aperture's diameter. Replaces --blades and --obstruction")
                       .unused(unusedLensField(LensFeature::shape)));
    rows.push_back(rows::other("nodeBlur", "--node-blur", "NAME=SCALE", addNodeBlur, nodeBlurText,
                               "Scale the blur of a node, given by name or number, and of its children; 0 keeps them "
                               "sharp. Can be given several times")
                       .clears(MEMBER(nodeBlur))
                       .repeats(nodeBlurTexts)
                       .unused(withoutBlur));
    return rows;
}

}  // namespace defocus::engine
