// Defines the settings of the scene and the camera.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/parse.h"
#include "frame/settings/conditions.h"
#include "frame/settings/rows.h"
#include "scene/units.h"

namespace defocus::engine {

namespace {

// Each set… function parses the text of a value. If the text is invalid, it throws Error with the allowed values in its
// message. Each …Text function returns nullopt if the value is unset.

constexpr std::uint64_t maxSegments = 64;
constexpr double farthest = 1e12;  // largest coordinate, m

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

Row unitsRow() {
    return Row(SettingKind::number, "units", "--units", "m|cm|mm|METRES|auto",
               "Length of one unit of the scene: m, cm, mm or a number of metres. auto: the unit stored in the file's "
               "extras, if any. Otherwise 1 m if the camera has a focal length or focus distance, or if an option sets "
               "the focus distance, the sharp range or the camera (--camera-from, position or target). Otherwise an "
               "estimate from the scene's size")
        .range(1e-9, 1e9)
        .choices({"auto", "m", "cm", "mm"})
        .clears(MEMBER(units))
        .values(
            [](Request& request, const std::string& text) {
                request.units = text == "auto" ? std::nullopt : std::optional(metresOfUnit(text));
            },
            [](const Request& request) -> std::optional<std::string> {
                return request.units ? unitOfMetres(*request.units) : "auto";
            });
}

Row shutterRow() {
    return rows::other(
               "shutter", "--shutter", "S",
               [](Request& request, const std::string& text) { request.shutter = parseSeconds(text); },
               [](const Request& request) -> std::optional<std::string> {
                   return request.shutter ? std::optional(fmt::format("{}", *request.shutter)) : std::nullopt;
               },
               "Time in seconds that the shutter is open, such as 0.02 or 1/48; gives motion blur. 0: no motion blur. "
               "Default: the shutter of --camera-from, else 0")
        .kind(SettingKind::number)
        .range(0, 1e6)
        .clears(MEMBER(shutter));
}

Row hideRow() {
    return rows::other(
               "hide", "--hide", "NODE",
               [](Request& request, const std::string& text) {
                   if (std::ranges::find(request.hide, text) == request.hide.end()) request.hide.push_back(text);
               },
               [](const Request& request) -> std::optional<std::string> {
                   if (request.hide.empty()) return std::nullopt;
                   return fmt::format("{}", fmt::join(request.hide, ","));
               },
               "Hide a node, given by name or number, and its children. Can be given several times")
        .clears(MEMBER(hide))
        .repeats([](const Request& request) { return request.hide; });
}

// Refuses an empty path, which may come from an unset variable of a script.
void setScene(Request& request, const std::string& text) {
    if (text.empty()) fail("the path is empty; leave it out to render the built-in school of fish");
    request.scene = text;
}

std::optional<std::string> sceneText(const Request& request) {
    if (request.scene.empty()) return std::nullopt;
    return request.scene.string();
}

template <typename Member>
Row pointRow(std::string name, std::string option, Member member, std::string help) {
    return rows::other(
               std::move(name), std::move(option), "X,Y,Z",
               [=](Request& request, const std::string& text) { member(request) = parsePoint(text); },
               [=](const Request& request) -> std::optional<std::string> {
                   if (!member(request)) return std::nullopt;
                   return fmt::format("{}", fmt::join(*member(request), ","));
               },
               std::move(help))
        .clears(member);
}

}  // namespace

Rows sceneRows() {
    return {
        rows::words(SettingKind::path, "scene", "SCENE", "FILE", MEMBER(scene),
                    "glTF file (.gltf, .glb). Default: the built-in school of fish")
            .values(setScene, sceneText)
            .everyday()
            .example("scene.glb")
            .inShot("/scene"),
        rows::boolean("strict", "--strict", MEMBER(strict),
                      "Refuse a scene with missing or damaged parts, such as textures, instead of drawing the rest")
            .effect(SettingEffect::run),
        rows::words(SettingKind::text, "variant", "--variant", "NAME", MEMBER(variant),
                    "Variant of the scene's materials (KHR_materials_variants), as listed by 'defocus info'. Default: "
                    "the file's default materials")
            .example("Red")
            .inShot("/variant")
            .unused(withoutVariant),
        rows::integer("fishCount", "--fish", 1, 10'000, MEMBER(fishCount), "Number of fish in the built-in school")
            .excludes({"scene"})
            .inShot("/fish/count"),
        rows::integer("trianglesPerFish", "--fish-triangles", 200, 10'000'000, MEMBER(trianglesPerFish),
                      "Approximate number of triangles of each fish in the built-in school")
            .excludes({"scene"})
            .inShot("/fish/triangles"),
        unitsRow().inShot("/units"),
        rows::number("time", "--time", "S", -1e9, 1e9, MEMBER(time),
                     "Time in the animation in seconds. Outside the animation's time range, its first or last frame "
                     "is held, unless --loop is given")
            .unit("s")
            .inShot("/animation/start")
            .unused(withoutAnimation),
        rows::words(SettingKind::text, "clip", "--clip", "NAME|N", MEMBER(clip),
                    "Animation to play, given by its name or number in 'defocus info'. Default: the first animation")
            .example("Walk")
            .inShot("/animation/clip")
            .json(R"({"anyOf": [{"type": "integer", "minimum": 0, "maximum": 1000000},
                                {"type": "string", "minLength": 1}]})"),
        rows::boolean("loop", "--loop", MEMBER(loop), "Loop the animation instead of holding its first and last frame")
            .inShot("/animation/loop")
            .unused(withoutAnimation),
        shutterRow().unit("s").example("0.02").inShot("/shutter/seconds").unused(methodWithoutMotion),
        rows::choice<ShutterPosition>(
            "shutterPosition", "--shutter-position",
            {{"start", ShutterPosition::start}, {"centre", ShutterPosition::centre}, {"end", ShutterPosition::end}},
            MEMBER(shutterPosition),
            "What happens at --time: the shutter opens (start), the exposure is half over (centre), or the shutter "
            "closes (end)")
            .inShot("/shutter/position")
            .unused(withoutShutter),
        rows::other("motionSegments", "--motion-segments", "N|exact", setMotionSegments, motionSegmentsText,
                    "Number of straight segments, 1 to 64, that approximate the motion while the shutter is open; fast "
                    "rotations need more. exact: the true motion, slower")
            .clears(MEMBER(motionSegments))
            .inShot("/shutter/segments")
            .json(R"({"type": "integer", "minimum": 1, "maximum": 64})")
            .unused(withoutShutter),
        rows::words(SettingKind::path, "environment", "--environment", "studio|overcast|sunset|FILE",
                    MEMBER(environment),
                    "Environment map: studio, overcast, sunset, or an equirectangular .hdr or .exr file. Replaces the "
                    "default lights, but keeps the lights of the glTF file. Default: the environment of the glTF "
                    "file, else a soft sky")
            .everyday()
            .example("studio")
            .inShot("/environment"),
        rows::number("environmentRotation", "--environment-rotation", "DEG", -360, 360, MEMBER(environmentRotation),
                     "Rotation of the environment map in degrees, counter-clockwise seen from above")
            .unit("degrees")
            .inShot("/environmentRotation")
            .unused(withoutEnvironment),
        rows::other("background", "--background", "environment|none|R,G,B", setBackground, backgroundText,
                    "Background: the environment, none for a transparent image, or a linear colour R,G,B that also "
                    "lights the scene")
            .clears(MEMBER(background))
            .inShot("/background")
            .json(R"({"anyOf": [{"enum": ["environment", "none"]},
                                {"type": "array", "minItems": 3, "maxItems": 3,
                                 "items": {"type": "number", "minimum": 0, "maximum": 1000000000}}]})",
                  ','),
        rows::boolean("ground", "--ground", MEMBER(ground),
                      "Add a grey ground that receives shadows, at the height of the scene's lowest point")
            .inShot("/ground"),
        hideRow(),
        rows::choice<Shadows>("shadows", "--shadows",
                              {{"auto", Shadows::automatic}, {"on", Shadows::on}, {"off", Shadows::off}},
                              MEMBER(shadows),
                              "Draw the soft shadows that the lights and the environment cause. auto: only with "
                              "--ground")
            .inShot("/shadows"),
        rows::boolean("multipleScattering", "--multiple-scattering", MEMBER(multipleScattering),
                      "Restore the light that rough surfaces lose in glTF's material model: rough metals become "
                      "brighter and more saturated")
            .inShot("/multipleScattering"),
        rows::number("lightAngle", "--light-angle", "DEG", 0, 90, MEMBER(lightAngle),
                     "Angular diameter of directional lights in degrees; larger lights give softer shadows. Default: "
                     "0.53 (the sun) for lights in the file, 10 to 30 for the default lights")
            .unit("degrees")
            .example("5")
            .inShot("/lightAngle")
            .unused(withoutShadows),
        rows::number("lightRadius", "--light-radius", "M", 0, 1e6, MEMBER(lightRadius),
                     "Radius of point and spot lights in m; larger lights give softer shadows. Has no effect on the "
                     "default lights, which are directional. Default: 0.03")
            .unit("m")
            .example("0.1")
            .inShot("/lightRadius")
            .unused(withoutShadows),
    };
}

