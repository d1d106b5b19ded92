#include "cli/commands/camera_report.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/parse.h"
#include "frame/report/json_values.h"
#include "lens/circle_of_confusion.h"
#include "lens/depth_of_field.h"
#include "lens/photographic_exposure.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Circle of confusion of the points at one depth.
struct Blur {
    double depth = 0;      // m
    double pixels = 0;     // signed diameter in px; > 0 behind the focus plane
    double onSensor = 0;   // diameter on the sensor, mm; signed like `pixels`
    bool inFocus = false;  // true: the diameter on the sensor is at most CameraFacts::acceptable
};

// All values that the report prints.
struct CameraFacts {
    Lens lens;
    glm::dvec2 sensor{0};       // mm
    glm::dvec2 fieldOfView{0};  // degrees
    double acceptable = 0;      // acceptable circle of confusion, mm
    bool customary = false;     // true: `acceptable` is the usual default, the sensor diagonal / 1500
    DepthOfField depth;
    bool plain = true;  // true: near and far limits of focus are exact (a thin lens without artistic controls)
    std::vector<Blur> blurs;
};

std::vector<double> depthsAround(const Lens& lens) {
    if (std::isinf(lens.focusDistance)) return {0.5, 1, 2, 5, 10, 20, 50, 100, infinity};
    std::vector<double> depths;
    for (const double factor : {0.25, 0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0, 10.0})
        depths.push_back(factor * lens.focusDistance);
    depths.push_back(infinity);
    return depths;
}

CameraFacts factsOf(const PreparedFrame& frame, const CameraQuestion& question) {
    const View& view = frame.view;
    CameraFacts facts;
    facts.lens = view.lens;
    facts.sensor = sensorSize(view.lens, view.width, view.height);
    const double tanX = tanHalfHorizontalFov(view.lens);
    facts.fieldOfView = glm::degrees(2.0 * glm::dvec2(std::atan(tanX), std::atan(tanX * view.height / view.width)));
    facts.customary = !question.acceptableCoc;
    facts.acceptable = question.acceptableCoc.value_or(customaryCircleOfConfusion(view.lens, view.width, view.height));
    facts.depth = depthOfField(view.lens, facts.acceptable);
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(view.lens, view.width, view.height);
    facts.plain = coc.thinLens();
    for (const double depth : question.depths.empty() ? depthsAround(view.lens) : question.depths) {
        const double pixels = circleOfConfusion(coc, depth, view.width);
        const double onSensor = pixels * facts.sensor.x / view.width;
        facts.blurs.push_back({depth, pixels, onSensor, std::abs(onSensor) <= facts.acceptable * (1 + 1e-9)});
    }
    return facts;
}

std::string inMetres(double distance) {
    return std::isinf(distance) ? "infinity" : fmt::format("{:.4g} m", distance);
}

// Returns the depth of field behind the focus distance, m; 0 for focus at infinity.
double behindFocus(const CameraFacts& facts) {
    return std::isinf(facts.lens.focusDistance) ? 0 : facts.depth.far - facts.lens.focusDistance;
}

// Returns a string such as "1/125 s" or "2.5 s".
std::string shutterText(double seconds) {
    return seconds < 0.4 ? fmt::format("1/{:.4g} s", 1 / seconds) : fmt::format("{:.3g} s", seconds);
}

const char* const plainLensNote =
    "The depth of field is computed without sharp range, tilt, field curvature and blur limits; the blur at each depth "
    "includes them";

}  // namespace

std::vector<double> parseDepths(const std::string& text) {
    std::vector<double> depths;
    for (const std::string& part : splitAt(text, ','))
        depths.push_back(part == "inf" ? infinity : parseNumber(part, {0, 1e12, true}));
    return depths;
}

