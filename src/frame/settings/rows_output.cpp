// Defines the settings of the method and of the display, and the settings for developers.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/memory_limits.h"
#include "core/parse.h"
#include "frame/layer_names.h"
#include "frame/settings/conditions.h"
#include "frame/settings/rows.h"

namespace defocus::engine {

namespace {

// Each set… function parses the text of a value. If the text is invalid, it throws Error with the allowed values in its
// message. Each …Text function returns nullopt if the value is unset.

// Sets the method. Method settings that the text does not contain are reset to their defaults.
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

// Sets the layers, in the order of the enumeration and without repetition. "all" names all layers.
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

}  // namespace

Rows methodRows() {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    return {
        rows::other("method", "--method", "NAME", setMethod, methodText,
                    fmt::format("Rendering method: {}. auto: multirate if at least 1 % of the image is blurred by 8 px "
                                "or more, else accumulation. NAME:SETTING=VALUE,… also sets the method's settings. "
                                "docs/methods.md explains the methods",
                                fmt::join(names, ", ")))
            .clears(clearMethod)
            .everyday()
            .inShot("/method"),
        rows::choice<LayerFormat>("layerFormat", "--layer-format", rows::named(layerFormatName, LayerFormat::rgba32f),
                                  MEMBER(layerFormat),
                                  "Pixel format of the image rendered for each lens sample, before accumulation. "
                                  "automatic: rgba32f if the radiance may exceed the range of rgba16f, else rgba16f. "
                                  "Use rgba32f for reference images")
            .inShot("/layerFormat"),
    };
}

Rows displayRows() {
    return {
        rows::other(
            "exrLayers", "--exr-layers", "LAYER,…", setLayers, layersText,
            "Data layers to add to .exr files: depth (mean and nearest, in m), position, normal, albedo, emission, "
            "motion (in px, from the shutter's opening to its closing), coc (in px), objects and materials "
            "(Cryptomatte). all: all of these. The layers have the lens blur of the image and are premultiplied by "
            "the coverage of the surfaces")
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
            "Exposure in EV for PNG, JPEG and video. auto: metered from the scene; a film is metered once, in its "
            "first frame. Default: from --exposure-time if given, else auto for scenes with lights, else 0")
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

Rows developerRows() {
    return {
        rows::choice<LodMetric>(
            "lodMetric", "--lod-metric", rows::named(lodMetricName, LodMetric::score), MEMBER(lodMetric),
            "Rule that chooses the levels of detail. measured: by the error that remains after the blur, measured "
            "when the levels are built (most accurate). size: by the length of triangle edges in the image. error: by "
            "the distance in the image, in px, between the simplified surface and the full mesh. proportional: by the "
            "ratio of blur to the size of the object's bounding box (Jeong et al. 2011). score: by the ratio of blur "
            "to edge length (Tzeng et al. 2012). automatic: size if --blur-threshold or --size-threshold is given, "
            "else measured")
            .inShot("/lodMetric")
            .unused(withoutLevels),
        rows::choice<LevelVertices>(
            "levelVertices", "--level-vertices", rows::named(levelVerticesName, LevelVertices::quarters),
            MEMBER(levelVertices),
            "How the vertices of a level of detail are made. fitted: moved to match the original surface as closely as "
            "possible. surviving: a subset of the original vertices, unchanged. quarters: like surviving, but with "
            "only three levels: the full mesh, and 75 and 50 % of its vertices")
            .inShot("/levelVertices")
            .unused(withoutLevels),
        rows::choice<LodCoc>("lodCoc", "--lod-coc", {{"smallest", LodCoc::smallest}, {"centre", LodCoc::centre}},
                             MEMBER(lodCoc),
                             "Blur that decides an object's level: the smallest within its bounding box "
                             "(conservative), or the blur at the box's centre (coarser and faster)")
            .unused([](const SettingContext& context) {
                return firstOf(context, {methodWithoutSamples, withoutLevels, withMeasuredLevels});
            }),
        rows::number("cocTolerance", "--coc-tolerance", "PX", 1e-3, 1e3, MEMBER(cocTolerance),
                     "Maximum error, in px, of interpolating the blur across a triangle; triangles with a larger error "
                     "are subdivided")
            .unit("px")
            .unused(methodWithoutSamples),
        rows::boolean("keepAll", "--keep-all", MEMBER(keepAll),
                      "Turn off two shortcuts. Objects and triangles that no lens sample sees are drawn, too (slower, "
                      "same image). All lens samples are drawn even without visible blur, motion or shadows (changes "
                      "the image slightly)")
            .effect(SettingEffect::run),
        rows::other(
            "memory", "--memory", "SIZE",
            [](Request& request, const std::string& text) { request.memory = parseBytes(text); },
            [](const Request& request) -> std::optional<std::string> {
                if (!request.memory) return std::nullopt;
                return fmt::format("{}B", *request.memory);
            },
            "Maximum memory that the program may use, such as 2GiB. With less memory, it draws fewer samples at once, "
            "or the image in tiles; neither changes the image if --samples is given. However, --memory makes --method "
            "auto choose accumulation, because multirate cannot draw tiles. Default: three quarters of the free memory")
            .clears(MEMBER(memory))
            .effect(SettingEffect::run),
        rows::integer(
            "wave", "--wave", 1, 64, MEMBER(wave),
            "Maximum number of samples that all threads together draw at once; does not affect the image. Default: as "
            "many as fit into memory, at most 16 for each thread")
            .effect(SettingEffect::run),
        rows::integer(
            "threads", "--threads", 1, 64, MEMBER(threads),
            "Number of threads that draw lens samples at the same time, each with an OpenGL context of its "
            "own; does not affect the image. Default: half of the cores with llvmpipe of Mesa 25.0 or later, else 1")
            .effect(SettingEffect::run)
            .unused(methodWithoutThreads),
    };
}

}  // namespace defocus::engine
