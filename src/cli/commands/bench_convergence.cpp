// defocus bench convergence: measures image error against render time.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands/bench_commands.h"
#include "cli/commands/bench_report.h"
#include "cli/options/method_list.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/message.h"
#include "eval/convergence/text.h"
#include "eval/convergence/unlit_scene.h"
#include "frame/settings/presets.h"
#include "frame/settings/settings.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "image/colour_map.h"
#include "image/image_io.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// Returns whether the program includes ray tracers. If so, `bench convergence` bakes the scene's lighting into unlit
// colours, because ray tracers and the rasterizer shade differently.
bool hasRayTracers() {
    return std::ranges::any_of(methods(), [](const Method& method) { return !method.needsGl; });
}

struct ConvergenceArguments {
    Request request = measuredRequest();
    bool unlit = hasRayTracers();
    ConvergenceOptions options;
    std::uint32_t referenceSamples = 4096;
    fs::path output;  // folder of the results; empty: `report`, or "convergence" if `report` is empty
    fs::path report;  // folder of the report; empty: no report
    bool resume = false;
    bool overwrite = false;
    bool allowChanged = false;
};

fs::path resultsFolder(const ConvergenceArguments& arguments) {
    if (!arguments.output.empty()) return arguments.output;
    return arguments.report.empty() ? "convergence" : arguments.report;
}

void makeFolders(const ConvergenceArguments& arguments) {
    const fs::path results = resultsFolder(arguments);
    refuseChangedSources(results, arguments.allowChanged);
    makeOutputFolder(results, {"results.csv", "results.json", "runs.csv", "reference.exr"});
    makeOutputFolder(results / "images", {"reference.png"});
    makeOutputFolder(arguments.report, {"index.html", "results.csv", "results.json"});
}

// Returns the hash of the reference image, the program, the device and the settings that affect the plan. All frames
// that one journal (runs.csv) records have the same hash.
std::uint64_t subjectHash(std::uint64_t reference, const BenchSubject& bench, const Request& request) {
    std::string text = fmt::format("{} {} {} {}", bench.program, bench.commit, bench.device, bench.driver);
    for (const Setting& setting : settings()) {
        const bool ofThePlan = setting.group == SettingGroup::samples || setting.group == SettingGroup::method ||
                               setting.group == SettingGroup::developer;
        if (ofThePlan) text += fmt::format(" {}={}", setting.name, setting.text(request).value_or(""));
    }
    return hashBytes(std::as_bytes(std::span(text)), reference);
}

// Returns the frames of an earlier run that this run continues. Throws Error, without changing any file, if this run
// would destroy frames or a reference in the folder.
std::vector<ConvergenceRun> earlierRuns(const ConvergenceArguments& arguments, std::uint64_t reference,
                                        std::uint64_t subject) {
    if (arguments.overwrite) return {};
    const fs::path folder = resultsFolder(arguments);
    const fs::path journal = folder / "runs.csv";
    std::vector<ConvergenceRun> runs;
    if (fs::exists(journal)) runs = readRunsCsv(readText(journal), subject, journal.string());
    if (!runs.empty() && !arguments.resume)
        fail("{} has {} frames from an earlier run; continue with --resume, or start over with --overwrite",
             journal.string(), runs.size());
    if (holdsOtherReference(folder, reference))
        fail(
            "the reference in {} was rendered with a different scene, camera, size, number of samples or build of the "
            "program; choose another folder, or start over with --overwrite",
            folder.string());
    return runs;
}

// The folder of the results. All result files are rewritten after each frame, so that a killed run loses no frame.
class ResultsFolder {
public:
    ResultsFolder(fs::path folder, const ReferenceImage& reference, ConvergenceSubject subject, std::uint64_t hash,
                  int seeds)
        : folder_(std::move(folder)), reference_(reference), subject_(std::move(subject)), hash_(hash), seeds_(seeds) {}

