// The rows of the table of settings, in the order in which --help shows them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/memory_limits.h"
#include "frame/presets.h"
#include "frame/setting_kinds.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/level_selection.h"
#include "scene/units.h"

namespace defocus {

namespace {

using namespace setting_kinds;

// What a member of Request is called in the rows below.
#define MEMBER(path)             \
    [](auto& request) -> auto& { \
        return request.path;     \
    }

// ---- values with a form of their own ------------------------------------------------------------------------------

void setShutter(Request& request, const std::string& text) {
    request.shutter.seconds = parseSeconds(text);
}

void setSegments(Request& request, const std::string& text) {
    constexpr std::uint64_t mostSegments = 64;
    request.shutter.exactMotion = text == "exact";
    if (!request.shutter.exactMotion)
        request.shutter.motionSegments = static_cast<std::uint32_t>(parseWhole(text, 1, mostSegments));
}

std::optional<std::string> segmentsText(const Request& request) {
    return request.shutter.exactMotion ? "exact" : fmt::format("{}", request.shutter.motionSegments);
}

void setBackground(Request& request, const std::string& text) {
    if (text.find(',') != std::string::npos) {
        const std::vector<double> color = parseNumbers(text, 3, {0, 1e9});
        request.background = Background::uniform;
        for (std::size_t i = 0; i < 3; ++i) request.backgroundColor[i] = static_cast<float>(color[i]);
        return;
    }
    const std::size_t chosen = parseChoice(text, {"environment", "none", "R,G,B"});
    if (chosen > 1) fail("give three numbers for R,G,B, such as 0.2,0.2,0.2");
    request.background = chosen == 0 ? Background::environment : Background::none;
}

std::optional<std::string> backgroundText(const Request& request) {
    if (request.background == Background::uniform) return fmt::format("{}", fmt::join(request.backgroundColor, ","));
    return request.background == Background::none ? "none" : "environment";
}

template <typename Member>
Setting point(std::string name, std::string option, Member member, std::string help) {
    return other(
        std::move(name), std::move(option), "X,Y,Z",
        [=](Request& request, const std::string& text) {
            const std::vector<double> xyz = parseNumbers(text, 3, {-1e12, 1e12});
            member(request) = Vector3{xyz[0], xyz[1], xyz[2]};
        },
        [=](const Request& request) -> std::optional<std::string> {
            if (!member(request)) return std::nullopt;
            return fmt::format("{}", fmt::join(*member(request), ","));
        },
        std::move(help));
}

void setSize(Request& request, const std::string& text) {
    const std::size_t cross = text.find_first_of("xX");
    if (cross == std::string::npos) fail("'{}' is not WIDTHxHEIGHT, such as 1024x768", text);
    try {
        request.width = static_cast<int>(parseWhole(text.substr(0, cross), 1, mostPixels));
        request.height = static_cast<int>(parseWhole(text.substr(cross + 1), 1, mostPixels));
    } catch (const Error&) {
        fail("'{}': width and height must be whole numbers from 1 to {}, such as 1024x768", text, mostPixels);
    }
}

void setFocusPixel(Request& request, const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) fail("'{}' is not X,Y (column and row, 0,0 at the top left)", text);
    request.focusPixel = Pixel{static_cast<int>(parseWhole(text.substr(0, comma), 0, mostPixels - 1)),
                               static_cast<int>(parseWhole(text.substr(comma + 1), 0, mostPixels - 1))};
}

std::optional<std::string> focusPixelText(const Request& request) {
    if (!request.focusPixel) return std::nullopt;
    return fmt::format("{},{}", request.focusPixel->column, request.focusPixel->row);
}

constexpr std::size_t mostFocusPoints = 16;

void setFocusPoints(Request& request, const std::string& text) {
    const auto count = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
    if (count < 6 || count % 2 != 0 || count > 2 * mostFocusPoints)
        fail("'{}' is not X,Y,X,Y,X,Y: columns and rows of 3 to {} pixels", text, mostFocusPoints);
    const std::vector<double> numbers = parseNumbers(text, count, {0, mostPixels - 1});
    request.focusPoints.clear();
    for (std::size_t i = 0; i < count; i += 2)
        request.focusPoints.push_back({static_cast<int>(numbers[i]), static_cast<int>(numbers[i + 1])});
}

std::optional<std::string> focusPointsText(const Request& request) {
    if (request.focusPoints.empty()) return std::nullopt;
    std::vector<int> numbers;
    for (const Pixel& point : request.focusPoints) numbers.insert(numbers.end(), {point.column, point.row});
    return fmt::format("{}", fmt::join(numbers, ","));
}

// A name may hold an equals sign.
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

void setMethod(Request& request, const std::string& text) {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    static_cast<void>(parseChoice(text.substr(0, text.find(':')), names));
    request.method = parseMethodUse(text).text();
}

std::optional<std::string> samplesText(const Request& request) {
    const std::uint32_t count = request.settings.sampleCount;
    return count == automaticSamples ? "auto" : fmt::format("{}", count);
}

// A number of samples that is given is also the most that a target error or a time limit may take.
void setSamples(Request& request, const std::string& text) {
    const bool automatic = text == "auto";
    request.settings.sampleCount =
        automatic ? automaticSamples : static_cast<std::uint32_t>(parseWhole(text, 1, mostSamples));
    request.stop.sampleLimit = automatic ? StopSettings{}.sampleLimit : request.settings.sampleCount;
}

// ---- the lens -------------------------------------------------------------------------------------------------------

std::string unitOf(std::string_view metavar) {
    if (metavar == "MM") return "mm";
    if (metavar == "M") return "m";
    if (metavar == "DEG") return "degrees";
    if (metavar == "PX") return "px";
    if (metavar == "D") return "dioptres";
    if (metavar == "S") return "s";
    return "";
}

double parseLensValue(const LensField& field, const std::string& text) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return parseTruth(text) ? 1 : 0;
    if (std::holds_alternative<int Lens::*>(field.member))
        return static_cast<double>(
            parseWhole(text, static_cast<std::uint64_t>(field.least), static_cast<std::uint64_t>(field.most)));
    if (std::string_view(field.unit) == "S") return parseSeconds(text);
    return parseNumber(text, {field.least, field.most});
}

