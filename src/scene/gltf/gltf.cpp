#include "scene/gltf/gltf.h"

#include <algorithm>
#include <set>

#include "core/message.h"
#include "scene/finish_mesh.h"
#include "scene/gltf/animation.h"
#include "scene/gltf/material.h"
#include "scene/gltf/mesh.h"
#include "scene/gltf/node.h"
#include "scene/gltf/source.h"
#include "scene/gltf/texture.h"
#include "scene/gltf/variants.h"
#include "scene/units.h"

namespace defocus::engine {

namespace {

// Counts each object's memory against the scene's memory budget. Instances share a mesh, but each needs memory of its
// own.
void checkObjects(gltf::Source& source, const gltf::Hierarchy& hierarchy, const Scene& scene) {
    constexpr std::uint64_t objectBytes = 2304;  // measured memory of an object: its pose and its draw data
    constexpr std::uint64_t jointBytes = 4 * sizeof(glm::dmat4);  // memory of a joint's matrices in pose and frame plan
    constexpr std::uint64_t weightBytes = 4 * sizeof(double);
    for (const Node& node : hierarchy.nodes) {
        if (node.mesh < 0) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
        const std::size_t objects = std::max<std::size_t>(1, node.instances.size());
        takeBudget(source, objects, objectBytes, fmt::format("objects of node '{}'", node.name));
        takeBudget(source, objects * mesh.morphTargets.size(), weightBytes,
                   fmt::format("morph weights of node '{}'", node.name));
        if (node.skin >= 0 && !mesh.vertices.joints.empty())
            takeBudget(source, objects * scene.skins[static_cast<std::size_t>(node.skin)].joints.size(), jointBytes,
                       fmt::format("joints of node '{}'", node.name));
    }
}

std::vector<std::string> extensionsOf(const gltf::Source& source) {
    std::set<std::string> names;
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        names.merge(source.document.json.value(list, std::set<std::string>()));
    return {names.begin(), names.end()};
}

// Returns the metres per unit that the extras of the scene or the asset state, as a name such as "cm" or as a number.
// Returns nullopt if they state no unit.
std::optional<double> ownMetresPerUnit(const gltf::Source& source) {
    const nlohmann::json& json = source.document.json;
    std::vector<const nlohmann::json*> holders;
    if (const auto scenes = json.find("scenes"); scenes != json.end() && !scenes->empty())
        holders.push_back(&(*scenes)[json.value("scene", std::size_t{0})]);
    if (const auto asset = json.find("asset"); asset != json.end()) holders.push_back(&*asset);
    for (const nlohmann::json* holder : holders) {
        const nlohmann::json* extras = gltf::extrasOf(*holder);
        if (extras == nullptr || !extras->contains("units")) continue;
        const nlohmann::json& units = (*extras)["units"];
        try {
            return metresOfUnit(units.is_string() ? units.get<std::string>() : units.dump());
        } catch (const Error& error) {
            gltf::fault(source.document, "extras.units: {}", error.what());
        }
    }
    return {};
}

Scene readScene(gltf::Source& source, const std::filesystem::path& path, const Progress& progress) {
    Scene scene;
    scene.file = path;

    // Read materials before meshes: meshes with normal maps need tangents.
    scene.materials = gltf::readMaterials(source);
    gltf::Textures textures = gltf::readTextures(source, scene.materials, progress);
    scene.textures = std::move(textures.textures);
    scene.images = std::move(textures.images);
    scene.imageNames = std::move(textures.names);
    source.document.json.erase("materials");  // releases memory that the meshes need

    scene.meshes = gltf::readMeshes(source, scene.materials, progress);

    gltf::Hierarchy hierarchy = gltf::readHierarchy(source);
    scene.cameras = gltf::readCameras(source);
    scene.lights = gltf::readLights(source);
    scene.clips = gltf::readAnimations(source, hierarchy, scene.meshes);
    scene.skins = gltf::readSkins(source, hierarchy);
    gltf::checkSkinnedMeshes(source, hierarchy, scene.meshes, scene.skins);
    checkObjects(source, hierarchy, scene);
    scene.name = hierarchy.sceneName.empty() ? printable(path.stem().string()) : hierarchy.sceneName;
    scene.nodes = std::move(hierarchy.nodes);
    scene.roots = std::move(hierarchy.roots);

    // Check the transforms; set the unit, the extensions and the notes about ignored content.
    if (const std::string placed = placedAtInfinity(scene); !placed.empty())
        gltf::fault(source.document, "the transform of {} is not finite", placed);
    scene.ownMetresPerUnit = ownMetresPerUnit(source);
    scene.extensions = extensionsOf(source);
    scene.variants = gltf::variantNames(source.document);
    scene.ignored = std::move(source.ignored);
    return scene;
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const Progress& progress, const std::string& variant) {
    gltf::Source source = gltf::openSource(path, variant, progress);
    try {
        Scene scene = readScene(source, path, progress);
        scene.variant = variant;
        return scene;
    } catch (const nlohmann::json::exception& exception) {
        // Reached only if checkSchema has missed an error in the JSON.
        gltf::fault(source.document, "not valid glTF: {}", exception.what());
    } catch (const std::bad_alloc&) {
        gltf::fault(source.document, "the scene does not fit into memory");
    }
}

}  // namespace defocus::engine
