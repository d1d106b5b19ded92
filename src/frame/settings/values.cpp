#include "frame/settings/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/parse.h"
#include "frame/layer_names.h"

namespace defocus::engine {

namespace {

constexpr std::uint64_t maxSegments = 64;
constexpr std::size_t minFocusPoints = 3;
constexpr std::size_t maxFocusPoints = 16;
constexpr double farthest = 1e12;  // largest distance or coordinate, m

Pixel parsePixel(const std::string& column, const std::string& row) {
    return {static_cast<int>(parseInteger(column, 0, maxImageSide - 1)),
            static_cast<int>(parseInteger(row, 0, maxImageSide - 1))};
}

bool parseBoolean(const std::string& text) {
    return parseChoice(text, {"false", "true"}) == 1;
}

}  // namespace

void setMotionSegments(Request& request, const std::string& text) {
    if (text == "exact")
        request.motionSegments = ExactMotion{};
    else
        request.motionSegments = static_cast<std::uint32_t>(parseInteger(text, 1, maxSegments));
}

std::optional<std::string> motionSegmentsText(const Request& request) {
    const auto* const segments = std::get_if<std::uint32_t>(&request.motionSegments);
    return segments != nullptr ? fmt::format("{}", *segments) : "exact";
}

void setBackground(Request& request, const std::string& text) {
    if (text.find(',') != std::string::npos) {
        const std::vector<double> color = parseNumbers(text, 3, {0, 1e9});
        request.background =
            Color{static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
        return;
    }
    const std::size_t chosen = parseChoice(text, {"environment", "none", "R,G,B"});
    if (chosen > 1) fail("give three numbers R,G,B, such as 0.2,0.2,0.2");
    if (chosen == 0)
        request.background = EnvironmentBackground{};
    else
        request.background = TransparentBackground{};
}

std::optional<std::string> backgroundText(const Request& request) {
    if (const auto* const color = std::get_if<Color>(&request.background))
        return fmt::format("{}", fmt::join(*color, ","));
    return std::holds_alternative<TransparentBackground>(request.background) ? "none" : "environment";
}

void setCamera(Request& request, const std::string& text) {
    if (text.empty())
        request.camera = FirstCamera{};
    else if (text == "auto")
        request.camera = FramingCamera{};
    else
        request.camera = NamedCamera{text};
}

std::optional<std::string> cameraText(const Request& request) {
    if (std::holds_alternative<FirstCamera>(request.camera)) return std::nullopt;
    const auto* const named = std::get_if<NamedCamera>(&request.camera);
    return named != nullptr ? named->name : "auto";
}

Vector3 parsePoint(const std::string& text) {
    const std::vector<double> xyz = parseNumbers(text, 3, {-farthest, farthest});
    return {xyz[0], xyz[1], xyz[2]};
}

void setSize(Request& request, const std::string& text) {
    const std::size_t cross = text.find_first_of("xX");
    if (cross == std::string::npos) fail("'{}' is not WIDTHxHEIGHT, such as 1024x768", text);
    try {
        request.size = {static_cast<int>(parseInteger(text.substr(0, cross), 1, maxImageSide)),
                        static_cast<int>(parseInteger(text.substr(cross + 1), 1, maxImageSide))};
    } catch (const Error&) {
        fail("'{}': width and height must be integers from 1 to {}, such as 1024x768", text, maxImageSide);
    }
}

std::optional<std::string> sizeText(const Request& request) {
    return fmt::format("{}x{}", request.size.width, request.size.height);
}

double parseLensValue(const LensField& field, const std::string& text) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return parseBoolean(text) ? 1 : 0;
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
        fail("'{}' is not X,Y,X,Y,X,Y: the columns and rows of {} to {} pixels", text, minFocusPoints, maxFocusPoints);
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
    if (parseBoolean(text))
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

void setMethod(Request& request, const std::string& text) {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    static_cast<void>(parseChoice(text.substr(0, text.find(':')), names));
    const MethodUse use = parseMethodUse(text);
    request.method = use.method->name;
    request.methodSettings.clear();
    for (const MethodSetting& setting : use.method->settings)
        if (const std::string& value = use.settings.at(setting.name); value != setting.defaultValue)
            request.methodSettings[setting.name] = value;
}

std::optional<std::string> methodText(const Request& request) {
    return namedMethod(request).text();
}

void clearMethod(Request& request) {
    request.method = Request{}.method;
    request.methodSettings.clear();
}

void setLayers(Request& request, const std::string& text) {
    std::vector<std::string> words = {"all"};
    for (const LayerNames& layer : allLayerNames()) words.emplace_back(layer.option);
    std::vector<bool> wanted(allLayerNames().size());
    for (const std::string& part : splitAt(text, ',')) {
        const std::size_t word = parseChoice(part, words);
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted[i] || word == 0 || word == i + 1;
    }
    request.layers.clear();
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i]) request.layers.push_back(allLayerNames()[i].layer);
}

std::optional<std::string> layersText(const Request& request) {
    if (request.layers.empty()) return {};
    std::string text;
    for (const Layer layer : request.layers) {
        if (!text.empty()) text += ',';
        text += layerNames(layer).option;
    }
    return text;
}

void setExposure(Request& request, const std::string& text) {
    if (text == "auto")
        request.exposure = MeteredExposure{};
    else
        request.exposure = ExposureValue{parseNumber(text, {-60, 60})};
}

std::optional<std::string> exposureText(const Request& request) {
    if (std::holds_alternative<MeteredExposure>(request.exposure)) return "auto";
    const auto* const value = std::get_if<ExposureValue>(&request.exposure);
    return value != nullptr ? std::optional(fmt::format("{}", value->ev)) : std::nullopt;
}

}  // namespace defocus::engine
