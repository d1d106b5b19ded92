#include "cli/scene_options.h"

#include <limits>
#include <map>

#include "cli/option_text.h"
#include "core/error.h"
#include "core/parse.h"
#include "lens/lens_fields.h"

namespace defocus {

namespace {

constexpr std::uint64_t mostPixels = 16'384;
constexpr std::uint64_t mostSamples = 65'536;

void parseSize(const std::string& text, SceneOptions& options) {
    const std::size_t cross = text.find_first_of("xX");
    if (cross == std::string::npos) fail("'{}' is not WIDTHxHEIGHT, such as 1024x768", text);
    try {
        options.width = static_cast<int>(parseWhole(text.substr(0, cross), 1, mostPixels));
        options.height = static_cast<int>(parseWhole(text.substr(cross + 1), 1, mostPixels));
    } catch (const Error&) {
        fail("'{}': width and height must be whole numbers from 1 to {}, such as 1024x768", text, mostPixels);
    }
}

void parsePixel(const std::string& text, SceneOptions& options) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) fail("'{}' is not X,Y (column and row, 0,0 at the top left)", text);
    options.focusPixel = glm::ivec2(parseWhole(text.substr(0, comma), 0, mostPixels - 1),
                                    parseWhole(text.substr(comma + 1), 0, mostPixels - 1));
}

void parsePoints(const std::string& text, SceneOptions& options) {
    const std::vector<double> numbers = parseNumbers(text, 6, {0, mostPixels - 1});
    std::array<glm::ivec2, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = glm::ivec2(numbers[2 * i], numbers[2 * i + 1]);
    options.focusPoints = points;
}

// NAME=SCALE each; a name may hold an equals sign.
void parseNodeBlurs(const std::vector<std::string>& texts, SceneOptions& options) {
    for (const std::string& text : texts) try {
            const std::size_t equals = text.rfind('=');
            if (equals == std::string::npos || equals == 0) fail("'{}' is not NAME=SCALE, such as Fish3=0", text);
            options.nodeBlur[text.substr(0, equals)] = parseNumber(text.substr(equals + 1), {0, 1e3});
        } catch (const Error& error) {
            throw CLI::ValidationError("--node-blur", error.what());
        }
}

void parseBackground(const std::string& text, SceneOptions& options) {
    if (text.find(',') != std::string::npos) {
        const std::vector<double> color = parseNumbers(text, 3, {0, 1e9});
        options.background = Background::uniform;
        options.backgroundColor = glm::vec3(color[0], color[1], color[2]);
        return;
    }
    const std::size_t choice = parseChoice(text, {"environment", "none", "R,G,B"});
    if (choice > 1) fail("give three numbers for R,G,B, such as 0.2,0.2,0.2");
    options.background = choice == 0 ? Background::environment : Background::none;
}

void parseSegments(const std::string& text, SceneOptions& options) {
    constexpr std::uint64_t mostSegments = 64;
    options.shutter.exactMotion = text == "exact";
    if (!options.shutter.exactMotion)
        options.shutter.motionSegments = static_cast<std::uint32_t>(parseWhole(text, 1, mostSegments));
}

void addShutter(CLI::App& command, SceneOptions& options) {
    const char* group = "Scene";
    addParsed(command, "--shutter", "S",
              "Seconds that the shutter stays open, as 0.02 or 1/48 (half of a frame of 24 a second): what the "
              "animation moves meanwhile is blurred; without it, one moment",
              [&options](const std::string& text) { options.shutter.seconds = parseSeconds(text); })
        ->group(group);
    addChoice<ShutterPosition>(
        command, "--shutter-position", options.shutter.position,
        {{"start", ShutterPosition::start}, {"centre", ShutterPosition::centre}, {"end", ShutterPosition::end}},
        "Where --time lies in the exposure")
        ->group(group);
    addParsed(command, "--motion-segments", "N|exact",
              "Straight lines that a vertex's way is cut into while the shutter is open (1 to 64), or 'exact' for a "
              "pose of its own for each sample",
              [&options](const std::string& text) { parseSegments(text, options); })
        ->default_str("1")
        ->group(group);
}

