#pragma once
// Lists, for every setting of the program and of its methods, a value that must change a command's printed text, image
// or measurements. Also builds the small scene that the commands render.

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options/request_options.h"
#include "core/file.h"
#include "image/image_io.h"
#include "render/methods.h"
#include "scene/gltf/builder.h"
#include "small_world.h"

namespace defocus::engine {

using Words = std::vector<std::string>;

inline Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// Test case of an option. `words` are the option and its value. `with` are further options that the case needs; the
// test leaves out those that the tested command does not accept. `against` is the option with another value to compare
// with; if empty, the comparison is with a command line without the option.
struct OptionCase {
    Words words;
    Words with;
    bool still = false;  // whether the scene is a still fish instead of the moving ball
    Words against = {};
    bool needsDriver = false;  // some drivers ignore the option, so only its effect on pixels is checked
};

namespace option_cases {

// Returns a glTF file: in front of a board, a ball of 700 triangles recedes for 2 s and, in the second half, also moves
// to the right. In a second clip, the ball stands still. A second camera is closer and has its own focus distance. If
// `lamp` is set, a lamp illuminates the scene from above. If `pane` is set, the board is a glass pane.
inline std::string movingBall(bool lamp, bool pane = false) {
    const Mesh ball = bumpySphere(24, 16, 0);
    GltfBuilder builder;
    std::vector<float> corners;
    for (const glm::vec3& p : ball.vertices.positions) corners.insert(corners.end(), {p.x, p.y, p.z});
    const std::vector<std::uint32_t>& wide = ball.primitives.front().indices;
    const int ballPositions = builder.positions(corners);
    const int ballIndices = builder.indices(std::vector<std::uint16_t>(wide.begin(), wide.end()));
    builder.mesh({{{"attributes", {{"POSITION", ballPositions}}}, {"indices", ballIndices}}}, {{"name", "Ball"}});
    const int positions = builder.positions({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    const int indices = builder.indices({0, 1, 2, 0, 2, 3});
    nlohmann::json board = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
    if (pane) {
        builder.add("materials",
                    {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.5}}}}});
        board["material"] = 0;
    }
    builder.mesh(nlohmann::json::array({board}),
                 {{"name", "Board"}, {"translation", {-1.5, 0.5, -9}}, {"scale", {2, 2, 1}}});
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Green"}}};
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"variants", {0}}, {"material", builder.json.value("materials", nlohmann::json::array()).size()}}};
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}}});
    builder.json["cameras"] = {
        {{"name", "Far"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}},
        {{"name", "Near"},
         {"type", "perspective"},
         {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}},
         {"extras", {{"focusDistance", 1}}}}};
    builder.add("nodes", {{"camera", 0}});
    builder.add("nodes", {{"camera", 1}, {"translation", {0.2, 0, -0.5}}});
    if (lamp) {
        builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 100}}};
        builder.add("nodes",
                    {{"translation", {0.5, 3, -3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    }
    const int times = builder.floats({0, 1, 2}, "SCALAR", 1);
    const int away = builder.floats({0, 0, -3, 0.2, 0.3, -3.5, 1.5, 0, -6}, "VEC3", 3);
    const int still = builder.floats({0, 0, -3, 0, 0, -3, 0, 0, -3}, "VEC3", 3);
    const auto clip = [&](const char* name, int output) {
        return nlohmann::json{{"name", name},
                              {"samplers", {{{"input", times}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
    };
    builder.json["animations"] = {clip("Away", away), clip("Still", still)};
    return builder.glb();
}

// A camera that stands to the left of the file's cameras and focuses on the ball.
inline constexpr const char* usdCamera = R"(#usda 1.0
(
    metersPerUnit = 1
)

def Camera "Left"
{
    float focalLength = 0.4
    float horizontalAperture = 0.36
    float verticalAperture = 0.27
    float fStop = 0.5
    float focusDistance = 3
    double3 xformOp:translate = (-0.3, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";

inline const Words blurred = {"--fstop", "0.5"};
inline const Words moving = {"--shutter", "1", "--time", "1"};
inline const Words threeBlades = {"--fstop", "0.5", "--blades", "3"};
inline const Words farFocus = {"--fstop", "0.5", "--focus-distance", "8"};
inline const Words nearFocus = {"--fstop", "0.5", "--focus-distance", "1"};
inline const Words nearRange = {"--fstop", "0.5", "--focus-distance", "1", "--focus-range-behind", "1"};

// Returns the options that the test cases of a method's settings need: the method and a wide aperture.
inline Words only(const char* method) {
    return {"--method", method, "--fstop", "0.5"};
}

}  // namespace option_cases

// Writes the files that the cases use: ball.glb, lamp.glb (the ball with a lamp), pane.glb (the ball in front of a
// pane), sky.hdr and half.png.
inline void writeOptionScene(const std::filesystem::path& folder) {
    GltfBuilder::save(folder / "ball.glb", option_cases::movingBall(false));
    GltfBuilder::save(folder / "lamp.glb", option_cases::movingBall(true));
    GltfBuilder::save(folder / "pane.glb", option_cases::movingBall(false, true));
    Image sky(8, 4, 3);
    for (std::size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = static_cast<float>(i % 7) * 0.3f;
    writeImage(folder / "sky.exr", sky);
    // Readers detect the format by the file's content, not its name.
    std::filesystem::rename(folder / "sky.exr", folder / "sky.hdr");
    Image half(8, 8, 1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 4; ++x) *half.at(x, y) = 1;
    writeImage(folder / "half.png", half);
    writeFile(folder / "shot.usda", std::string_view(option_cases::usdCamera));
}

// Returns the test cases of settings, keyed by the setting's name in the table of settings.
inline const std::map<std::string, OptionCase>& settingCases() {
    using namespace option_cases;
    static const std::map<std::string, OptionCase> table = {
        {"scene", {{"ball.glb"}, {}, true}},
        {"strict", {{"--strict"}, {}, true}},
        {"variant", {{"--variant", "Green"}, {"--samples", "32"}}},
        {"fishCount", {{"--fish", "3"}, {}, true}},
        {"trianglesPerFish", {{"--fish-triangles", "1500"}, {}, true}},
        {"units", {{"--units", "cm"}, {"--fstop", "0.5"}}},
        {"time", {{"--time", "1"}, {"--focus-auto"}}},
        {"clip", {{"--clip", "Still"}, {"--time", "1", "--focus-auto"}}},
        {"loop", {{"--loop"}, {"--time", "2.5", "--focus-auto"}}},
        {"shutter", {{"--shutter", "0.5"}, {"--time", "1"}}},
        {"shutterPosition", {{"--shutter-position", "start"}, moving}},
        {"motionSegments", {{"--motion-segments", "2"}, moving}},
        {"environment", {{"--environment", "sky.hdr"}, {}}},
        {"environmentRotation", {{"--environment-rotation", "90"}, {"--environment", "sky.hdr"}}},
        {"background", {{"--background", "none"}, {}}},
        {"ground", {{"--ground"}, {"--camera", "auto"}}},
        {"shadows", {{"--shadows", "off"}, {"--ground", "--camera", "auto"}}},
        {"multipleScattering", {{"--multiple-scattering"}, {}}},
        {"lightAngle", {{"--light-angle", "40"}, {"--ground", "--camera", "auto"}}},
        {"lightRadius", {{"--light-radius", "0.5"}, {"--ground", "--camera", "auto"}}},
        {"camera", {{"--camera", "Near"}, {}}},
        {"exrLayers", {{"--exr-layers", "depth"}, {"--fstop", "0.05", "--focus-distance", "1"}}},
        {"exrNames", {{"--exr-names", "blender"}, {"--exr-layers", "depth"}}},
        {"cameraFrom", {{"--camera-from", "shot.usda"}, {"--time", "1"}}},
        {"cameraPosition", {{"--camera-position", "0.5,0,0"}, {"--focus-auto"}}},
        {"cameraTarget", {{"--camera-target", "0.5,0,-3"}, {"--focus-auto"}}},
        {"cameraUp", {{"--camera-up", "1,1,0"}, {"--focus-auto"}}},
        {"size", {{"--size", "40x36"}, {}}},
        {"focalLength", {{"--focal-length", "70"}, {}}},
        {"fStop", {{"--fstop", "0.7"}, {"--focus-distance", "1"}}},
        {"focusDistance", {{"--focus-distance", "4"}, blurred}},
        {"focusNode", {{"--focus-node", "Board"}, blurred}},
        {"focusPixel", {{"--focus-pixel", "24,18"}, {"--fstop", "0.5", "--time", "1", "--camera", "Near"}}},
        {"focusPoints", {{"--focus-points", "10,16,24,18,26,8,30,20"}, blurred}},
        {"focusAuto", {{"--focus-auto"}, {"--fstop", "0.5", "--camera", "Near"}}},
        {"horizontalAperture", {{"--horizontal-aperture", "50"}, blurred}},
        {"dofEnabled", {{"--no-dof"}, blurred}},
        {"blurScale", {{"--blur-scale", "3"}, blurred}},
        {"focusBreathing", {{"--focus-breathing"}, {"--focus-distance", "0.2"}}},
        {"exposureTime", {{"--exposure-time", "1/20"}, {}}},
        {"iso", {{"--iso", "800"}, {"--exposure-time", "1/20"}}},
        {"bladeCount", {{"--blades", "3"}, blurred}},
        {"bladeRotation", {{"--blade-rotation", "30"}, threeBlades}},
        {"bladeCurvature", {{"--blade-curvature", "0.5"}, threeBlades}},
        {"anamorphicRatio", {{"--anamorphic-ratio", "2"}, blurred}},
        {"obstruction", {{"--obstruction", "0.5"}, blurred}},
        {"sphericalAberration", {{"--spherical-aberration", "0.8"}, blurred}},
        {"catEye", {{"--cat-eye", "0.8"}, blurred}},
        {"axialChromaticAberration", {{"--axial-chromatic-aberration", "0.3"}, blurred}},
        {"astigmatism", {{"--astigmatism", "1"}, blurred}},
        {"coma", {{"--coma", "1"}, blurred}},
        {"foregroundLimit", {{"--foreground-limit", "0"}, farFocus}},
        {"backgroundLimit", {{"--background-limit", "0"}, nearFocus}},
        {"focusRangeFront", {{"--focus-range-front", "1"}, farFocus}},
        {"focusRangeBehind", {{"--focus-range-behind", "5"}, nearFocus}},
        {"focusRangeRefocuses", {{"--focus-range-refocuses"}, nearRange}},
        {"focusTilt", {{"--focus-tilt", "40"}, blurred}},
        {"focusSwing", {{"--focus-swing", "40"}, blurred}},
        {"fieldCurvature", {{"--field-curvature", "2"}, blurred}},
        {"radialBlurGain", {{"--radial-blur-gain", "3"}, blurred}},
        {"nodeBlur", {{"--node-blur", "Board=0"}, nearFocus}},
        {"hide", {{"--hide", "Board"}, nearFocus}},
        {"apertureImage", {{"--aperture-image", "half.png"}, blurred}},
        {"samples", {{"--samples", "9"}, {}}},
        {"positions", {{"--positions", "4"}, {"--samples", "2"}}},
        {"quality", {{"--quality", "fine"}, {"--samples", "auto", "--fstop", "0.5"}}},
        {"targetError", {{"--target-error", "0.5"}, {"--samples", "256", "--fstop", "0.5"}}},
        {"timeLimit", {{"--time-limit", "0.001"}, {"--samples", "256", "--fstop", "0.5"}}},
        {"sequence", {{"--sequence", "r2"}, blurred}},
        {"seed", {{"--seed", "5"}, blurred}},
        {"lod", {{"--lod", "off"}, {"--fstop", "0.3"}, true, {"--lod", "fractional"}}},
        {"blurThreshold",
         {{"--blur-threshold", "0"}, {"--fstop", "0.1", "--size-threshold", "0", "--focus-distance", "0.5"}, true}},
        {"sizeThreshold", {{"--size-threshold", "0"}, {"--blur-threshold", "0"}, true}},
        {"lightThreshold", {{"--light-threshold", "0"}, {"--lod-metric", "measured", "--fstop", "0.3"}, true}},
        {"cacheFolder", {{"--cache-dir", "kept"}, {"--samples", "32"}, true}},
        {"noCache", {{"--no-cache"}, {"--samples", "32"}, true}},
        {"method", {{"--method", "circular"}, blurred}},
        {"layerFormat", {{"--layer-format", "rgba32f"}, {}, false, {"--layer-format", "rgba16f"}}},
        {"lodMetric", {{"--lod-metric", "error"}, {"--fstop", "0.3"}, true}},
        {"levelVertices", {{"--level-vertices", "surviving"}, {"--fstop", "0.3"}, true}},
        {"preset", {{"--preset", "jeong2011"}, {"--fstop", "0.3"}, true}},
        {"lodCoc",
         {{"--lod-coc", "centre"},
          {"--fstop", "0.5", "--focal-length", "1500", "--size-threshold", "0", "--blur-threshold", "30",
           "--focus-distance", "1.95"},
          true}},
        {"cocTolerance", {{"--coc-tolerance", "0.01"}, {"--fstop", "0.5", "--field-curvature", "2"}}},
        {"keepAll", {{"--keep-all"}, {"--focal-length", "1500", "--lod", "off"}, true}},
        {"wave", {{"--wave", "1"}, {}, true}},
        {"memory", {{"--memory", "3GiB"}, {}, true}},
        {"threads", {{"--threads", "3"}, {}, true, {}, true}},
        {"toneMap", {{"--tonemap", "agx"}, {}}},
        {"exposure", {{"--exposure", "1"}, {}}},
    };
    return table;
}

// Returns the test cases of method settings, keyed by the setting's name.
inline const std::map<std::string, OptionCase>& methodSettingCases() {
    using namespace option_cases;
    static const std::map<std::string, OptionCase> table = {
        {"near-components", {{"--near-components", "3"}, joined(only("circular"), {"--focus-distance", "8"})}},
        {"far-components", {{"--far-components", "4"}, joined(only("circular"), {"--focus-distance", "1"})}},
        {"resolution", {{"--resolution", "half"}, only("circular")}},
        {"kernel", {{"--kernel", "published"}, joined(only("circular"), {"--focus-distance", "1"})}},
        {"kernel-taps", {{"--kernel-taps", "eight"}, joined(only("circular"), {"--focus-distance", "1"})}},
        {"storage", {{"--storage", "float"}, only("circular")}},
        {"blend-bias", {{"--blend-bias", "3"}, joined(only("circular"), {"--focus-distance", "8"})}},
        {"near-field", {{"--near-field", "coverage"}, joined(only("circular"), {"--focus-distance", "8"})}},
        {"bias-by",
         {{"--bias-by", "luminance"}, joined(only("circular"), {"--focus-distance", "8", "--blend-bias", "3"})}},
        {"convolution", {{"--convolution", "direct"}, only("circular")}},
        {"transparency-buckets",
         {{"--transparency-buckets", "0"}, joined(only("circular"), {"--focus-distance", "1"})}},
        {"pinholes", {{"--pinholes", "1"}, only("circular")}},
        {"layers", {{"--layers", "1"}, {"--method", "layered", "--fstop", "0.1", "--focus-distance", "9"}}},
        {"resolve", {{"--resolve", "published"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"segments", {{"--segments", "2"}, joined(only("line"), {"--resolve", "published", "--focus-distance", "1"})}},
        {"shading-step", {{"--shading-step", "0"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"shading", {{"--shading", "vertices"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"wheel", {{"--wheel", "shared"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"interval-bits",
         {{"--interval-bits", "16"}, joined(only("line"), {"--resolve", "published", "--focus-distance", "1"})}},
        {"line-weights", {{"--line-weights", "length"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"lines-per-position", {{"--lines-per-position", "4"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"bin-size", {{"--bin-size", "1"}, joined(only("line"), {"--focus-distance", "1"})}},
        {"coc-interpolation", {{"--coc-interpolation", "linear"}, joined(only("line"), {"--field-curvature", "2"})}},
        {"coc", {{"--coc", "thin-lens"}, only("scheuermann")}},
        {"taps", {{"--taps", "24"}, only("scheuermann")}},
        {"multisampling", {{"--multisampling", "4"}, only("scheuermann")}},
        {"bits", {{"--bits", "8"}, only("scheuermann")}},
        {"near-blur-depth", {{"--near-blur-depth", "0.1"}, only("scheuermann")}},
        {"focal-plane-depth", {{"--focal-plane-depth", "1"}, only("scheuermann")}},
        {"far-blur-depth", {{"--far-blur-depth", "1000"}, only("scheuermann")}},
        {"blurriness-cutoff", {{"--blurriness-cutoff", "0.3"}, only("scheuermann")}},
        {"max-coc",
         {{"--max-coc", "unlimited"},
          {"--method", "scheuermann", "--coc", "thin-lens", "--fstop", "0.05", "--focus-distance", "1"}}},
    };
    return table;
}

// ---- the commands ---------------------------------------------------------------------------------------------------

// Returns the CLI::App of a command such as "bench speedup"; the object lives until the process ends.
inline const CLI::App& commandNamed(const std::string& names) {
    struct AllCommands {
        CLI::App app;
        GlobalOptions global;
        AllCommands() { addCommands(app, global); }
    };
    static AllCommands program;
    CLI::App* found = &program.app;
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find(' ', begin), names.size());
        found = found->get_subcommand(names.substr(begin, end - begin));
        begin = end + 1;
    }
    return *found;
}

// Returns an option's name as --help shows it: "--fstop", "SCENE", "-o".
inline std::string nameOf(const CLI::Option& option) {
    if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
    return option.get_single_name();
}

// Returns all options of a command except the options that print help.
inline std::vector<const CLI::Option*> optionsOffered(const std::string& command) {
    std::vector<const CLI::Option*> options = commandNamed(command).get_options();
    std::erase_if(options, [](const CLI::Option* option) { return nameOf(*option).starts_with("--help"); });
    return options;
}

// Returns the settings that a command offers from one group of the table of settings.
inline std::vector<const Setting*> settingsOffered(const std::string& command, SettingGroup group) {
    std::vector<const Setting*> offered;
    for (const CLI::Option* option : optionsOffered(command))
        if (const Setting* setting = settingOf(*option); setting != nullptr && setting->group == group)
            offered.push_back(setting);
    return offered;
}

// Returns the names of the method settings that a command offers.
inline Words methodSettingsOffered(const std::string& command) {
    Words names;
    for (const CLI::Option* option : optionsOffered(command))
        if (const MethodSetting* setting = methodSettingOf(*option)) names.push_back(setting->name);
    return names;
}

// A command, and the arguments that all of its tested command lines have in common.
struct CommandLine {
    std::string name;
    Words command;
    Words ball = {"ball.glb"};  // arguments that select the scene with the ball
    // arguments that select a scene of fish: options, or the name of a shot file
    Words fish = {"--fish", "1", "--fish-triangles", "900"};
    std::string size = "48x36";
    Words rest;
};

// Returns those options in `words` that the command accepts, each with its values.
inline Words taken(const std::string& command, const Words& words) {
    Words known;
    for (const CLI::Option* option : optionsOffered(command))
        if (settingOf(*option) != nullptr || methodSettingOf(*option) != nullptr) known.push_back(nameOf(*option));
    Words result;
    bool takes = false;
    for (const std::string& word : words) {
        if (word.starts_with("--")) takes = std::ranges::find(known, word) != known.end();
        if (takes) result.push_back(word);
    }
    return result;
}

// Returns the command line for the scene of a case, with or without the option under test.
inline Words lineOfCase(const CommandLine& given, const std::string& name, const OptionCase& tried, bool with) {
    Words line = given.command;
    const auto add = [&](const Words& words) { line.insert(line.end(), words.begin(), words.end()); };
    const bool shot = given.fish.size() == 1;
    if (name == "scene")
        add(with ? Words{} : given.fish);
    else if (name == "fishCount" && !shot)
        add(with ? Words{"--fish-triangles", "900"} : given.fish);
    else if (name == "trianglesPerFish" && !shot)
        add(with ? Words{"--fish", "1"} : given.fish);
    else
        add(tried.still ? given.fish : given.ball);
    if (!given.size.empty() && (name != "size" || !with)) add({"--size", given.size});
    add(taken(given.name, tried.with));
    add(with ? tried.words : tried.against);
    const bool ownSamples = std::ranges::find(line, "--samples") != line.end();
    for (std::size_t i = 0; i < given.rest.size(); ++i)
        if (ownSamples && given.rest[i] == "--samples")
            ++i;
        else
            line.push_back(given.rest[i]);
    // lightRadius needs the scene with the lamp; transparency-buckets needs the scene with the glass pane.
    const std::string scene = name == "lightRadius" ? "lamp" : name == "transparency-buckets" ? "pane" : "ball";
    for (std::string& word : line)
        if (word.starts_with("ball.")) word.replace(0, 4, scene);
    // The school of fish has no camera named "Near".
    if (std::ranges::find(line, "ball.glb") == line.end())
        std::ranges::replace(line, std::string("--camera=Near"), std::string("--camera=auto"));
    return line;
}

}  // namespace defocus::engine
