#include "frame/unused_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string_view>

#include "frame/settings.h"
#include "lod/pyramid/level_selection.h"

namespace defocus {

namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view ofSamples[] = {"samples", "sequence", "seed", "lodCoc", "cocTolerance"};
constexpr std::string_view ofTheShape[] = {"bladeCount",  "bladeRotation",       "bladeCurvature",
                                           "obstruction", "sphericalAberration", "apertureImage"};
constexpr std::string_view ofLensPoints[] = {"catEye", "axialChromaticAberration", "astigmatism", "coma"};
constexpr std::string_view ofAnOpenShutter[] = {"shutterPosition", "motionSegments"};
constexpr std::string_view ofShadows[] = {"lightAngle", "lightRadius"};
constexpr std::string_view ofTheShutter[] = {"shutter"};
constexpr std::string_view ofAMap[] = {"environmentRotation"};
constexpr std::string_view ofAnimation[] = {"time", "loop"};
constexpr std::string_view ofBlur[] = {"focusDistance",
                                       "focusNode",
                                       "focusPixel",
                                       "focusPoints",
                                       "focusAuto",
                                       "blurScale",
                                       "bladeCount",
                                       "bladeRotation",
                                       "bladeCurvature",
                                       "anamorphicRatio",
                                       "obstruction",
                                       "catEye",
                                       "apertureImage",
                                       "foregroundLimit",
                                       "backgroundLimit",
                                       "focusRangeFront",
                                       "focusRangeBehind",
                                       "focusRangeRefocuses",
                                       "focusTilt",
                                       "focusSwing",
                                       "fieldCurvature",
                                       "radialBlurGain",
                                       "nodeBlur",
                                       "sphericalAberration",
                                       "axialChromaticAberration",
                                       "astigmatism",
                                       "coma"};
constexpr std::string_view ofTheStop[] = {"fStop"};
constexpr std::string_view ofLevels[] = {"blurThreshold", "sizeThreshold", "lightThreshold",
                                         "lodMetric",     "levelVertices", "lodCoc"};
constexpr std::string_view ofLevelsBySize[] = {"lodCoc"};

class Lines {
public:
    explicit Lines(const Request& request) : request_(request) {}

    void add(Names names, const std::string& reason) {
        std::vector<std::string> given;
        for (const std::string_view name : names) {
            const Setting& setting = *settingNamed(name);
            if (changedText(setting, request_)) given.push_back(setting.option);
        }
        if (given.empty()) return;
        lines_.push_back(
            fmt::format("{} {} nothing: {}", fmt::join(given, ", "), given.size() > 1 ? "do" : "does", reason));
    }
    std::vector<std::string> taken() { return std::move(lines_); }

private:
    const Request& request_;
    std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> unusedSettings(const Request& request, const Scene& scene, const Lens& lens) {
    const Method& method = *chosenMethod(request).method;
    Lines lines(request);
    if (!method.usesLensSamples) lines.add(ofSamples, fmt::format("the method {} draws no lens samples", method.name));
    if (method.aperture == ApertureShown::oval)
        lines.add(ofTheShape, fmt::format("the method {} has a round or oval aperture", method.name));
    if (method.aperture != ApertureShown::all)
        lines.add(ofLensPoints,
                  fmt::format("the method {} has one lens for all colours and all places of the image", method.name));
    if (request.settings.shadows == Shadows::off || (request.settings.shadows == Shadows::automatic && !request.ground))
        lines.add(ofShadows, "without shadows (--shadows on, --ground) the size of a light shows nowhere");
    if (!method.drawsMotion) lines.add(ofTheShutter, fmt::format("the method {} draws no motion", method.name));
    if (request.shutter.seconds == 0) lines.add(ofAnOpenShutter, "without --shutter it is open for a moment");
    if (request.environment.empty())
        lines.add(ofAMap, "without --environment the surroundings are the same all around");
    if (scene.clips.empty()) lines.add(ofAnimation, "the scene has no animation");
    if (!lens.dofEnabled) {
        lines.add(ofBlur, "with --no-dof nothing is blurred");
        if (lens.exposureTime == 0) lines.add(ofTheStop, "with --no-dof nothing is blurred");
    }
    if (request.settings.lod == LodMode::off)
        lines.add(ofLevels, "with --lod off there is full detail alone");
    else if (method.usesLensSamples &&
             chosenMetric(request.settings.metric, request.settings.thresholds) == LodMetric::measured)
        lines.add(ofLevelsBySize, "measured levels take the blur over the whole object");
    return lines.taken();
}

}  // namespace defocus