Setting lensSetting(const LensField& field) {
    const SettingKind kind = std::holds_alternative<bool Lens::*>(field.member)  ? SettingKind::truth
                             : std::holds_alternative<int Lens::*>(field.member) ? SettingKind::whole
                                                                                 : SettingKind::number;
    Setting setting = row(kind, field.name, field.option, field.unit, field.description);
    setting.unit = unitOf(field.unit);
    setting.least = field.least;
    setting.most = field.most;
    setting.shotPlace = fmt::format("/lens/{}", field.name);
    setting.keyed = true;
    setting.lensField = true;
    setting.clear = [&field](Request& request) { giveLensValue(request.lens, field, std::nullopt); };
    setting.set = [&field](Request& request, const std::string& text) {
        giveLensValue(request.lens, field, parseLensValue(field, text));
    };
    setting.text = [&field, kind](const Request& request) -> std::optional<std::string> {
        const std::optional<double> value = givenLensValue(request.lens, field);
        if (!value) return std::nullopt;
        if (kind == SettingKind::truth) return *value != 0 ? "true" : "false";
        return fmt::format("{}", std::min(*value, field.most));
    };
    return setting;
}

// ---- the rows -------------------------------------------------------------------------------------------------------

using Rows = std::vector<Setting>;

// A value in seconds, which may be told as a fraction.
Setting seconds(Setting setting) {
    setting.kind = SettingKind::number;
    setting.unit = std::string("s");
    setting.least = 0;
    setting.most = 1e6;
    return setting;
}