void addMoment(CLI::App& command, SceneOptions& options) {
    const char* group = "Scene";
    addNumber(command, "--time", options.time, {-1e9, 1e9}, "S",
              "Seconds into the animation; before and after it, its ends")
        ->group(group);
    command
        .add_option("--clip", options.clip,
                    "Which of the file's animations plays: its name or number (see 'defocus info'); without it, the "
                    "first")
        ->type_name("NAME|N")
        ->group(group);
    command.add_flag("--loop", options.loop, "Repeat the animation instead of holding its ends")->group(group);
}

void addScene(CLI::App& command, SceneOptions& options) {
    const char* group = "Scene";
    CLI::Option* scene =
        command.add_option("SCENE", options.path, "glTF file (.gltf, .glb); without one, the built-in school of fish")
            ->type_name("FILE");
    addWhole(command, "--fish", options.fishCount, 1, 10'000, "Number of fish in the built-in school")
        ->excludes(scene)
        ->group(group);
    addWhole(command, "--fish-triangles", options.trianglesPerFish, 200, 10'000'000, "Triangles a fish, about")
        ->excludes(scene)
        ->group(group);
    addMoment(command, options);
}

void addSurroundings(CLI::App& command, SceneOptions& options) {
    const char* group = "Scene";
    command
        .add_option("--environment", options.environment,
                    "Equirectangular image that lies behind the scene and lights it (.hdr or .exr)")
        ->type_name("FILE")
        ->group(group);
    addParsed(
        command, "--background", "WHAT",
        "'environment' (the default), 'none' for a transparent image, or R,G,B (linear) for one colour all around",
        [&options](const std::string& text) { parseBackground(text, options); })
        ->group(group);
}

void addCameraName(CLI::App& command, SceneOptions& options) {
    command
        .add_option("--camera", options.camera,
                    "Name of a camera of the file, or 'auto' for one that frames the scene; without it, the first")
        ->type_name("NAME")
        ->group("Camera");
}

void addCameraPlace(CLI::App& command, SceneOptions& options) {
    const char* group = "Camera";
    const auto addPoint = [&](const char* name, std::optional<glm::dvec3>& target, const char* description) {
        addParsed(command, name, "X,Y,Z", description, [&target](const std::string& text) {
            const std::vector<double> xyz = parseNumbers(text, 3, {-1e12, 1e12});
            target = glm::dvec3(xyz[0], xyz[1], xyz[2]);
        })->group(group);
    };
    addPoint("--camera-position", options.cameraPosition, "Moves the camera there (m); lights stay as for the camera");
    addPoint("--camera-target", options.cameraTarget, "Turns the camera towards this point, upright");
    addPoint("--camera-up", options.cameraUp, "What is up in the image, as a direction");
    addParsed(command, "--size", "WxH", "Image size in pixels",
              [&options](const std::string& text) { parseSize(text, options); })
        ->default_str(fmt::format("{}x{}", options.width, options.height))
        ->group(group);
}

// Number, whole number or flag, as the field is.
CLI::Option* addLensField(CLI::App& command, SceneOptions& options, const LensField& field) {
    const auto set = [&options, &field](double value) {
        Lens scratch;
        setLensField(scratch, field, value);
        options.lens[field.name] = value;
    };
    if (std::holds_alternative<bool Lens::*>(field.member)) {  // both ways: a file's camera may have it on or off
        const std::string name = field.option;
        return command.add_flag_function(
            name + ",!--no-" + name.substr(2), [set](std::int64_t count) { set(count > 0 ? 1 : 0); },
            field.description);
    }
    const bool whole = std::holds_alternative<int Lens::*>(field.member);
    return addParsed(command, field.option, field.unit, field.description,
                     [set, whole, &field](const std::string& text) {
                         if (field.unit == std::string_view("S")) return set(parseSeconds(text));
                         set(whole ? static_cast<double>(parseWhole(text, static_cast<std::uint64_t>(field.least),
                                                                    static_cast<std::uint64_t>(field.most)))
                                   : parseNumber(text, {field.least, field.most}));
                     });
}

void addFocus(CLI::App& command, SceneOptions& options, CLI::Option* distance) {
    const char* group = "Lens";
    CLI::Option* node = command
                            .add_option("--focus-node", options.focusNode,
                                        "Focus on the centre of this node (its mesh's box, or its origin)")
                            ->type_name("NAME");
    CLI::Option* pixel =
        addParsed(command, "--focus-pixel", "X,Y", "Focus on the surface seen at this pixel (0,0 is the top left one)",
                  [&options](const std::string& text) { parsePixel(text, options); });
    CLI::Option* points = addParsed(command, "--focus-points", "X,Y,X,Y,X,Y",
                                    "Tilt the focus plane so that it goes through what three pixels show",
                                    [&options](const std::string& text) { parsePoints(text, options); });
    CLI::Option* automatic = command.add_flag("--focus-auto", options.focusAuto,
                                              "Focus on the median depth of what the image's middle shows");
    const std::vector<CLI::Option*> ways = {distance, node, pixel, points, automatic};
    for (CLI::Option* way : ways)
        for (CLI::Option* other : ways)
            if (way != other) way->excludes(other);
    for (CLI::Option* way : ways) way->group(group);
}

void addLens(CLI::App& command, SceneOptions& options) {
    for (const LensField& field : lensFields()) {
        CLI::Option* option = addLensField(command, options, field)->group("Lens");
        if (field.name == std::string_view("focusDistance")) addFocus(command, options, option);
    }
    command
        .add_option_function<std::vector<std::string>>(
            "--node-blur", [&options](const std::vector<std::string>& texts) { parseNodeBlurs(texts, options); },
            "Scale the blur of a node and all below it; 0 keeps it sharp. Can be given several times")
        ->allow_extra_args(false)
        ->type_name("NAME=SCALE")
        ->group("Lens");
    addNumber(command, "--coc-tolerance", options.cocTolerance, {1e-3, 1e3}, "PX",
              "By how much the blur inside a triangle may differ from what its corners give; larger ones are divided")
        ->group("Lens");
    command
        .add_option("--aperture-image", options.apertureImage,
                    "Image of the aperture, in place of blades and rings: light passes where it is bright; its longer "
                    "side spans the lens")
        ->type_name("FILE")
        ->group("Lens");
}

void addLevels(CLI::App& command, SceneOptions& options) {
    const char* group = "Samples and level of detail";
    addWhole(command, "--samples", options.samples, 1, mostSamples, "Lens samples")->group(group);
    std::vector<std::pair<std::string, Sequence>> sequences;
    for (const Sequence sequence : allSequences) sequences.emplace_back(sequenceName(sequence), sequence);
    addChoice<Sequence>(command, "--sequence", options.sequence, sequences,
                        "Where the samples lie on the lens and in the pixel; the paper has halton")
        ->group(group);
    addWhole(command, "--seed", options.seed, 0, std::numeric_limits<std::uint32_t>::max(),
             "Picks another set of sample points")
        ->group(group);
    addChoice<LodMode>(
        command, "--lod", options.lod,
        {{"fractional", LodMode::fractional},
         {"continuous", LodMode::continuous},
         {"nearest", LodMode::nearest},
         {"off", LodMode::off}},
        "Coarser meshes for blurred objects: samples split between two levels, the same with one sample split over "
        "its pixels, one level, or full detail")
        ->group(group);
    addChoice<LodMetric>(command, "--lod-metric", options.metric,
                         {{"size", LodMetric::size}, {"error", LodMetric::error}},
                         "Levels are chosen by the projected size of their edges or of their error")
        ->group(group);
    addChoice<bool>(command, "--lod-coc", options.lodCocAtCentre, {{"smallest", false}, {"centre", true}},
                    "The blur that an object may count on: the smallest over its box, or the one at its centre")
        ->group(group);
    addNumber(command, "--blur-threshold", options.blurThreshold, {0, 1e3}, "K",
              "Target in pixels per pixel of blur; without it, by the number of samples")
        ->group(group);
    addNumber(command, "--size-threshold", options.sizeThreshold, {0, 1e6}, "K",
              "Least target in pixels; without it, by the number of samples")
        ->group(group);
    command
        .add_flag("--keep-all", options.keepAll, "Leave out nothing, not even what cannot be seen (same image, slower)")
        ->group(group);
    CLI::Option* folder = addCacheFolder(command, options.cacheFolder);
    command.add_flag("--no-cache", options.noCache, "Simplify the meshes anew and store nothing")
        ->excludes(folder)
        ->group(group);
    folder->group(group);
}

std::string valuesOf(const MethodSetting& setting) {
    if (!setting.choices.empty()) return fmt::format("{}", fmt::join(setting.choices, "|"));
    return setting.whole ? "N" : "R";
}

void addMethod(CLI::App& command, SceneOptions& options) {
    const char* group = "Method";
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    addParsed(command, "--method", "NAME",
              fmt::format("How the image is made: {}; also NAME:SETTING=VALUE,… with the method's settings",
                          fmt::join(names, ", ")),
              [&options, names](const std::string& text) {
                  static_cast<void>(parseChoice(text.substr(0, text.find(':')), names));
                  options.method = parseMethodUse(text).text();
              })
        ->default_str(options.method)
        ->group(group);
    addChoice<LayerFormat>(command, "--layer-format", options.layerFormat,
                           {{"automatic", LayerFormat::automatic},
                            {"rgb9e5", LayerFormat::rgb9e5},
                            {"rgba16f", LayerFormat::rgba16f},
                            {"rgba32f", LayerFormat::rgba32f},
                            {"rgba8", LayerFormat::rgba8}},
                           "Pixels of a sample's layer; rgba32f for references")
        ->group(group);
    addWhole(command, "--wave", options.wave, 0, 64, "Samples drawn at once; 0: as memory allows (same image)")
        ->group(group);
}

}  // namespace

