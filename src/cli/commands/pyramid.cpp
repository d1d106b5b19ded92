// defocus pyramid: prints and exports the levels of each mesh, and measures their distance from the original mesh.

#include "lod/pyramid/pyramid.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/commands/level_export.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "core/suggestion.h"
#include "frame/report/json_values.h"
#include "frame/report/plan_report.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "lod/pyramid/cache.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/surface_distance.h"
#include "scene/gltf/write.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct PyramidArguments {
    Request request;        // only the request's scene and levelVertices are used
    std::string mesh;       // name of the mesh; empty: all meshes
    fs::path exportFolder;  // folder for exported levels; empty: no export
    fs::path cacheFolder;   // cache of pyramids; empty: no cache
    std::size_t points = 16'384;
    bool noMeasure = false;
    bool json = false;
};

struct LevelReport {
    std::optional<SurfaceDistance> measured;  // two-sided distance to level 0; nullopt for level 0 itself
    fs::path file;                            // exported file; empty: not exported
};

struct MeshReport {
    std::size_t mesh = 0;  // index into Scene::meshes
    Pyramid pyramid;
    std::optional<double> seconds;  // build time, s; nullopt if read from the cache
    std::vector<LevelReport> levels;
};

// Returns the mesh's name as `defocus info` prints it.
std::string shownName(const Scene& scene, std::size_t mesh) {
    return scene.meshes[mesh].name.empty() ? fmt::format("(mesh {})", mesh) : scene.meshes[mesh].name;
}

std::vector<MeshReport> chooseMeshes(const Scene& scene, const std::string& name) {
    std::vector<MeshReport> chosen;
    std::vector<std::string> names;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        names.push_back(shownName(scene, m));
    }
    const auto named = placeOfName(name, names);
    for (std::size_t m = 0; m < names.size(); ++m)
        if (name.empty() || (named && names[m] == names[*named])) chosen.emplace_back().mesh = m;
    if (named || name.empty()) return chosen;
    const std::string nearest = nearestWord(name, names);
    if (!nearest.empty()) fail("there is no mesh '{}'; did you mean '{}'?", name, nearest);
    fail("there is no mesh '{}' among the {} meshes that 'defocus info' lists", name, names.size());
}

// ---- building and measuring pyramids ------------------------------------------------------------

// Builds or loads the pyramids of the chosen meshes. Returns the reason if a pyramid couldn't be stored; empty
// otherwise.
std::string buildAll(const Scene& scene, const fs::path& folder, const PyramidOptions& options,
                     std::vector<MeshReport>& reports, const Progress& progress) {
    std::vector<Mesh> meshes;
    for (const MeshReport& report : reports) meshes.push_back(scene.meshes[report.mesh]);
    CachedPyramids cached = cachedPyramids(meshes, folder, options, progress);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        reports[i].pyramid = std::move(cached.pyramids[i]);
        reports[i].seconds = cached.seconds[i];
        reports[i].levels.resize(reports[i].pyramid.levels.size());
    }
    return cached.failure;
}

Surface surfaceOf(const Pyramid& pyramid, std::size_t level) {
    std::vector<std::uint32_t> indices;
    for (const IndexRange& range : pyramid.levels[level].primitives) {
        const auto first = pyramid.indices.begin() + static_cast<std::ptrdiff_t>(range.first);
        indices.insert(indices.end(), first, first + static_cast<std::ptrdiff_t>(range.count));
    }
    return prepareSurface(pyramid.levels[level].positions, indices);
}

void measureAll(std::vector<MeshReport>& reports, std::size_t points, const Progress& progress) {
    struct Job {
        MeshReport* report;
        const Surface* mesh;
        std::size_t level;
    };
    std::vector<Surface> surfaces(reports.size());
    parallelFor(reports.size(), [&](std::size_t i) { surfaces[i] = surfaceOf(reports[i].pyramid, 0); });
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < reports.size(); ++i)
        for (std::size_t l = 1; l < reports[i].levels.size(); ++l) jobs.push_back({&reports[i], &surfaces[i], l});

    std::mutex mutex;
    std::uint64_t done = 0;
    parallelFor(jobs.size(), [&](std::size_t j) {
        const Job& job = jobs[j];
        job.report->levels[job.level].measured =
            surfaceDistance(*job.mesh, surfaceOf(job.report->pyramid, job.level), points);
        const std::scoped_lock lock(mutex);
        report(progress, "measuring", ++done, jobs.size());
    });
}

