#pragma once
// Parses and formats values such as "320x240", "x,y", "circular:far-components=5". Only the settings table (rows*.cpp)
// uses this header. Each set… function throws Error, with the allowed values in its message, for any other text. Each
// …Text function returns nullopt if the value is unset.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "frame/request.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

void setMotionSegments(Request& request, const std::string& text);
std::optional<std::string> motionSegmentsText(const Request& request);

void setBackground(Request& request, const std::string& text);
std::optional<std::string> backgroundText(const Request& request);

void setCamera(Request& request, const std::string& text);
std::optional<std::string> cameraText(const Request& request);

Vector3 parsePoint(const std::string& text);

void setSize(Request& request, const std::string& text);
std::optional<std::string> sizeText(const Request& request);

double parseLensValue(const LensField& field, const std::string& text);
std::optional<std::string> lensText(const LensSettings& lens, const LensField& field);

void setFocusDistance(Request& request, const std::string& text);
std::optional<std::string> focusDistanceText(const Request& request);
void setFocusNode(Request& request, const std::string& text);
std::optional<std::string> focusNodeText(const Request& request);
void setFocusPixel(Request& request, const std::string& text);
std::optional<std::string> focusPixelText(const Request& request);
void setFocusPoints(Request& request, const std::string& text);
std::optional<std::string> focusPointsText(const Request& request);
void setFocusAuto(Request& request, const std::string& text);
std::optional<std::string> focusAutoText(const Request& request);

// Restores the default focus if the request's focus has the type Choice.
template <typename Choice>
void clearFocus(Request& request) {
    if (std::holds_alternative<Choice>(request.focus)) request.focus = CameraFocus{};
}

void addNodeBlur(Request& request, const std::string& text);
std::vector<std::string> nodeBlurTexts(const Request& request);
std::optional<std::string> nodeBlurText(const Request& request);

// Sets the method. Settings of the method that the text doesn't give are reset to their defaults.
void setMethod(Request& request, const std::string& text);
std::optional<std::string> methodText(const Request& request);
void clearMethod(Request& request);

// Sets the layers, in the order of the enumeration and without repetition. "all" names all layers.
void setLayers(Request& request, const std::string& text);
std::optional<std::string> layersText(const Request& request);

void setExposure(Request& request, const std::string& text);
std::optional<std::string> exposureText(const Request& request);

}  // namespace defocus::engine
