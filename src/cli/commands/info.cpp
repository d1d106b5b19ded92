// defocus info: prints the contents of a scene file, and which parts are ignored and why.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/commands/camera_report.h"
#include "cli/options/option_text.h"
#include "cli/options/request_options.h"
#include "core/message.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "frame/report/json_values.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "lens/lens_fields.h"
#include "lod/simplify/manifold.h"
#include "scene/gltf/gltf.h"
#include "scene/pose.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    bool json = false;
    std::string camera;  // empty: print the file's contents; else print camera data ("true" or a camera's name)
    Request seen;        // settings that select the scene; all other values are used only with --camera
    CameraQuestion question;
};

constexpr std::size_t meshesListed = 12;  // maximum number of meshes in text output; --json lists all
const std::string flagOnly = "true";      // CLI11's value for --camera without a name
constexpr double degrees = 57.295779513082321;

// Returns `name`, or a placeholder such as "(mesh 3)" if the name is empty.
std::string nameOr(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("({} {})", kind, index) : name;
}

std::vector<std::size_t> objectsPerMesh(const Scene& scene, const Pose& pose) {
    std::vector<std::size_t> counts(scene.meshes.size());
    for (const Object& object : pose.objects) ++counts[static_cast<std::size_t>(object.mesh)];
    return counts;
}

std::vector<std::string> attributesOf(const Vertices& vertices) {
    std::vector<std::string> names;
    if (!vertices.normals.empty()) names.emplace_back("normals");
    if (!vertices.tangents.empty()) names.emplace_back("tangents");
    if (!vertices.uv0.empty()) names.emplace_back("uv0");
    if (!vertices.uv1.empty()) names.emplace_back("uv1");
    if (!vertices.colors.empty()) names.emplace_back("colors");
    if (!vertices.joints.empty()) names.emplace_back("joints");
    return names;
}

const char* typeName(LightType type) {
    if (type == LightType::point) return "point";
    return type == LightType::spot ? "spot" : "directional";
}

const char* alphaName(AlphaMode mode) {
    if (mode == AlphaMode::mask) return "mask";
    return mode == AlphaMode::blend ? "blend" : "opaque";
}

struct Totals {
    std::uint64_t triangles = 0;         // number of triangles of all meshes
    std::uint64_t trianglesInScene = 0;  // number of triangles of all objects of the scene
    std::uint64_t vertices = 0;
    std::uint64_t points = 0;
    std::uint64_t lines = 0;  // number of line segments
};

Totals totalsOf(const Scene& scene, const std::vector<std::size_t>& objects) {
    Totals totals;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        totals.triangles += scene.meshes[i].triangleCount();
        totals.trianglesInScene += objects[i] * scene.meshes[i].triangleCount();
        totals.vertices += scene.meshes[i].vertices.count();
        for (const Strokes& strokes : scene.meshes[i].strokes)
            (strokes.points ? totals.points : totals.lines) += strokes.indices.size() / (strokes.points ? 1 : 2);
    }
    return totals;
}

// Returns the repairs that each mesh needed, by mesh index.
std::vector<Repairs> allRepairs(const Scene& scene) {
    std::vector<Repairs> repairs(scene.meshes.size());
    parallelFor(repairs.size(), [&](std::size_t m) { repairs[m] = repairsOf(scene.meshes[m]); });
    return repairs;
}

// ---- JSON output --------------------------------------------------------------------------------

Json meshJson(const Mesh& mesh, const Repairs& repairs, std::size_t objects) {
    return {{"name", mesh.name},
            {"triangles", mesh.triangleCount()},
            {"vertices", mesh.vertices.count()},
            {"primitives", mesh.primitives.size()},
            {"objects", objects},
            {"attributes", attributesOf(mesh.vertices)},
            {"repairedFaces",
             {{"all", repairs.faces},
              {"dropped", repairs.dropped},
              {"turned", repairs.turned},
              {"cut", repairs.cut},
              {"split", repairs.split}}},
            {"morphTargets", mesh.morphTargets.size()}};
}

Json cameraJson(const Camera& camera) {
    Json json = {{"name", camera.name}, {"usable", !camera.orthographic}};
    if (camera.orthographic) {
        json["reason"] = *camera.orthographic;
        return json;
    }
    json["yfovDegrees"] = camera.yfov * degrees;
    if (camera.aspectRatio) json["aspectRatio"] = *camera.aspectRatio;
    for (const auto& [name, value] : camera.lens)
        if (lensFieldNamed(name) != nullptr) json[name] = value;
    return json;
}

