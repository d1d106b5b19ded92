// Defines the settings of the lens and the focus.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/parse.h"
#include "frame/settings/conditions.h"
#include "frame/settings/rows.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

// Each set… function parses the text of a value. If the text is invalid, it throws Error with the allowed values in its
// message. Each …Text function returns nullopt if the value is unset.

constexpr std::size_t minFocusPoints = 3;
constexpr std::size_t maxFocusPoints = 16;

Pixel parsePixel(const std::string& column, const std::string& row) {
    return {static_cast<int>(parseInteger(column, 0, maxImageSide - 1)),
            static_cast<int>(parseInteger(row, 0, maxImageSide - 1))};
}

// Restores the default focus if the request's focus has the type Choice.
template <typename Choice>
void clearFocus(Request& request) {
    if (std::holds_alternative<Choice>(request.focus)) request.focus = CameraFocus{};
}

double parseLensValue(const LensField& field, const std::string& text) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return rows::parseBoolean(text) ? 1 : 0;
    if (std::holds_alternative<int Lens::*>(field.member))
        return static_cast<double>(
            parseInteger(text, static_cast<std::uint64_t>(field.min), static_cast<std::uint64_t>(field.max)));
    if (std::string_view(field.unit) == "S") return parseSeconds(text);
    if (std::string_view(field.name) == "fStop" && text.starts_with("f/"))
        return parseNumber(text.substr(2), {field.min, field.max});
    return parseNumber(text, {field.min, field.max});
}

std::optional<std::string> lensText(const LensSettings& lens, const LensField& field) {
    const std::optional<double> value = givenLensValue(lens, field);
    if (!value) return std::nullopt;
    if (std::holds_alternative<bool Lens::*>(field.member)) return *value != 0 ? "true" : "false";
    return fmt::format("{}", std::min(*value, field.max));
}

void setFocusDistance(Request& request, const std::string& text) {
    request.focus = FocusDistance{parseLensValue(*lensFieldNamed("focusDistance"), text)};
}

std::optional<std::string> focusDistanceText(const Request& request) {
    const auto* const focus = std::get_if<FocusDistance>(&request.focus);
    return focus != nullptr ? std::optional(fmt::format("{}", focus->metres)) : std::nullopt;
}

void setFocusNode(Request& request, const std::string& text) {
    if (text.empty())
        clearFocus<FocusNode>(request);
    else
        request.focus = FocusNode{text};
}

std::optional<std::string> focusNodeText(const Request& request) {
    const auto* const focus = std::get_if<FocusNode>(&request.focus);
    return focus != nullptr ? std::optional(focus->name) : std::nullopt;
}

void setFocusPixel(Request& request, const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) fail("'{}' is not X,Y (column and row, 0,0 at the top left)", text);
    request.focus = FocusPixel{parsePixel(text.substr(0, comma), text.substr(comma + 1))};
}

std::optional<std::string> focusPixelText(const Request& request) {
    const auto* const focus = std::get_if<FocusPixel>(&request.focus);
    if (focus == nullptr) return std::nullopt;
    return fmt::format("{},{}", focus->pixel.column, focus->pixel.row);
}

void setFocusPoints(Request& request, const std::string& text) {
    const std::vector<std::string> parts = splitAt(text, ',');
    if (parts.size() < 2 * minFocusPoints || parts.size() % 2 != 0 || parts.size() > 2 * maxFocusPoints)
        fail("'{}' is not X,Y,X,Y,X,Y (the columns and rows of {} to {} pixels)", text, minFocusPoints, maxFocusPoints);
    FocusPoints points;
    for (std::size_t i = 0; i < parts.size(); i += 2) points.pixels.push_back(parsePixel(parts[i], parts[i + 1]));
    request.focus = std::move(points);
}

std::optional<std::string> focusPointsText(const Request& request) {
    const auto* const focus = std::get_if<FocusPoints>(&request.focus);
    if (focus == nullptr) return std::nullopt;
    std::vector<int> numbers;
    for (const Pixel& pixel : focus->pixels) numbers.insert(numbers.end(), {pixel.column, pixel.row});
    return fmt::format("{}", fmt::join(numbers, ","));
}

void setFocusAuto(Request& request, const std::string& text) {
    if (rows::parseBoolean(text))
        request.focus = FocusAuto{};
    else
        clearFocus<FocusAuto>(request);
}

std::optional<std::string> focusAutoText(const Request& request) {
    return std::holds_alternative<FocusAuto>(request.focus) ? "true" : "false";
}

// Splits the text at the last '=', because the node's name may contain '='.
void addNodeBlur(Request& request, const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) fail("'{}' is not NAME=SCALE, such as Fish3=0", text);
    request.nodeBlur[text.substr(0, equals)] = parseNumber(text.substr(equals + 1), {0, 1e3});
}

std::vector<std::string> nodeBlurTexts(const Request& request) {
    std::vector<std::string> texts;
    for (const auto& [name, scale] : request.nodeBlur) texts.push_back(fmt::format("{}={}", name, scale));
    return texts;
}

std::optional<std::string> nodeBlurText(const Request& request) {
    if (request.nodeBlur.empty()) return std::nullopt;
    return fmt::format("{}", fmt::join(nodeBlurTexts(request), ","));
}

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
                    "Tilt the focus plane so that it passes through the surfaces at three pixels. With 4 to 16 "
                    "pixels, fit a curved focus surface that minimizes the sum of the squared blur at these pixels")
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
                               "Image of the aperture; bright pixels transmit light. The longer side of the image "
                               "spans the aperture's diameter. Replaces --blades, --obstruction and "
                               "--spherical-aberration")
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