    // Continues an earlier run whose results are in `folder_`: keeps its frames and the commands that its results list.
    void resume(std::vector<ConvergenceRun> runs) {
        runs_ = std::move(runs);
        const fs::path results = folder_ / "results.json";
        if (!fs::exists(results)) return;
        const nlohmann::json document = nlohmann::json::parse(readText(results), nullptr, false);
        if (!document.is_object() || !document.contains("commands") || !document["commands"].is_array()) return;
        std::vector<std::string> commands;
        for (const nlohmann::json& command : document["commands"])
            if (command.is_string()) commands.push_back(command.get<std::string>());
        commands.insert(commands.end(), subject_.bench.commands.begin(), subject_.bench.commands.end());
        subject_.bench.commands = commands;
    }

    void add(const ConvergenceRun& run, const Image* image, const Image* flipMap) {
        if (image != nullptr) writeImage(folder_ / imageName(run.method, run.setting, run.asked), *image);
        if (flipMap != nullptr) {
            Image shown = *flipMap;
            for (float& value : shown.pixels) value /= errorMapFullScale;
            writeImage(folder_ / errorMapName(run.method, run.setting, run.asked), colourMapped(shown));
        }
        runs_.push_back(run);
        writeFile(folder_ / "runs.csv", runsCsv(runs_, hash_));
        writeResults(folder_);
    }

    void leaveOut(const ConvergenceCase& wanted, const std::string& reason) {
        subject_.leftOut.push_back({wanted.use.method->name, wanted.setting, reason});
    }

    void writeResults(const fs::path& folder) const {
        const std::vector<ConvergenceRow> all = rows();
        writeFile(folder / "results.csv", convergenceCsv(all));
        writeFile(folder / "results.json", convergenceJson(all, reference_, subject_));
    }

    [[nodiscard]] std::vector<ConvergenceRow> rows() const {
        return convergenceRows(runs_, reference_.remaining, seeds_);
    }

private:
    fs::path folder_;
    const ReferenceImage& reference_;
    ConvergenceSubject subject_;
    std::uint64_t hash_;
    int seeds_;
    std::vector<ConvergenceRun> runs_;
};

// Returns whether the options request `published`, a method with the settings of its paper. Two conditions must hold:
// the options list MethodForm::published, and they list either no methods or this method with default settings.
bool isAsked(const ConvergenceOptions& options, const MethodUse& published) {
    if (std::ranges::find(options.forms, MethodForm::published) == options.forms.end()) return false;
    return options.methods.empty() || std::ranges::any_of(options.methods, [&](const MethodUse& use) {
               return use.method == published.method && use.text() == use.method->name;
           });
}

// Returns the requested methods with the settings of their papers, taken from the presets. A method that draws levels
// of detail gets its own copy of `frame` in `frames`, with pyramids built for its settings. `frame` needs no pyramids.
std::vector<PublishedForm> publishedForms(const Request& scene, const PreparedFrame& frame,
                                          const ConvergenceOptions& options, std::deque<PreparedFrame>& frames,
                                          Progress& progress) {
    std::vector<PublishedForm> forms;
    for (const Preset& preset : presets()) {
        Request request = scene;
        applyPreset(preset, request);
        PublishedForm form{.preset = preset.name, .use = chosenMethod(request), .plan = renderSettings(request)};
        if (!isAsked(options, form.use)) continue;
        if (form.use.method->usesLensSamples && form.plan.lod != LodMode::off) {
            PreparedFrame& own = frames.emplace_back(frame);
            own.settings = form.plan;
            addPyramids(own, progress);
            form.world = &own.world;
            form.pyramidMilliseconds = own.pyramidMilliseconds;
        }
        forms.push_back(std::move(form));
    }
    return forms;
}