void excludeExposure(CLI::App& command) {
    for (const char* name : {"--exposure-time", "--iso"})
        command.get_option(name)->excludes(command.get_option("--exposure"));
}

void addMethodSettings(CLI::App& command, SceneOptions& options) {
    std::map<std::string, std::string> owners;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings)
            owners[setting.name] += (owners[setting.name].empty() ? "" : ", ") + method.name;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) {
            const auto owner = owners.extract(setting.name);
            if (owner.empty()) continue;  // added with an earlier method
            command
                .add_option_function<std::string>(
                    "--" + setting.name,
                    [&options, name = setting.name](const std::string& text) { options.methodSettings[name] = text; },
                    setting.description)
                ->type_name(valuesOf(setting))
                ->default_str(setting.standard)
                ->group("Method " + owner.mapped());
        }
}

CLI::Option* addCacheFolder(CLI::App& command, std::filesystem::path& folder) {
    return command
        .add_option("--cache-dir", folder,
                    "Where simplified meshes are kept; without it, $XDG_CACHE_HOME/defocus or ~/.cache/defocus")
        ->type_name("FOLDER");
}

void addCameraOptions(CLI::App& command, SceneOptions& options) {
    addMoment(command, options);
    addCameraPlace(command, options);
    addLens(command, options);
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    addScene(command, options);
    addShutter(command, options);
    addSurroundings(command, options);
    addCameraName(command, options);
    addCameraPlace(command, options);
    addLens(command, options);
    addLevels(command, options);
    addMethod(command, options);
}

}  // namespace defocus