Rows cameraRows() {
    return {
        rows::other("camera", "--camera", "NAME", setCamera, cameraText,
                    "Name of a camera in the file, or 'auto' for a camera that frames the scene. Default: the file's "
                    "first camera, else 'auto'")
            .clears(MEMBER(camera))
            .everyday()
            .example("Camera")
            .inShot("/camera/name"),
        rows::words(
            SettingKind::path, "cameraFrom", "--camera-from", "FILE[:CAMERA]", MEMBER(cameraFrom),
            "Camera from another file, with its lens, animation and shutter: a USD text file (.usda), a glTF file, or "
            "the JSON of 'defocus export-camera'. CAMERA is the camera's name or path, such as /World/cam; leave it "
            "out if the file has only one camera")
            .excludes({"camera"})
            .example("shot.usda:/World/cam"),
        pointRow(
            "cameraPosition", "--camera-position", MEMBER(cameraPosition),
            "Position of the camera in m. Does not move the default lights, which are placed relative to the file's "
            "camera. Default: the position of the file's camera")
            .unit("m"),
        pointRow("cameraTarget", "--camera-target", MEMBER(cameraTarget),
                 "Point in m that the camera looks at. Without it, the camera keeps the viewing direction of the "
                 "file's camera")
            .unit("m"),
        pointRow("cameraUp", "--camera-up", MEMBER(cameraUp),
                 "Direction that points up in the image. Default: 0,1,0 with --camera-target, else the camera's own"),
        rows::other("size", "--size", "WxH", setSize, sizeText, "Image size in pixels")
            .clears(MEMBER(size))
            .unit("px")
            .everyday()
            .inShot("/size")
            .json(fmt::format(R"({{"type": "array", "minItems": 2, "maxItems": 2,
                                   "items": {{"type": "integer", "minimum": 1, "maximum": {}}}}})",
                              maxImageSide),
                  'x'),
    };
}

}  // namespace defocus::engine