Json sceneJson(const InfoOptions& options, const Scene& scene, const Pose& pose) {
    const std::vector<std::size_t> objects = objectsPerMesh(scene, pose);
    const Totals totals = totalsOf(scene, objects);
    const std::vector<Repairs> repairs = allRepairs(scene);
    Json json = {{"file", options.seen.scene.string()},
                 {"name", scene.name},
                 {"triangles", totals.triangles},
                 {"trianglesInScene", totals.trianglesInScene},
                 {"vertices", totals.vertices},
                 {"objects", pose.objects.size()},
                 {"points", totals.points},
                 {"lines", totals.lines},
                 {"nodes", scene.nodes.size()}};
    if (!pose.bounds.empty()) {
        const auto vector = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
        json["bounds"] = {{"minimum", vector(pose.bounds.minimum)}, {"maximum", vector(pose.bounds.maximum)}};
    }
    for (const char* list :
         {"meshes", "materials", "textures", "cameras", "lights", "clips", "skins", "extensions", "ignored"})
        json[list] = Json::array();
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        json["meshes"].push_back(meshJson(scene.meshes[i], repairs[i], objects[i]));
    for (const Material& material : scene.materials)
        json["materials"].push_back({{"name", material.name},
                                     {"alphaMode", alphaName(material.alphaMode)},
                                     {"doubleSided", material.doubleSided},
                                     {"unlit", material.unlit}});
    for (const Texture& texture : scene.textures) {
        if (texture.image < 0) continue;
        const auto image = static_cast<std::size_t>(texture.image);
        json["textures"].push_back({{"image", scene.imageNames[image]},
                                    {"width", scene.images[image].width},
                                    {"height", scene.images[image].height}});
    }
    for (const Camera& camera : scene.cameras) json["cameras"].push_back(cameraJson(camera));
    for (const Light& light : scene.lights)
        json["lights"].push_back(
            {{"name", light.name}, {"type", typeName(light.type)}, {"intensity", light.intensity}});
    for (const AnimationClip& clip : scene.clips)
        json["clips"].push_back({{"name", clip.name}, {"duration", clip.duration}, {"channels", clip.channels.size()}});
    for (const Skin& skin : scene.skins) json["skins"].push_back({{"name", skin.name}, {"joints", skin.joints.size()}});
    json["variants"] = scene.variants;
    json["extensions"] = scene.extensions;
    for (const Ignored& ignored : scene.ignored)
        json["ignored"].push_back({{"what", ignored.what}, {"reason", ignored.reason}, {"count", ignored.count}});
    return json;
}

// ---- text output --------------------------------------------------------------------------------

void line(const char* label, const std::string& text) {
    fmt::print("{:<12}{}\n", label, text);
}

// Prints one line per entry, with the label in front of the first line; prints `none` if there are no entries.
void lines(const char* label, const std::vector<std::string>& entries, const char* none) {
    if (entries.empty()) line(label, none);
    for (std::size_t i = 0; i < entries.size(); ++i) line(i == 0 ? label : "", entries[i]);
}

void printMeshes(const Scene& scene, const std::vector<std::size_t>& objects) {
    std::vector<std::size_t> order(scene.meshes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return scene.meshes[a].triangleCount() > scene.meshes[b].triangleCount();
    });
    if (order.empty()) return;
    fmt::print("\n{:>12} {:>12} {:>8}  {}\n", "triangles", "vertices", "objects", "mesh");
    for (std::size_t i = 0; i < std::min(order.size(), meshesListed); ++i) {
        const Mesh& mesh = scene.meshes[order[i]];
        fmt::print("{:>12} {:>12} {:>8}  {} [{}]\n", grouped(mesh.triangleCount()), grouped(mesh.vertices.count()),
                   grouped(objects[order[i]]), nameOr(mesh.name, "mesh", order[i]),
                   fmt::join(attributesOf(mesh.vertices), " "));
    }
    if (order.size() > meshesListed)
        fmt::print("{:>36}… and {} more (--json lists all)\n", "", order.size() - meshesListed);
}

