// Rows of the settings table, in the order of --help.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/memory_limits.h"
#include "frame/settings/conditions.h"
#include "frame/settings/presets.h"
#include "frame/settings/row.h"
#include "frame/settings/values.h"
#include "lens/lens_fields.h"
#include "lens/lens_samples.h"
#include "lod/pyramid/level_selection.h"
#include "render/sampling/automatic_samples.h"
#include "scene/units.h"

namespace defocus::engine {

namespace {

using Rows = std::vector<Setting>;

// Callable that returns a member of a Request, as the functions of row.h expect.
#define MEMBER(path)             \
    [](auto& request) -> auto& { \
        return request.path;     \
    }

// ---- scene ----------------------------------------------------------------------------------------------------------

Row unitsRow() {
    return Row(SettingKind::number, "units", "--units", "m|cm|mm|M|auto",
               "Length of one unit of the scene: m, cm, mm or a number of metres. auto takes the unit in the file's "
               "extras. Without it: 1 m if the camera has a physical lens or an option is given in m, else an estimate "
               "from the scene's size")
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
                     "Time in the animation in seconds. Outside its range, the animation holds its first or last frame")
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
        shutterRow().unit("s").inShot("/shutter/seconds").unused(methodWithoutMotion),
        rows::choice<ShutterPosition>(
            "shutterPosition", "--shutter-position",
            {{"start", ShutterPosition::start}, {"centre", ShutterPosition::centre}, {"end", ShutterPosition::end}},
            MEMBER(shutterPosition),
            "Whether the shutter opens at --time (start), is open around it (centre), or closes at it (end)")
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
                    "default lights; lights in the file are kept")
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
        rows::choice<Shadows>(
            "shadows", "--shadows", {{"auto", Shadows::automatic}, {"on", Shadows::on}, {"off", Shadows::off}},
            MEMBER(shadows), "Soft shadows of the lights and the environment. auto: only with --ground")
            .inShot("/shadows"),
        rows::boolean("multipleScattering", "--multiple-scattering", MEMBER(multipleScattering),
                      "Restore the light that rough surfaces lose in glTF's material model: rough metals become "
                      "brighter and more saturated")
            .inShot("/multipleScattering"),
        rows::number("lightAngle", "--light-angle", "DEG", 0, 90, MEMBER(lightAngle),
                     "Angular diameter of directional lights in degrees; larger lights give softer shadows. Default: "
                     "0.53 (the sun) for lights in the file")
            .unit("degrees")
            .example("5")
            .inShot("/lightAngle")
            .unused(withoutShadows),
        rows::number("lightRadius", "--light-radius", "M", 0, 1e6, MEMBER(lightRadius),
                     "Radius of point and spot lights in m; larger lights give softer shadows. Default: 0.03 for "
                     "lights in the file")
            .unit("m")
            .example("0.1")
            .inShot("/lightRadius")
            .unused(withoutShadows),
    };
}

// ---- camera ---------------------------------------------------------------------------------------------------------

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
            "Camera from another file, with lens, animation and shutter: a USD text file (.usda), a glTF file, or "
            "the JSON of 'defocus export-camera'. CAMERA is a path such as /World/cam or a name; default: the "
            "file's only camera")
            .excludes({"camera"})
            .example("shot.usda:/World/cam"),
        pointRow(
            "cameraPosition", "--camera-position", MEMBER(cameraPosition),
            "Position of the camera in m. Does not move the default lights. Default: the position of the file's camera")
            .unit("m"),
        pointRow("cameraTarget", "--camera-target", MEMBER(cameraTarget),
                 "Point in m that the camera looks at. Default: the viewing direction of the file's camera")
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

// ---- lens -----------------------------------------------------------------------------------------------------------

std::string unitOf(std::string_view metavar) {
    if (metavar == "MM") return "mm";
    if (metavar == "M") return "m";
    if (metavar == "DEG") return "degrees";
    if (metavar == "PX") return "px";
    if (metavar == "D") return "dioptres";
    if (metavar == "S") return "s";
    return "";
}

// Returns the function that gives the reason why a lens field has no effect.
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

// ---- samples --------------------------------------------------------------------------------------------------------