void runConvergence(const ConvergenceArguments& arguments, const GlobalOptions& global) {
    // Check scene, lens, device and folders first, because the measurements take a long time.
    Progress progress = terminalProgress(global);
    ConvergenceOptions options = arguments.options;
    Request scene = arguments.request;
    scene.noCache = true;  // build all pyramids, because the results include their build time
    const bool usesLevels = std::ranges::any_of(options.lods, [](LodMode mode) { return mode != LodMode::off; });
    if (!usesLevels) scene.lod = LodMode::off;
    PreparedFrame frame = placeFrame(scene, progress);
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    makeFolders(arguments);
    if (arguments.unlit) {
        *frame.scene = unlitScene(std::move(*frame.scene));
        frame.sceneName += ", unlit";
    }
    options.plan = frame.settings;
    options.renderer.layerFormat = scene.layerFormat;
    options.renderer.wave = scene.wave.value_or(0);
    options.renderer.shaderFolder = global.shaderDir;
    const ReferenceOptions referenceOptions = {arguments.referenceSamples, options.renderer, frame.settings.shadows};
    const std::uint64_t referenced = referenceHash(frame.world, frame.view, referenceOptions);
    // Runs with different numbers of seeds must not share a journal, so the hash includes the number of seeds.
    const std::array<std::uint64_t, 2> subjectAndSeeds = {
        subjectHash(referenced, benchSubject(*context, global), arguments.request),
        static_cast<std::uint64_t>(options.seeds)};
    const std::uint64_t hash = hashBytes(std::as_bytes(std::span(subjectAndSeeds)));
    const std::vector<ConvergenceRun> done = earlierRuns(arguments, referenced, hash);
    const fs::path folder = resultsFolder(arguments);
    if (arguments.overwrite) writeFile(folder / "runs.csv", runsCsv({}, hash));
    std::deque<PreparedFrame> publishedFrames;
    options.published = publishedForms(scene, frame, options, publishedFrames, progress);
    addPyramids(frame, progress);

    // Render the reference and choose the crops to show in the report.
    const ReferenceImage reference = referenceImage(frame.world, frame.view, referenceOptions, folder, progress);
    writeImage(folder / "images" / "reference.png", reference.image);
    ConvergenceSubject subject;
    subject.bench = benchSubject(*context, global, frame, options.runs);
    const std::uint32_t fewest = *std::ranges::min_element(options.sampleCounts);
    subject.crops = tellingCrops(frame.world, frame.view, reference, fewest, options.renderer);

    ResultsFolder results(folder, reference, subject, hash, options.seeds);
    if (arguments.resume) results.resume(done);
    fmt::print("{}, {} x {} px, {} runs each, on {}\n\n", subject.bench.scene, subject.bench.width,
               subject.bench.height, options.runs, subject.bench.device);
    std::fflush(stdout);
    const ConvergenceVisitor visitor = {
        [&](const ConvergenceRun& run, const Image* image, const Image* flipMap) { results.add(run, image, flipMap); },
        [&](const ConvergenceCase& wanted, const std::string& reason) {
            results.leaveOut(wanted, reason);
            if (!global.quiet) printMessage("warning: {} is left out: {}\n", wanted.use.text(), reason);
        }};
    measureConvergence(frame.world, frame.view, reference, options, frame.pyramidMilliseconds, done, visitor, progress);
    progress = {};

    results.writeResults(folder);
    const std::vector<ConvergenceRow> rows = results.rows();
    fmt::print("{}", convergenceHeader());
    for (const ConvergenceRow& row : rows) fmt::print("{}", convergenceLine(row));
    fmt::print("{}", convergenceSummary(rows, reference));
    if (!arguments.report.empty()) results.writeResults(arguments.report);
    drawReport(resultsFolder(arguments), arguments.report);
}