Setting inShot(Setting setting, std::string place) {
    setting.shotPlace = std::move(place);
    return setting;
}

Setting withUnit(Setting setting, std::string unit) {
    setting.unit = std::move(unit);
    return setting;
}

void add(Rows& rows, SettingGroup group, Rows more) {
    for (Setting& setting : more) {
        setting.group = group;
        rows.push_back(std::move(setting));
    }
}

Setting unitsSetting() {
    Setting setting =
        row(SettingKind::number, "units", "--units", "m|cm|mm|M|auto",
            "What a length of 1 in the scene is: m, cm, mm or a number of metres; the blur depends on it. "
            "auto: what the file says (extras); metres where the camera or an option gives a length; "
            "else what makes a thing of everyday size of what the image frames");
    setting.least = 1e-9;
    setting.most = 1e9;
    setting.choices = {"auto", "m", "cm", "mm"};
    setting.set = [](Request& request, const std::string& text) {
        request.metresPerUnit = text == "auto" ? std::nullopt : std::optional(metresOfUnit(text));
    };
    setting.text = [](const Request& request) -> std::optional<std::string> {
        return request.metresPerUnit ? unitOfMetres(*request.metresPerUnit) : "auto";
    };
    setting.clear = [](Request& request) { request.metresPerUnit.reset(); };
    return setting;
}

Setting hideSetting() {
    Setting setting = other(
        "hide", "--hide", "NODE",
        [](Request& request, const std::string& text) {
            if (std::ranges::find(request.hidden, text) == request.hidden.end()) request.hidden.push_back(text);
        },
        [](const Request& request) -> std::optional<std::string> {
            return request.hidden.empty() ? std::nullopt
                                          : std::optional(fmt::format("{}", fmt::join(request.hidden, ",")));
        },
        "Leave out the meshes of a node and of all below it, by its name, or its number where it has no name of its "
        "own. Can be given several times");
    setting.repeated = true;
    setting.texts = [](const Request& request) { return request.hidden; };
    setting.clear = [](Request& request) { request.hidden.clear(); };
    return setting;
}