// Row of the setting "preset", which stores no value; see presets.h. This row precedes the rows of all settings that a
// preset sets, so that options given explicitly override the preset.
Row presetRow() {
    std::vector<std::string> names;
    std::vector<std::string> lines;
    for (const Preset& preset : presets()) {
        names.push_back(preset.name);
        lines.push_back(fmt::format("{}: {}", preset.name, preset.description));
    }
    Row row =
        Row(SettingKind::choice, "preset", "--preset", fmt::format("{}", fmt::join(names, "|")),
            fmt::format("Reproduce the settings of a paper; other options override them. {}", fmt::join(lines, "; ")))
            .choices(names)
            .effect(SettingEffect::run)
            .recorded();
    return std::move(row).values(
        [names](Request& request, const std::string& text) {
            applyPreset(presets()[parseChoice(text, names)], request);
        },
        [](const Request& request) {
            const Preset* const preset = presetOf(request);
            return preset == nullptr ? std::nullopt : std::optional(preset->name);
        },
        [](Request& request) {
            if (const Preset* const preset = presetOf(request)) clearPreset(*preset, request);
        });
}

Row samplesRow() {
    return rows::integer("samples", "--samples", 1, maxSamples, MEMBER(samples),
                         fmt::format("Number of lens samples. auto: the number that --quality needs, from 16 to {}. "
                                     "With --target-error or --time-limit: the maximum number, {} by default",
                                     maxAutomaticSamples, maxSamples))
        .metavar("N|auto")
        .choices({"auto"})
        .values(
            [](Request& request, const std::string& text) {
                request.samples = text == "auto"
                                      ? std::nullopt
                                      : std::optional(static_cast<std::uint32_t>(parseInteger(text, 1, maxSamples)));
            },
            [](const Request& request) -> std::optional<std::string> {
                return request.samples ? fmt::format("{}", *request.samples) : "auto";
            });
}

Rows sampleRows() {
    std::vector<std::pair<std::string, Sequence>> sequences;
    for (const Sequence sequence : allSequences) sequences.emplace_back(sequenceName(sequence), sequence);
    std::vector<std::pair<std::string, LodMode>> modes;
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous, LodMode::nearest, LodMode::off})
        modes.emplace_back(lodModeName(mode), mode);
    return {
        presetRow().inShot("/preset"),
        samplesRow().everyday().example("64").inShot("/samples").unused(methodWithoutSamples),
        rows::choice<Quality>("quality", "--quality",
                              {{"draft", Quality::draft}, {"good", Quality::good}, {"fine", Quality::fine}},
                              MEMBER(quality),
                              "Quality for --samples auto: perceived difference (FLIP) from an image without noise of "
                              "about 0.03 (draft), 0.01 (good) or 0.005 (fine)")
            .everyday()
            .inShot("/quality")
            .excludes({"targetError", "timeLimit"})
            .unused([](const SettingContext& context) {
                return firstOf(context, {methodWithoutSamples, withFixedSamples});
            }),
        rows::number("targetError", "--target-error", "R", 1e-6, 1, MEMBER(targetError),
                     "Add blocks of 64 samples until the estimated error is below R: the RMSE of display-encoded "
                     "values from 0 to 1 at EV 0")
            .example("0.003")
            .inShot("/targetError"),
        rows::number("timeLimit", "--time-limit", "S", 1e-3, 1e6, MEMBER(timeLimit),
                     "Add blocks of 64 samples for S seconds, or until --target-error is reached. Loading does not "
                     "count. capture starts no frame after S seconds instead")
            .unit("s")
            .effect(SettingEffect::run)
            .recorded(),
        rows::choice<Sequence>(
            "sequence", "--sequence", sequences, MEMBER(sequence),
            "Sequence of the sample points on the lens and in the pixel; Jeong et al. 2011 use halton")
            .inShot("/sequence")
            .unused(methodWithoutSamples),
        rows::integer("seed", "--seed", 0, std::numeric_limits<std::uint32_t>::max(), MEMBER(seed),
                      "Seed of the sample points")
            .inShot("/seed")
            .unused(methodWithoutSamples),
        rows::choice<LodMode>("lod", "--lod", modes, MEMBER(lod),
                              "Levels of detail of blurred objects. nearest: one level per object. fractional: the "
                              "lens samples are divided between two levels. continuous (default of capture): also "
                              "divides the pixels of one sample, for smoother transitions. off: full detail")
            .inShot("/lod"),
        rows::number("blurThreshold", "--blur-threshold", "K", 0, 1e3, MEMBER(blurThreshold),
                     "For --lod-metric size, error and score: edge length of the triangles, in px, for each px of "
                     "blur; a larger value is coarser and faster. Default: depends on the number of samples. For "
                     "proportional: level of an object whose blur is as large as its bounding box")
            .example("0.2")
            .inShot("/blurThreshold")
            .unused(withoutLevels),
        rows::number("sizeThreshold", "--size-threshold", "K", 0, 1e6, MEMBER(sizeThreshold),
                     "For --lod-metric size and error: edge length, in px, that triangles may always have. Default: "
                     "depends on the number of samples")
            .unit("px")
            .example("1")
            .inShot("/sizeThreshold")
            .unused(withoutLevels),
        rows::number("lightThreshold", "--light-threshold", "K", 0, 1e3, MEMBER(lightThreshold),
                     "For --lod-metric measured: allowed error of the blurred shading; a larger value is coarser and "
                     "faster. It is the product, in px, of a level's projected edge length and its relative error "
                     "(docs/reference.md). Default: depends on the number of samples")
            .unit("px")
            .example("0.1")
            .inShot("/lightThreshold")
            .unused(withoutLevels),
        rows::words(SettingKind::path, "cacheFolder", "--cache-dir", "FOLDER", MEMBER(cacheFolder),
                    "Folder of the cache of simplified meshes. Default: $XDG_CACHE_HOME/defocus, else ~/.cache/defocus")
            .effect(SettingEffect::run),
        rows::boolean("noCache", "--no-cache", MEMBER(noCache), "Neither read nor write the cache of simplified meshes")
            .excludes({"cacheFolder"})
            .effect(SettingEffect::run),
    };
}