std::string materialSummary(const Scene& scene) {
    if (scene.materials.empty()) return "none (glTF's default: white)";
    const auto count = [&](auto matches) {
        return std::count_if(scene.materials.begin(), scene.materials.end(), matches);
    };
    std::string text = grouped(scene.materials.size());
    const auto mention = [&](std::ptrdiff_t number, const char* what) {
        if (number > 0) text += fmt::format(", {} {}", number, what);
    };
    mention(count([](const Material& m) { return m.alphaMode == AlphaMode::mask; }), "with alpha mask");
    mention(count([](const Material& m) { return m.alphaMode == AlphaMode::blend; }), "blended");
    mention(count([](const Material& m) { return m.doubleSided; }), "double-sided");
    mention(count([](const Material& m) { return m.unlit; }), "unlit");
    return text;
}

std::string textureSummary(const Scene& scene) {
    if (scene.textures.empty()) return "none";
    std::uint64_t pixels = 0;
    int largest = 0;
    for (const TextureImage& image : scene.images) {
        pixels += pixelCount(image.width, image.height);
        largest = std::max({largest, image.width, image.height});
    }
    return fmt::format("{} of {} images, up to {} px wide, {:.1f} megapixels", scene.textures.size(),
                       scene.images.size(), largest, static_cast<double>(pixels) * 1e-6);
}

std::vector<std::string> cameraLines(const Scene& scene) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        std::string text = nameOr(camera.name, "camera", i);
        if (camera.orthographic) {
            text += ": " + *camera.orthographic;
        } else {
            text += fmt::format(": {:.1f}° high", camera.yfov * degrees);
            if (const auto fStop = camera.lensValue("fStop")) text += fmt::format(", f/{:g}", *fStop);
            if (const auto distance = camera.lensValue("focusDistance"))
                text += fmt::format(", focus at {:g} m", *distance);
        }
        result.push_back(text);
    }
    return result;
}

std::string repairSummary(const Scene& scene) {
    Repairs sum;
    for (const Repairs& repairs : allRepairs(scene)) {
        sum.faces += repairs.faces;
        sum.dropped += repairs.dropped;
        sum.turned += repairs.turned;
        sum.cut += repairs.cut;
        sum.split += repairs.split;
    }
    if (sum.faces == 0) return "none needed";
    std::vector<std::string> kinds;
    const auto mention = [&](std::uint32_t count, const char* what) {
        if (count > 0) kinds.push_back(fmt::format("{} {}", grouped(count), what));
    };
    mention(sum.dropped, "removed (no area or repeated)");
    mention(sum.turned, "flipped to face the same way as their neighbours");
    mention(sum.cut, "detached at edges shared by more than two faces");
    mention(sum.split, "detached at corners where surfaces only touch");
    return fmt::format("{} face{} repaired before simplification: {}", grouped(sum.faces), sum.faces == 1 ? "" : "s",
                       fmt::join(kinds, ", "));
}

void printScene(const InfoOptions& options, const Scene& scene, const Pose& pose) {
    const std::vector<std::size_t> objects = objectsPerMesh(scene, pose);
    const Totals totals = totalsOf(scene, objects);
    const glm::dvec3 size = pose.bounds.size();
    line("scene", options.seen.scene.empty()
                      ? scene.name
                      : fmt::format("{} ({})", printable(options.seen.scene.string()), scene.name));
    line("size", fmt::format("{:.4g} × {:.4g} × {:.4g} m", size.x, size.y, size.z));
    line("triangles", fmt::format("{}, {} in the scene", grouped(totals.triangles), grouped(totals.trianglesInScene)));
    line("vertices", grouped(totals.vertices));
    if (totals.points + totals.lines > 0)
        line("strokes", fmt::format("{} points, {} lines", grouped(totals.points), grouped(totals.lines)));
    line("meshes", fmt::format("{}, drawn as {} object{}", grouped(scene.meshes.size()), grouped(pose.objects.size()),
                               pose.objects.size() == 1 ? "" : "s"));
    line("materials", materialSummary(scene));
    line("textures", textureSummary(scene));
    lines("cameras", cameraLines(scene), "none (the view frames the scene)");

    std::vector<std::string> lights, clips, skins;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        lights.push_back(fmt::format("{}: {}, {:g} {}", nameOr(scene.lights[i].name, "light", i),
                                     typeName(scene.lights[i].type), scene.lights[i].intensity,
                                     scene.lights[i].type == LightType::directional ? "lx" : "cd"));
    for (std::size_t i = 0; i < scene.clips.size(); ++i)
        clips.push_back(fmt::format("{}: {:g} s, {} channels", nameOr(scene.clips[i].name, "clip", i),
                                    scene.clips[i].duration, scene.clips[i].channels.size()));
    std::size_t joints = 0;
    for (const Skin& skin : scene.skins) joints += skin.joints.size();
    if (!scene.skins.empty()) skins.push_back(fmt::format("{}, {} joints in all", scene.skins.size(), joints));
    lines("lights", lights, "none (a three-light set-up is used, unless everything is unlit)");
    lines("clips", clips, "none");
    if (!scene.variants.empty()) line("variants", fmt::format("{}", fmt::join(scene.variants, ", ")));
    lines("skins", skins, "none");
    line("extensions", scene.extensions.empty() ? "none" : fmt::format("{}", fmt::join(scene.extensions, ", ")));
    lines("ignored", ignoredLines(scene), "nothing");
    line("repairs", repairSummary(scene));
    printMeshes(scene, objects);
}