Rows sceneRows() {
    return {
        inShot(path("scene", "SCENE", "FILE", MEMBER(scene),
                    "glTF file (.gltf, .glb); without one, the built-in school of fish"),
               "/scene"),
        inShot(whole("fishCount", "--fish", 1, 10'000, MEMBER(fishCount), "Number of fish in the built-in school"),
               "/fish/count"),
        inShot(whole("trianglesPerFish", "--fish-triangles", 200, 10'000'000, MEMBER(trianglesPerFish),
                     "Triangles a fish, about"),
               "/fish/triangles"),
        inShot(unitsSetting(), "/units"),
        withUnit(inShot(number("time", "--time", "S", -1e9, 1e9, MEMBER(time),
                               "Seconds into the animation; before and after it, its ends"),
                        "/animation/start"),
                 "s"),
        inShot(text("clip", "--clip", "NAME|N", MEMBER(clip),
                    "Which of the file's animations plays: its name or number (see 'defocus info'); without it, the "
                    "first"),
               "/animation/clip"),
        inShot(truth("loop", "--loop", MEMBER(loop), "Repeat the animation instead of holding its ends"),
               "/animation/loop"),
        inShot(seconds(other(
                   "shutter", "--shutter", "S", setShutter,
                   [](const Request& request) -> std::optional<std::string> {
                       return fmt::format("{}", request.shutter.seconds);
                   },
                   "Seconds that the shutter stays open, as 0.02 or 1/48 (half of a frame of 24 a second): what the "
                   "animation moves meanwhile is blurred; without it, one moment")),
               "/shutter/seconds"),
        inShot(
            choice<ShutterPosition>(
                "shutterPosition", "--shutter-position",
                {{"start", ShutterPosition::start}, {"centre", ShutterPosition::centre}, {"end", ShutterPosition::end}},
                MEMBER(shutter.position), "Where --time lies in the exposure"),
            "/shutter/position"),
        inShot(other("motionSegments", "--motion-segments", "N|exact", setSegments, segmentsText,
                     "Straight lines that a vertex's way is cut into while the shutter is open (1 to 64), or 'exact' "
                     "for a pose of its own for each sample"),
               "/shutter/segments"),
        inShot(path("environment", "--environment", "studio|overcast|sunset|FILE", MEMBER(environment),
                    "What lies behind the scene and lights it alone, beside the scene's own lights: one of those built "
                    "in, or "
                    "an equirectangular image (.hdr or .exr)"),
               "/environment"),
        withUnit(inShot(number("environmentRotation", "--environment-rotation", "DEG", -360, 360,
                               MEMBER(environmentRotation), "Turns it counter-clockwise, seen from above"),
                        "/environmentRotation"),
                 "degrees"),
        inShot(
            other("background", "--background", "environment|none|R,G,B", setBackground, backgroundText,
                  "'environment' (the default), 'none' for a transparent image, or R,G,B (linear) for one colour all "
                  "around"),
            "/background"),
        inShot(truth("ground", "--ground", MEMBER(ground),
                     "Put a grey ground beneath the scene, at its lowest point, which catches its shadows"),
               "/ground"),
        hideSetting(),
        inShot(choice<Shadows>("shadows", "--shadows",
                               {{"auto", Shadows::automatic}, {"on", Shadows::on}, {"off", Shadows::off}},
                               MEMBER(settings.shadows),
                               "Soft shadows of lights and surroundings, from a point of each in every lens sample; "
                               "auto: with --ground"),
               "/shadows"),
        withUnit(
            inShot(number("lightAngle", "--light-angle", "DEG", 0, 90, MEMBER(lightAngle),
                          "What a directional light measures across, which makes its shadows soft; without it, 0.53 "
                          "as the sun"),
                   "/lightAngle"),
            "degrees"),
        withUnit(inShot(number("lightRadius", "--light-radius", "M", 0, 1e6, MEMBER(lightRadius),
                               "Radius of point and spot lights, for their shadows; without it, 0.03"),
                        "/lightRadius"),
                 "m"),
    };
}

Rows cameraRows() {
    return {
        inShot(text("camera", "--camera", "NAME", MEMBER(camera),
                    "Name of a camera of the file, or 'auto' for one that frames the scene; without it, the first"),
               "/camera/name"),
        withUnit(point("cameraPosition", "--camera-position", MEMBER(cameraPosition),
                       "Moves the camera there (m); lights stay as for the camera"),
                 "m"),
        withUnit(point("cameraTarget", "--camera-target", MEMBER(cameraTarget),
                       "Turns the camera towards this point, upright"),
                 "m"),
        point("cameraUp", "--camera-up", MEMBER(cameraUp), "What is up in the image, as a direction"),
        withUnit(inShot(other(
                            "size", "--size", "WxH", setSize,
                            [](const Request& request) -> std::optional<std::string> {
                                return fmt::format("{}x{}", request.width, request.height);
                            },
                            "Image size in pixels"),
                        "/size"),
                 "px"),
    };
}

Rows focusRows() {
    return {
        text("focusNode", "--focus-node", "NAME", MEMBER(focusNode),
             "Focus on the centre of this node (its mesh's box, or its origin)"),
        other("focusPixel", "--focus-pixel", "X,Y", setFocusPixel, focusPixelText,
              "Focus on the surface seen at this pixel (0,0 is the top left one)"),
        other("focusPoints", "--focus-points", "X,Y,X,Y,X,Y", setFocusPoints, focusPointsText,
              "Tilt the focus plane so that it goes through what three pixels show. Of four to 16 pixels, bend it too, "
              "so that their blurs are as small as can be"),
        truth("focusAuto", "--focus-auto", MEMBER(focusAuto),
              "Focus on the median depth of what the image's middle shows"),
    };
}

Rows lensRows() {
    Rows rows;
    for (const LensField& field : lensFields()) {
        rows.push_back(lensSetting(field));
        if (rows.back().name == "focusDistance") std::ranges::move(focusRows(), std::back_inserter(rows));
    }
    rows.push_back(path("apertureImage", "--aperture-image", "FILE", MEMBER(lens.apertureImage),
                        "Image of the aperture, in place of blades and rings: light passes where it is bright; its "
                        "longer side spans the lens"));
    Setting nodeBlur = other(
        "nodeBlur", "--node-blur", "NAME=SCALE", addNodeBlur,
        [](const Request& request) -> std::optional<std::string> {
            return request.nodeBlur.empty() ? std::nullopt
                                            : std::optional(fmt::format("{}", fmt::join(nodeBlurTexts(request), ",")));
        },
        "Scale the blur of a node and all below it; 0 keeps it sharp. Can be given several times");
    nodeBlur.repeated = true;
    nodeBlur.texts = nodeBlurTexts;
    rows.push_back(std::move(nodeBlur));
    return rows;
}

// It has no value of its own: see presets.h. Before all that it sets, so that an option beside it wins wherever it
// stands.
Setting presetSetting() {
    std::vector<std::string> names;
    std::vector<std::string> lines;
    for (const Preset& preset : presets()) {
        names.push_back(preset.name);
        lines.push_back(fmt::format("{}: {}", preset.name, preset.description));
    }
    Setting setting =
        row(SettingKind::choice, "preset", "--preset", fmt::format("{}", fmt::join(names, "|")),
            fmt::format("Settings that belong together; what is given beside it wins. {}", fmt::join(lines, "; ")));
    setting.choices = names;
    setting.set = [names](Request& request, const std::string& text) {
        applyPreset(presets()[parseChoice(text, names)], request);
    };
    setting.text = [](const Request& request) {
        const Preset* const preset = presetOf(request);
        return preset == nullptr ? std::nullopt : std::optional(preset->name);
    };
    setting.clear = [](Request& request) {
        if (const Preset* const preset = presetOf(request)) clearPreset(*preset, request);
    };
    return setting;
}

Rows sampleRows() {
    std::vector<std::pair<std::string, Sequence>> sequences;
    for (const Sequence sequence : allSequences) sequences.emplace_back(sequenceName(sequence), sequence);
    std::vector<std::pair<std::string, LodMode>> modes;
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous, LodMode::nearest, LodMode::off})
        modes.emplace_back(lodModeName(mode), mode);
    Setting samples =
        inShot(whole("samples", "--samples", 1, mostSamples, MEMBER(settings.sampleCount),
                     fmt::format("Lens samples; auto: 32 to 1024, by the largest blur, and where that is wide by the "
                                 "picture's estimated error. With --target-error or --time-limit the most, else {}",
                                 mostSamples)),
               "/samples");
    samples.metavar = "N|auto";
    samples.choices = {"auto"};
    samples.set = setSamples;
    samples.text = samplesText;
    samples.clear = [](Request& request) { setSamples(request, "auto"); };
    return {
        inShot(presetSetting(), "/preset"),
        samples,
        inShot(
            number("targetError", "--target-error", "R", 1e-6, 1, MEMBER(stop.targetError),
                   "Add blocks of 64 samples until the image's error is estimated to be below R: root mean square, of "
                   "the display-encoded image (0 to 1) at EV 0"),
            "/targetError"),
        withUnit(number("timeLimit", "--time-limit", "S", 1e-3, 1e6, MEMBER(stop.timeLimit),
                        "Add blocks of 64 samples for S seconds, loading not counted; with --target-error, at most so "
                        "long. In a film: begin no frame after S seconds"),
                 "s"),
        inShot(choice<Sequence>("sequence", "--sequence", sequences, MEMBER(settings.sequence),
                                "Where the samples lie on the lens and in the pixel; the paper has halton"),
               "/sequence"),
        inShot(whole("seed", "--seed", 0, std::numeric_limits<std::uint32_t>::max(), MEMBER(settings.seed),
                     "Picks another set of sample points"),
               "/seed"),
        inShot(
            choice<LodMode>("lod", "--lod", modes, MEMBER(settings.lod),
                            "Coarser meshes for blurred objects: samples split between two levels, the same with one "
                            "sample split over its pixels, one level, or full detail"),
            "/lod"),
        inShot(number("blurThreshold", "--blur-threshold", "K", 0, 1e3, MEMBER(settings.thresholds.blur),
                      "Levels by size: target in pixels per pixel of blur; without it, by the number of samples"),
               "/blurThreshold"),
        withUnit(inShot(number("sizeThreshold", "--size-threshold", "K", 0, 1e6, MEMBER(settings.thresholds.size),
                               "Levels by size: least target in pixels; without it, by the number of samples"),
                        "/sizeThreshold"),
                 "px"),
        withUnit(inShot(number("lightThreshold", "--light-threshold", "K", 0, 1e3, MEMBER(settings.thresholds.light),
                               "Error of measured levels, in standard deviations of their light within the blur, "
                               "where edges are 1 px long; without it, by the number of samples"),
                        "/lightThreshold"),
                 "px"),
        path("cacheFolder", "--cache-dir", "FOLDER", MEMBER(cacheFolder),
             "Where simplified meshes are kept; without it, $XDG_CACHE_HOME/defocus or ~/.cache/defocus"),
        truth("noCache", "--no-cache", MEMBER(noCache), "Simplify the meshes anew and store nothing"),
    };
}