// ---- export of levels to files ------------------------------------------------------------------

// Writes all levels to files and returns the number of files. Levels without triangles are skipped.
std::size_t exportAll(const Scene& scene, std::vector<MeshReport>& reports, const fs::path& folder,
                      const std::vector<std::string>& stems) {
    std::size_t files = 0;
    for (MeshReport& report : reports)
        for (std::size_t l = 0; l < report.levels.size(); ++l) {
            if (report.pyramid.levels[l].triangleCount == 0) continue;
            report.levels[l].file = levelFile(folder, stems[report.mesh], l);
            writeGlb(report.levels[l].file, levelMesh(report.pyramid, l, shownName(scene, report.mesh)));
            ++files;
        }
    return files;
}

// ---- printed report -----------------------------------------------------------------------------

Json distancesJson(const Distances& distances) {
    return {{"mean", distances.mean}, {"percentile99", distances.percentile99}, {"maximum", distances.maximum}};
}

// Adds a level's measured distances and its exported file to the level's JSON.
void addReport(Json& json, const LevelReport& report) {
    if (report.measured) {
        json["measured"] = distancesJson(report.measured->both);
        json["measured"]["fromLevel0"] = distancesJson(report.measured->forward);
        json["measured"]["toLevel0"] = distancesJson(report.measured->backward);
    }
    if (!report.file.empty()) json["file"] = report.file.string();
}

Json reportJson(const PyramidArguments& arguments, const Scene& scene, const std::vector<MeshReport>& reports) {
    Json json = {{"file", arguments.request.scene}};
    if (!arguments.noMeasure) json["points"] = arguments.points;
    json["meshes"] = Json::array();
    for (const MeshReport& report : reports) {
        Json mesh = jsonOf(reportedPyramid(report.pyramid, scene.meshes[report.mesh].name, report.mesh));
        mesh["buildSeconds"] = report.seconds ? Json(*report.seconds) : Json();
        for (std::size_t l = 0; l < report.levels.size(); ++l) addReport(mesh["levels"][l], report.levels[l]);
        json["meshes"].push_back(std::move(mesh));
    }
    return json;
}

// Returns a string such as "0.52 s" or "3.1 ms".
std::string timeText(double seconds) {
    return seconds >= 0.1 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.1f} ms", 1000 * seconds);
}

void printLevels(const MeshReport& report) {
    const bool measured = report.levels.back().measured.has_value();
    if (measured) fmt::print("{:>60}  {:>34}\n", "stored", "measured distance to level 0");
    fmt::print("{:>7}  {:>12}  {:>11}  {:>12}  {:>10}", "level", "triangles", "vertices", "mean edge", "error");
    fmt::print("{}\n", measured ? fmt::format("  {:>10}  {:>10}  {:>10}", "mean", "99 %", "max") : "");
    for (std::size_t l = 0; l < report.levels.size(); ++l) {
        const PyramidLevel& level = report.pyramid.levels[l];
        fmt::print("{:>7}  {:>12}  {:>11}  {:>12.4g}  {:>10.3g}", l, grouped(level.triangleCount),
                   grouped(level.vertexCount), level.meanEdge, level.error);
        if (const auto& d = report.levels[l].measured)
            fmt::print("  {:>10.3g}  {:>10.3g}  {:>10.3g}", d->both.mean, d->both.percentile99, d->both.maximum);
        fmt::print("\n");
    }
}