void addMeasurement(CLI::App& command, ConvergenceArguments& arguments) {
    const char* group = "Measurement";
    ConvergenceOptions& options = arguments.options;
    addParsed(command, "--methods", "NAME,NAME,…",
              "Methods to measure, with their settings, such as accumulation,circular:far-components=2. Accumulation "
              "at full detail is always included. Default: all methods",
              [&options](const std::string& text) { options.methods = parseMethods(text); })
        ->group(group);
    addList(command, "--rows", "published,best,default", options.forms,
            "Settings to measure for a method that is named without settings. published: the method's preset. best: "
            "the settings with the smallest error. default: the defaults",
            [](const std::string& part) {
                constexpr std::array forms = {MethodForm::published, MethodForm::best, MethodForm::defaults};
                return forms[parseChoice(part, {"published", "best", "default"})];
            })
        ->default_str("published,best,default")
        ->group(group);
    addIntegers(command, "--counts", options.sampleCounts, 1, maxSamples, "Numbers of lens samples to measure")
        ->group(group);
    addList(command, "--lod", "off,nearest,fractional,continuous", options.lods,
            "Level-of-detail modes to measure, for methods with levels",
            [](const std::string& part) {
                constexpr std::array modes = {LodMode::off, LodMode::nearest, LodMode::fractional, LodMode::continuous};
                return modes[parseChoice(part, {"off", "nearest", "fractional", "continuous"})];
            })
        ->default_str("off,fractional")
        ->group(group);
    addList(command, "--metrics", "size,error,measured,proportional,score", options.metrics,
            "Rules that choose the levels (see --lod-metric of render)",
            [](const std::string& part) {
                constexpr std::array metrics = {LodMetric::size, LodMetric::error, LodMetric::measured,
                                                LodMetric::proportional, LodMetric::score};
                return metrics[parseChoice(part, {"size", "error", "measured", "proportional", "score"})];
            })
        ->default_str("measured")
        ->group(group);
    addNumbers(command, "--threshold-factors", options.thresholdFactors, {0, 1000}, "F,F,…",
               "Multipliers for the default level-of-detail thresholds")
        ->group(group);
    addChoice<bool>(command, "--shading", arguments.unlit, {{"lit", false}, {"unlit", true}},
                    "Shading. lit: by the scene's lights. unlit: by light that is baked into the meshes, so that ray "
                    "tracers and the other methods shade surfaces identically. Default: unlit in defocus_bench, "
                    "because it has ray tracers, else lit")
        ->group(group);
    options.runs = 5;
    options.seeds = 5;
    addInteger(command, "--runs", options.runs, 1, 1000,
               "Number of runs of each method and setting; the median is reported")
        ->group(group);
    addInteger(command, "--seeds", options.seeds, 1, 1000,
               "Number of seeds, used in turn by the runs; the error is reported as mean, minimum and maximum")
        ->group(group);
    addInteger(command, "--reference-samples", arguments.referenceSamples, 2, maxSamples,
               "Number of lens samples of the reference, which is stored beside the results and reused")
        ->group(group);
}

void addOutput(CLI::App& command, ConvergenceArguments& arguments) {
    const char* group = "Output";
    command
        .add_option("-o,--output", arguments.output,
                    "Folder for results.csv, results.json, runs.csv, reference.exr and images. Default: the folder of "
                    "--report, else convergence")
        ->type_name("FOLDER")
        ->group(group);
    CLI::Option* resume =
        command
            .add_flag("--resume", arguments.resume, "Measure only the runs that are missing from the folder's runs.csv")
            ->group(group);
    command
        .add_flag("--overwrite", arguments.overwrite,
                  "Delete the frames and the reference of an earlier run from the folder, and start over")
        ->excludes(resume)
        ->group(group);
    command
        .add_option("--report", arguments.report,
                    "Folder for index.html with plots, tables and images (requires python3-matplotlib)")
        ->type_name("FOLDER")
        ->group(group);
    addAllowChanged(command, arguments.allowChanged);
}

}  // namespace

void addConvergenceCommand(CLI::App& bench, const GlobalOptions& global) {
    auto arguments = std::make_shared<ConvergenceArguments>();
    CLI::App* command = bench.add_subcommand(
        "convergence",
        "Measure how the error of methods and settings, relative to a reference, decreases with run "
        "time");
    // Leave out settings that the benchmark varies itself, and exposure, because images are compared at EV 0.
    addSettings(*command, arguments->request,
                settingsOf(frameGroups, {"preset", "samples", "positions", "quality", "targetError", "timeLimit", "lod",
                                         "blurThreshold", "sizeThreshold", "lightThreshold", "method", "cacheFolder",
                                         "noCache", "exposureTime", "iso"}));
    addMeasurement(*command, *arguments);
    addOutput(*command, *arguments);
    addDeveloperSettings(*command, arguments->request, {"lodMetric", "memory", "threads"});
    command->footer(
        "Examples:\n"
        "  defocus bench convergence scene.glb --report report\n"
        "  defocus bench convergence --size 512x384 --reference-samples 1024 --counts 8,32,128 -o fish\n"
        "  defocus bench convergence --size 512x384 --reference-samples 1024 --counts 8,32,128 -o fish --resume");
    command->callback([arguments, &global] { runConvergence(*arguments, global); });
}

}  // namespace defocus::engine