// ---- method, display, developers ------------------------------------------------------------------------------------

Rows methodRows() {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    return {
        rows::other("method", "--method", "NAME", setMethod, methodText,
                    fmt::format("Rendering method: {}. NAME:SETTING=VALUE,… also sets the method's settings",
                                fmt::join(names, ", ")))
            .clears(clearMethod)
            .everyday()
            .inShot("/method"),
        rows::choice<LayerFormat>("layerFormat", "--layer-format",
                                  {{"automatic", LayerFormat::automatic},
                                   {"rgba16f", LayerFormat::rgba16f},
                                   {"rgba32f", LayerFormat::rgba32f}},
                                  MEMBER(layerFormat),
                                  "Pixel format of the image rendered for each lens sample, before accumulation; use "
                                  "rgba32f for reference images")
            .inShot("/layerFormat"),
    };
}

Rows displayRows() {
    return {
        rows::other(
            "exrLayers", "--exr-layers", "LAYER,…", setLayers, layersText,
            "Layers beside the picture in .exr files, drawn through the lens with the picture's samples and "
            "premultiplied by the coverage: depth (mean and nearest, m), position, normal, albedo, emission, "
            "motion (px while the shutter is open), coc (px), and the Cryptomattes objects and materials; or all")
            .clears(MEMBER(layers))
            .example("depth,normal,albedo"),
        rows::choice<ExrNames>("exrNames", "--exr-names", {{"nuke", ExrNames::nuke}, {"blender", ExrNames::blender}},
                               MEMBER(exrNames),
                               "Channel names of --exr-layers: Nuke's (depth.Z, N.X) or Blender's (ViewLayer.Depth.Z)")
            .effect(SettingEffect::run)
            .recorded()
            .unused(withoutLayers),
        rows::choice<ToneMap>(
            "toneMap", "--tonemap",
            {{"none", ToneMap::none}, {"aces", ToneMap::aces}, {"agx", ToneMap::agx}, {"neutral", ToneMap::neutral}},
            MEMBER(toneMap),
            "Tone curve of PNG, JPEG and video. neutral: keeps colours and compresses highlights. none: clips at white")
            .effect(SettingEffect::display)
            .inShot("/toneMap"),
        Row(SettingKind::number, "exposure", "--exposure", "EV|auto",
            "Exposure in EV for PNG, JPEG and video. auto: meter the scene once. Default: from --exposure-time if "
            "given, else auto for scenes with lights, else 0")
            .range(-60, 60)
            .choices({"auto"})
            .clears(MEMBER(exposure))
            .values(setExposure, exposureText)
            .unit("EV")
            .everyday()
            .example("auto")
            .excludes({"exposureTime", "iso"})
            .effect(SettingEffect::display)
            .inShot("/exposure"),
    };
}