Rows methodRows() {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    return {
        inShot(other(
                   "method", "--method", "NAME", setMethod,
                   [](const Request& request) { return std::optional(chosenMethod(request).text()); },
                   fmt::format("How the image is made: {}; also NAME:SETTING=VALUE,… with the method's settings",
                               fmt::join(names, ", "))),
               "/method"),
        inShot(choice<LayerFormat>("layerFormat", "--layer-format",
                                   {{"automatic", LayerFormat::automatic},
                                    {"rgb9e5", LayerFormat::rgb9e5},
                                    {"rgba16f", LayerFormat::rgba16f},
                                    {"rgba32f", LayerFormat::rgba32f},
                                    {"rgba8", LayerFormat::rgba8}},
                                   MEMBER(layerFormat), "Pixels of a sample's layer; rgba32f for references"),
               "/layerFormat"),
    };
}

Setting exposureSetting() {
    constexpr double least = -60, most = 60;
    Setting setting =
        row(SettingKind::number, "exposure", "--exposure", "EV|auto",
            "Of .png, .jpg and films. auto meters the scene as a camera does, once for a shot. Without it, "
            "what --exposure-time, --iso and the f-number make; else auto where the scene has lights of "
            "its own; else 0");
    setting.least = least;
    setting.most = most;
    setting.choices = {"auto"};
    setting.set = [](Request& request, const std::string& text) {
        const bool automatic = text == "auto";
        request.exposure = automatic ? std::nullopt : std::optional(parseNumber(text, {least, most}));
        request.exposureAuto = automatic;
    };
    setting.text = [](const Request& request) -> std::optional<std::string> {
        if (request.exposureAuto) return "auto";
        return request.exposure ? std::optional(fmt::format("{}", *request.exposure)) : std::nullopt;
    };
    setting.clear = [](Request& request) {
        request.exposure.reset();
        request.exposureAuto = false;
    };
    return setting;
}

