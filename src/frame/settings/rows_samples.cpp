// Defines the settings of lens samples and levels of detail.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <utility>

#include "core/error.h"
#include "frame/settings/conditions.h"
#include "frame/settings/presets.h"
#include "frame/settings/rows.h"
#include "lens/lens_samples.h"
#include "lod/pyramid/level_selection.h"
#include "plan/frame_plan.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

namespace {

// Returns the row of the setting "preset", which stores no value; see presets.h. This row precedes the rows of all
// settings that a preset sets, so that options given explicitly override the preset.
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
    return rows::integer(
               "samples", "--samples", 1, maxSamples, MEMBER(samples),
               fmt::format("Number of lens samples. If the image has no visible blur, no motion and no shadows, at "
                           "most {} are drawn, unless --keep-all is given. auto: the number that --quality needs, at "
                           "most {}. With --target-error, or if a single image has a --time-limit, this option sets "
                           "the maximum number; default: {}",
                           antialiasingSamples, maxAutomaticSamples, maxSamples))
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

Row positionsRow() {
    return rows::integer("positions", "--positions", 1, 4, MEMBER(positions),
                         "Number of positions in each pixel at which a lens sample draws the scene: 1, or 4 (a 2 x 2 "
                         "grid). 4 positions smooth edges like 2 to 4 times as many samples. auto: 4 for a still image "
                         "with little blur of a scene with many triangles, if --samples and --method are auto; else 1")
        .metavar("1|4|auto")
        .choices({"auto"})
        .values(
            [](Request& request, const std::string& text) {
                if (text != "auto" && text != "1" && text != "4") fail("'{}' is not 1 or 4", text);
                request.positions =
                    text == "auto" ? std::nullopt : std::optional(static_cast<std::uint32_t>(text.front() - '0'));
            },
            [](const Request& request) -> std::optional<std::string> {
                return request.positions ? fmt::format("{}", *request.positions) : "auto";
            });
}

}  // namespace

Rows sampleRows() {
    std::vector<std::pair<std::string, Sequence>> sequences;
    for (const Sequence sequence : allSequences) sequences.emplace_back(sequenceName(sequence), sequence);
    std::vector<std::pair<std::string, std::optional<LodMode>>> modes = {{"auto", std::nullopt}};
    for (const auto& [name, mode] : rows::named(lodModeName, LodMode::off)) modes.emplace_back(name, mode);
    return {
        presetRow().inShot("/preset"),
        samplesRow().everyday().example("64").inShot("/samples").unused([](const SettingContext& context) {
            // With levels of detail, the number of samples has an effect in every method, because it determines the
            // levels.
            return context.request.lod == LodMode::off ? methodWithoutSamples(context) : std::string();
        }),
        positionsRow().inShot("/positions").unused(methodWithoutPositions),
        rows::choice<Quality>("quality", "--quality",
                              {{"draft", Quality::draft}, {"good", Quality::good}, {"fine", Quality::fine}},
                              MEMBER(quality),
                              "Quality for --samples auto, as the perceived difference (FLIP) from an image without "
                              "noise: about 0.03 (draft), 0.01 (good) or 0.005 (fine)")
            .everyday()
            .inShot("/quality")
            .excludes({"targetError", "timeLimit"})
            .unused([](const SettingContext& context) {
                return firstOf(context, {methodWithoutSamples, withFixedSamples});
            }),
        rows::number("targetError", "--target-error", "R", 1e-6, 1, MEMBER(targetError),
                     "Add blocks of 64 samples until the estimated error is below this value. The error is the RMSE "
                     "of the display-encoded image (values from 0 to 1, exposure 0 EV)")
            .example("0.003")
            .inShot("/targetError"),
        rows::number("timeLimit", "--time-limit", "S", 1e-3, 1e6, MEMBER(timeLimit),
                     "Time in s during which blocks of 64 samples are added; ends early if --target-error is reached. "
                     "The time to load the scene does not count. With 'defocus capture', the limit is for the whole "
                     "film: no further frame is started after this time")
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
        rows::choice<std::optional<LodMode>>(
            "lod", "--lod", modes, MEMBER(lod),
            "Levels of detail of blurred objects. nearest: one level per object. fractional: the "
            "lens samples are divided between two levels. continuous (the default of 'defocus capture'): like "
            "fractional, but one sample draws both levels, each in a part of its pixels, for smoother transitions. "
            "off: "
            "full detail. auto: fractional, but off for a still image with --samples auto if building the levels would "
            "take more time than they save")
            .inShot("/lod"),
        rows::number("blurThreshold", "--blur-threshold", "K", 0, 1e3, MEMBER(blurThreshold),
                     "Strength of the simplification of blurred objects; larger values are coarser and faster. Selects "
                     "--lod-metric size unless another metric is given. With size or score: permitted length of "
                     "triangle edges, as a multiple of the blur diameter. With error: permitted error, as a multiple "
                     "of the blur diameter. With proportional: level of an object whose blur is as large as its "
                     "bounding box. With measured: no effect. Default: 10 for proportional, else depends on the number "
                     "of samples")
            .example("0.2")
            .inShot("/blurThreshold")
            .unused(withoutLevels),
        rows::number(
            "sizeThreshold", "--size-threshold", "K", 0, 1e6, MEMBER(sizeThreshold),
            "Permitted length of triangle edges (--lod-metric size) or permitted error (--lod-metric error), in px, "
            "for objects without blur. Default: depends on the number of samples")
            .unit("px")
            .example("1")
            .inShot("/sizeThreshold")
            .unused(withoutLevels),
        rows::number(
            "lightThreshold", "--light-threshold", "K", 0, 1e3, MEMBER(lightThreshold),
            "With --lod-metric measured: maximum error of a level of detail; larger values are coarser and faster. The "
            "error is the change of brightness after blurring, relative to the contrast of the surface, times the "
            "length of the level's triangle edges in px (docs/reference.md has the formula). Default: depends on the "
            "number of samples")
            .unit("px")
            .example("0.1")
            .inShot("/lightThreshold")
            .unused(withoutLevels),
        rows::words(SettingKind::path, "cacheFolder", "--cache-dir", "FOLDER", MEMBER(cacheFolder),
                    "Folder for cached simplified meshes. Default: $XDG_CACHE_HOME/defocus, else ~/.cache/defocus")
            .effect(SettingEffect::run),
        rows::boolean("noCache", "--no-cache", MEMBER(noCache), "Neither read nor write the cache of simplified meshes")
            .excludes({"cacheFolder"})
            .effect(SettingEffect::run),
    };
}

}  // namespace defocus::engine