void runCameraInfo(const InfoOptions& options, const GlobalOptions& global) {
    Request seen = options.seen;
    if (options.camera != flagOnly) setByName(seen, "camera", options.camera);
    const PreparedFrame frame = placeFrame(seen, terminalProgress(global));
    printCacheUse(frame, global);
    WarningPrinter(global).print(frameWarnings(frame));
    fmt::print("{}", options.json ? cameraJson(frame, options.question) : cameraTable(frame, options.question));
    std::fflush(stdout);
}

void runInfo(const InfoOptions& options, const GlobalOptions& global) {
    if (!options.camera.empty()) return runCameraInfo(options, global);
    const Progress progress = terminalProgress(global);
    const Scene scene = loadScene(options.seen, progress);
    const Pose pose = poseAt(scene, 0, -1);
    if (options.json)
        fmt::print("{}", documentText(sceneJson(options, scene, pose)));
    else
        printScene(options, scene, pose);
    std::fflush(stdout);
}

void addCameraQuestion(CLI::App& command, InfoOptions& options) {
    const char* group = "Camera";
    const std::vector<CLI::Option*> before = command.get_options();
    CLI::Option* camera =
        command
            .add_flag("--camera", options.camera,
                      "Print the camera instead of the scene: field of view, depth of field, hyperfocal distance, "
                      "exposure and the blur at several depths. --camera=NAME prints another camera, --camera=auto the "
                      "camera that frames the scene")
            ->group(group);
    addParsed(command, "--depths", "M,M,…",
              "Depths in m at which to print the blur; may include 'inf'. Default: depths around the focus",
              [&options](const std::string& text) { options.question.depths = parseDepths(text); })
        ->group(group);
    addNumber(command, "--acceptable-coc", options.question.acceptableCoc, {0, 1e3, true}, "MM",
              "Maximum blur in mm on the sensor that counts as sharp. Default: the sensor's diagonal divided by 1500 "
              "(0.03 mm for 36 x 27 mm)")
        ->group(group);
    // Leave out other ways to choose the camera, and settings that don't affect the report: of the aperture, only the
    // diameter matters.
    std::vector<std::string> unused = {"camera", "cameraFrom", "nodeBlur", "apertureImage"};
    for (const LensField& field : lensFields())
        if (field.section == LensSection::aperture) unused.emplace_back(field.name);
    addSettings(command, options.seen, settingsOf({SettingGroup::camera, SettingGroup::lens}, unused));
    addSettings(command, options.seen, {"units", "time", "clip", "loop"});
    for (CLI::Option* option : command.get_options([&](const CLI::Option* each) {
             return each != camera && std::find(before.begin(), before.end(), each) == before.end();
         }))
        option->needs(camera);
}

}  // namespace

void addInfoCommand(CLI::App& program, const GlobalOptions& global) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand("info", "Print the contents of a scene, and what is ignored and why");
    addSettings(*command, options->seen, sceneSettings);
    command->add_flag("--json", options->json, "Print JSON, with every mesh");
    addCameraQuestion(*command, *options);
    command->footer(
        "Examples:\n"
        "  defocus info scene.glb --json\n"
        "  defocus info --camera scene.glb --fstop 2 --focus-auto --depths 1,2,4,inf\n"
        "  defocus info --camera=Left scene.glb --exposure-time 1/125 --iso 400");
    command->callback([options, &global] { runInfo(*options, global); });
}

}  // namespace defocus::engine