// Settings for measuring and debugging.
Rows developerRows() {
    return {
        rows::choice<LodMetric>(
            "lodMetric", "--lod-metric",
            {{"automatic", LodMetric::automatic},
             {"size", LodMetric::size},
             {"error", LodMetric::error},
             {"measured", LodMetric::measured},
             {"proportional", LodMetric::proportional},
             {"score", LodMetric::score}},
            MEMBER(lodMetric),
            "Rule that chooses the levels of detail. measured: by the error of the blurred shading (most accurate). "
            "size: by the length of triangle edges in the image. error: by the distance to full detail in the image. "
            "proportional: by the ratio of blur to the size of the object's bounding box (Jeong et al. 2011). score: "
            "by the ratio of blur to edge length (Tzeng et al. 2012). automatic: size if --blur-threshold or "
            "--size-threshold is given, else measured")
            .inShot("/lodMetric")
            .unused(withoutLevels),
        rows::choice<LevelVertices>(
            "levelVertices", "--level-vertices",
            {{"fitted", LevelVertices::fitted},
             {"surviving", LevelVertices::surviving},
             {"quarters", LevelVertices::quarters}},
            MEMBER(levelVertices),
            "Vertices of the simplified levels. fitted: moved so that the level fits full detail best. surviving: a "
            "subset of the original vertices. quarters: three such subsets, of 100, 75 and 50 %")
            .inShot("/levelVertices")
            .unused(withoutLevels),
        rows::choice<LodCoc>("lodCoc", "--lod-coc", {{"smallest", LodCoc::smallest}, {"centre", LodCoc::centre}},
                             MEMBER(lodCoc),
                             "Blur that decides an object's level: the smallest within its bounding box (safe), or the "
                             "blur at the box's centre (coarser and faster)")
            .unused([](const SettingContext& context) {
                return firstOf(context, {methodWithoutSamples, withoutLevels, withMeasuredLevels});
            }),
        rows::number("cocTolerance", "--coc-tolerance", "PX", 1e-3, 1e3, MEMBER(cocTolerance),
                     "Maximum error, in px, of interpolating the blur across a triangle; triangles with a larger error "
                     "are subdivided")
            .unit("px")
            .unused(methodWithoutSamples),
        rows::boolean("keepAll", "--keep-all", MEMBER(keepAll), "Disable culling (same image, slower)")
            .effect(SettingEffect::run),
        rows::other(
            "memory", "--memory", "SIZE",
            [](Request& request, const std::string& text) { request.memory = parseBytes(text); },
            [](const Request& request) -> std::optional<std::string> {
                if (!request.memory) return std::nullopt;
                return fmt::format("{}B", *request.memory);
            },
            "Maximum memory of the program, such as 2GiB. Smaller limits draw fewer samples at once, or the image in "
            "tiles; the image stays the same. With a limit, method auto is accumulation, as multirate cannot draw "
            "tiles. Default: three quarters of the free memory")
            .clears(MEMBER(memory))
            .effect(SettingEffect::run),
        rows::integer(
            "wave", "--wave", 1, 64, MEMBER(wave),
            "Maximum number of samples drawn at once; does not affect the image. Default: as many as fit into "
            "memory, at most 16")
            .effect(SettingEffect::run),
    };
}

#undef MEMBER

// Lets a setting that is a length accept the suffixes mm, cm and m.
void acceptSuffixes(Setting& setting) {
    if (setting.unit != "m" && setting.unit != "mm") return;
    setting.set = [set = setting.set, unit = setting.unit](Request& request, const std::string& text) {
        const std::string number = lengthsIn(unit, text);
        try {
            set(request, number);
        } catch (const Error& error) {
            if (number == text) throw;
            fail("{} is {} {}: {}", text, number, unit, error.what());
        }
    };
}

std::vector<Setting>& table() {
    static std::vector<Setting> all = [] {
        Rows rows;
        const auto add = [&](SettingGroup group, Rows more) {
            for (Setting& setting : more) {
                setting.group = group;
                acceptSuffixes(setting);
                rows.push_back(std::move(setting));
            }
        };
        add(SettingGroup::scene, sceneRows());
        add(SettingGroup::camera, cameraRows());
        add(SettingGroup::lens, lensRows());
        add(SettingGroup::samples, sampleRows());
        add(SettingGroup::method, methodRows());
        add(SettingGroup::display, displayRows());
        add(SettingGroup::developer, developerRows());
        rows.reserve(rows.size() + 16);  // keeps pointers to rows valid when addSetting appends rows
        return rows;
    }();
    return all;
}

}  // namespace

std::span<const Setting> settings() {
    return table();
}

void addSetting(Setting setting) {
    table().push_back(std::move(setting));
}

}  // namespace defocus::engine