std::string cameraTable(const PreparedFrame& frame, const CameraQuestion& question) {
    const CameraFacts facts = factsOf(frame, question);
    const Lens& lens = facts.lens;
    std::string text;
    const auto line = [&](const char* label, const std::string& value) {
        text += fmt::format("{:<18}{}\n", label, value);
    };
    line("camera", fmt::format("{} of {}", frame.cameraName, frame.sceneName));
    line("lens", fmt::format("{:.4g} mm, f/{:.3g}{}", lens.focalLength, lens.fStop,
                             apertureDiameter(lens) > 0 ? "" : ", depth of field off"));
    line("sensor", fmt::format("{:.4g} x {:.4g} mm (aspect ratio of the {}x{} image)", facts.sensor.x, facts.sensor.y,
                               frame.view.width, frame.view.height));
    line("field of view", fmt::format("{:.4g} x {:.4g} degrees", facts.fieldOfView.x, facts.fieldOfView.y));
    line("focus",
         fmt::format("{}{}", inMetres(lens.focusDistance), lens.focusBreathing ? ", with focus breathing" : ""));
    line("acceptable blur",
         fmt::format("{:.3g} mm on the sensor{}", facts.acceptable, facts.customary ? ", 1/1500 of its diagonal" : ""));
    line("in focus", fmt::format("{} to {}", inMetres(facts.depth.near), inMetres(facts.depth.far)));
    line("depth of field",
         fmt::format("{}: {} in front of the focus plane, {} behind it", inMetres(facts.depth.far - facts.depth.near),
                     inMetres(lens.focusDistance - facts.depth.near), inMetres(behindFocus(facts))));
    line("hyperfocal", inMetres(facts.depth.hyperfocal));
    if (lens.exposureTime > 0)
        line("exposure",
             fmt::format("{} at ISO {:.4g}: EV100 {:.2f}, which corresponds to --exposure {:.2f}",
                         shutterText(lens.exposureTime), lens.iso, exposureValue100(lens), photographicExposure(lens)));
    if (!facts.plain) text += fmt::format("{}.\n", plainLensNote);
    text += fmt::format("\n{:>12} {:>12} {:>14}\n", "depth", "blur, px", "on sensor, mm");
    for (const Blur& blur : facts.blurs)
        text += fmt::format("{:>12} {:>12.2f} {:>14.4f}{}\n", inMetres(blur.depth), blur.pixels, blur.onSensor,
                            blur.inFocus ? "  in focus" : "");
    text += "\nBlur in the middle of the image; negative in front of the focus plane.\n";
    return text;
}

std::string cameraJson(const PreparedFrame& frame, const CameraQuestion& question) {
    const CameraFacts facts = factsOf(frame, question);
    const Lens& lens = facts.lens;
    Json json = {{"camera", frame.cameraName},
                 {"scene", frame.sceneName},
                 {"width", frame.view.width},
                 {"height", frame.view.height},
                 {"focalLength", lens.focalLength},
                 {"fStop", lens.fStop},
                 {"apertureDiameter", apertureDiameter(lens)},
                 {"focusDistance", jsonNumber(lens.focusDistance)},
                 {"focusBreathing", lens.focusBreathing},
                 {"sensorSize", {facts.sensor.x, facts.sensor.y}},
                 {"horizontalFieldOfView", facts.fieldOfView.x},
                 {"verticalFieldOfView", facts.fieldOfView.y},
                 {"acceptableCoc", facts.acceptable},
                 {"near", facts.depth.near},
                 {"far", jsonNumber(facts.depth.far)},
                 {"depthOfField", jsonNumber(facts.depth.far - facts.depth.near)},
                 {"inFrontOfFocus", jsonNumber(lens.focusDistance - facts.depth.near)},
                 {"behindFocus", jsonNumber(behindFocus(facts))},
                 {"hyperfocal", facts.depth.hyperfocal},
                 {"plainLens", facts.plain}};
    if (!facts.plain) json["note"] = plainLensNote;
    if (lens.exposureTime > 0)
        json["exposure"] = {{"exposureTime", lens.exposureTime},
                            {"iso", lens.iso},
                            {"ev100", exposureValue100(lens)},
                            {"exposure", photographicExposure(lens)}};
    json["blur"] = Json::array();
    for (const Blur& blur : facts.blurs)
        json["blur"].push_back({{"depth", jsonNumber(blur.depth)},
                                {"pixels", blur.pixels},
                                {"millimetres", blur.onSensor},
                                {"inFocus", blur.inFocus}});
    return documentText(json);
}

}  // namespace defocus::engine