Rows displayRows() {
    return {
        inShot(choice<ToneMap>("toneMap", "--tonemap",
                               {{"none", ToneMap::none},
                                {"aces", ToneMap::aces},
                                {"agx", ToneMap::agx},
                                {"neutral", ToneMap::neutral}},
                               MEMBER(toneMap),
                               "Curve of .png, .jpg and films. neutral keeps colours and rolls highlights off; none "
                               "clips at white"),
               "/toneMap"),
        withUnit(inShot(exposureSetting(), "/exposure"), "EV"),
    };
}

Setting memorySetting() {
    Setting setting = other(
        "memory", "--memory", "SIZE",
        [](Request& request, const std::string& text) { request.memory = parseBytes(text); },
        [](const Request& request) -> std::optional<std::string> {
            return request.memory ? std::optional(fmt::format("{}B", *request.memory)) : std::nullopt;
        },
        "Memory that the program may take, such as 2GiB: as many samples are drawn at once, and the image in one piece "
        "or "
        "in tiles, as it allows (same image). Without it, three quarters of what is free");
    setting.clear = [](Request& request) { request.memory.reset(); };
    return setting;
}

// What only those need who measure or mend the program.
Rows developerRows() {
    return {
        inShot(
            choice<LodMetric>(
                "lodMetric", "--lod-metric",
                {{"automatic", LodMetric::automatic},
                 {"size", LodMetric::size},
                 {"error", LodMetric::error},
                 {"halving", LodMetric::halving},
                 {"measured", LodMetric::measured},
                 {"score", LodMetric::score}},
                MEMBER(settings.metric),
                "Levels are chosen by what the blur leaves of how they change the light (measured); by the projected "
                "size of their edges, of their error, or of full detail's edges as if each level had exactly half the "
                "triangles (halving); or by how many edges at the object's centre the blur measures (score). "
                "automatic: by size where one of its thresholds is given, else measured"),
            "/lodMetric"),
        inShot(choice<LevelVertices>(
                   "levelVertices", "--level-vertices",
                   {{"fitted", LevelVertices::fitted},
                    {"surviving", LevelVertices::surviving},
                    {"quarters", LevelVertices::quarters}},
                   MEMBER(settings.levelVertices),
                   "Coarser levels are fitted to full detail, or are made of those of its vertices that survive, as "
                   "they are; quarters: so made, and only two, of 75 and 50 % of the vertices"),
               "/levelVertices"),
        choice<bool>("lodCoc", "--lod-coc", {{"smallest", false}, {"centre", true}}, MEMBER(settings.lodCocAtCentre),
                     "The blur that an object may count on: the smallest over its box, or the one at its centre"),
        withUnit(number("cocTolerance", "--coc-tolerance", "PX", 1e-3, 1e3, MEMBER(settings.cocTolerance),
                        "By how much the blur inside a triangle may differ from what its corners give; larger ones are "
                        "divided"),
                 "px"),
        truth("keepAll", "--keep-all", MEMBER(settings.keepAll),
              "Leave out nothing, not even what cannot be seen (same image, slower)"),
        memorySetting(),
        whole("wave", "--wave", 0, 64, MEMBER(wave), "Samples drawn at once; 0: as memory allows (same image)"),
    };
}

#undef MEMBER

// Settings that most people use, of which --help alone tells.
constexpr auto everyday =
    std::to_array<std::string_view>({"scene", "time", "environment", "camera", "size", "focalLength", "fStop",
                                     "focusDistance", "focusNode", "blurScale", "samples", "method", "exposure"});

Rows allRows() {
    Rows rows;
    add(rows, SettingGroup::scene, sceneRows());
    add(rows, SettingGroup::camera, cameraRows());
    add(rows, SettingGroup::lens, lensRows());
    add(rows, SettingGroup::samples, sampleRows());
    add(rows, SettingGroup::method, methodRows());
    add(rows, SettingGroup::display, displayRows());
    add(rows, SettingGroup::developer, developerRows());
    for (Setting& setting : rows) setting.everyday = std::ranges::find(everyday, setting.name) != everyday.end();
    return rows;
}

}  // namespace

std::span<const Setting> settings() {
    static const Rows rows = allRows();
    return rows;
}

}  // namespace defocus