void printReport(const Scene& scene, const std::vector<MeshReport>& reports) {
    if (reports.empty()) fmt::print("the scene has no meshes\n");
    for (const MeshReport& report : reports) {
        const Pyramid& pyramid = report.pyramid;
        if (&report != &reports.front()) fmt::print("\n");
        fmt::print("{}: {} triangle{}, box diagonal {:.4g}", shownName(scene, report.mesh),
                   grouped(pyramid.levels[0].triangleCount), pyramid.levels[0].triangleCount == 1 ? "" : "s",
                   glm::length(pyramid.bounds.size()));
        fmt::print("; {} {}",
                   report.levels.size() == 1 ? "one level only" : fmt::format("{} levels", report.levels.size()),
                   report.seconds ? "in " + timeText(*report.seconds) : "from the cache");
        if (pyramid.repairedFaces > 0)
            fmt::print("; {} face{} repaired", grouped(pyramid.repairedFaces), pyramid.repairedFaces == 1 ? "" : "s");
        fmt::print("\n");
        if (report.levels.size() > 1) printLevels(report);
        fmt::print("  no further level: {}\n", endReason(pyramid.end));
    }
}

void runPyramid(const PyramidArguments& arguments, const GlobalOptions& global) {
    const Progress progress = terminalProgress(global);
    const Scene scene = loadScene(arguments.request, progress);
    std::vector<MeshReport> reports = chooseMeshes(scene, arguments.mesh);
    const std::vector<std::string> stems = fileStems(scene);
    if (!arguments.exportFolder.empty() && !reports.empty())
        prepareFolder(arguments.exportFolder, levelFile(arguments.exportFolder, stems[reports.front().mesh], 0));

    WarningPrinter(global).print(damageWarnings(scene));
    PyramidOptions options;
    options.vertices = arguments.request.levelVertices;
    const Finishes finishes(scene);
    options.finishes = &finishes;
    if (const std::string failure = buildAll(scene, arguments.cacheFolder, options, reports, progress);
        !failure.empty())
        WarningPrinter(global).print({"a pyramid could not be cached: " + failure});
    if (!arguments.noMeasure) measureAll(reports, arguments.points, progress);
    std::size_t files = 0;
    if (!arguments.exportFolder.empty()) files = exportAll(scene, reports, arguments.exportFolder, stems);

    if (arguments.json) {
        fmt::print("{}", documentText(reportJson(arguments, scene, reports)));
    } else {
        printReport(scene, reports);
        if (!arguments.exportFolder.empty())
            fmt::print("\n{} file{} in {}\n", files, files == 1 ? "" : "s", arguments.exportFolder.string());
    }
    std::fflush(stdout);
}

}  // namespace

void addPyramidCommand(CLI::App& program, const GlobalOptions& global) {
    auto arguments = std::make_shared<PyramidArguments>();
    CLI::App* command =
        program.add_subcommand("pyramid", "Simplify each mesh, and print its levels of detail and their errors");
    addSettings(*command, arguments->request, sceneSettings);
    command
        ->add_option("--mesh", arguments->mesh, "Mesh to simplify, by its name in 'defocus info'. Default: all meshes")
        ->type_name("NAME");
    CLI::Option* points = advanced(addInteger(
        *command, "--points", arguments->points, 100, 100'000'000,
        "Number of points on each level and on the full mesh at which the distance between the two is measured"));
    command
        ->add_flag("--no-measure", arguments->noMeasure,
                   "Do not measure the distances between the levels and the full mesh; measuring takes most of the "
                   "time")
        ->excludes(points);
    command->add_option("--export", arguments->exportFolder, "Folder to which each level is written as a .glb file")
        ->type_name("FOLDER");
    command
        ->add_option("--cache-dir", arguments->cacheFolder,
                     "Folder from which levels are read and in which they are stored. Default: none; all levels are "
                     "built")
        ->type_name("FOLDER");
    command->add_flag(
        "--json", arguments->json,
        "Print JSON, with the distances from each level to the full mesh and from the full mesh to each level");
    addSettings(*command, arguments->request, {"levelVertices"});
    command->footer(
        "Lengths are in the units of the mesh. The error of a level is an upper bound on the 99th percentile of its\n"
        "distances to level 0. Distances are computed in both directions, from the level to level 0 and back; the\n"
        "larger value is printed.\n"
        "\n"
        "Example:\n"
        "  defocus pyramid scene.glb --mesh Body --export levels");
    command->callback([arguments, &global] { runPyramid(*arguments, global); });
}

}  // namespace defocus::engine
