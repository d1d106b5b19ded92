// Sources: glTF 2.0 specification, scenes and nodes (3.5) and cameras (3.10); EXT_mesh_gpu_instancing;
// KHR_lights_punctual; KHR_node_visibility.
#include "scene/gltf/node.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

#include "scene/gltf/accessor.h"

namespace defocus::engine::gltf {

namespace {

// ---- selection of nodes ------------------------------------------------------------------------

// Returns the index of each node's parent; −1 for a root. Throws Error for nodes with two parents and for cycles.
std::vector<int> parentsOf(const Source& source) {
    const std::vector<tinygltf::Node>& nodes = source.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const int child : nodes[i].children) {
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0) fault(source.document, "node {} is a child of two nodes, {} and {}", child, parent, i);
            parent = static_cast<int>(i);
        }

    // Search for cycles: each node has at most one parent, so nodes that no root reaches are in or below a cycle.
    std::vector<bool> reached(nodes.size());
    std::vector<int> stack;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (parents[i] < 0) stack.push_back(static_cast<int>(i));
    while (!stack.empty()) {
        const auto node = static_cast<std::size_t>(stack.back());
        stack.pop_back();
        reached[node] = true;
        stack.insert(stack.end(), nodes[node].children.begin(), nodes[node].children.end());
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost != reached.end())
        fault(source.document, "node {} is its own ancestor: the nodes form a loop", lost - reached.begin());
    return parents;
}

std::vector<int> sceneRoots(Source& source, const std::vector<int>& parents, std::string& name) {
    std::vector<int> roots;
    const std::size_t scenes = entryCount(source.document, "scenes");
    if (scenes == 0) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] < 0) roots.push_back(static_cast<int>(i));
        return roots;
    }
    const std::size_t chosen = source.document.json.value("scene", std::size_t{0});
    const nlohmann::json& scene = source.document.json["scenes"][chosen];
    name = scene.value("name", std::string());
    std::vector<bool> listed(parents.size());
    for (const int root : scene.value("nodes", std::vector<int>())) {
        if (parents[static_cast<std::size_t>(root)] >= 0)
            fault(source.document,
                  "scene {} lists node {}, which is a child of node {}; a scene may list only root nodes", chosen, root,
                  parents[static_cast<std::size_t>(root)]);
        if (!listed[static_cast<std::size_t>(root)]) roots.push_back(root);
        listed[static_cast<std::size_t>(root)] = true;
    }
    if (scenes > 1) ignore(source, "scene", "only the file's default scene is drawn", scenes - 1);
    return roots;
}

// Returns, for each node, whether it is needed: the descendants of `roots`, the joints of their skins, and the joints'
// ancestors.
std::vector<bool> neededNodes(const Source& source, const std::vector<int>& parents, const std::vector<int>& roots) {
    const std::vector<tinygltf::Node>& nodes = source.model.nodes;
    std::vector<bool> needed(nodes.size());
    std::vector<int> stack = roots;
    while (!stack.empty()) {
        const auto node = static_cast<std::size_t>(stack.back());
        stack.pop_back();
        needed[node] = true;
        stack.insert(stack.end(), nodes[node].children.begin(), nodes[node].children.end());
    }
    for (const tinygltf::Skin& skin : source.model.skins)
        for (int joint : skin.joints)
            for (; joint >= 0 && !needed[static_cast<std::size_t>(joint)];
                 joint = parents[static_cast<std::size_t>(joint)])
                needed[static_cast<std::size_t>(joint)] = true;
    return needed;
}

// ---- properties of a node ----------------------------------------------------------------------

glm::dvec3 vectorOf(const std::vector<double>& numbers, const glm::dvec3& otherwise) {
    return numbers.empty() ? otherwise : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

glm::dquat unitQuaternion(double x, double y, double z, double w) {
    const glm::dquat rotation(w, x, y, z);
    const double length = glm::length(rotation);
    return length > 0 && std::isfinite(length) ? rotation / length : glm::dquat(1, 0, 0, 0);
}

std::vector<glm::dmat4> readInstances(Source& source, const nlohmann::json& json, const std::string& label) {
    const nlohmann::json& attributes = json["attributes"];
    const std::string what = label + ": EXT_mesh_gpu_instancing";
    const auto accessor = [&](const char* name) {
        return attributes.contains(name) ? attributes[name].get<int>() : -1;
    };
    std::optional<std::size_t> count;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (accessor(name) < 0) continue;
        const std::size_t elements = elementCount(source, accessor(name));
        if (count && *count != elements)
            fault(source.document, "{}: {} has {} elements, but another attribute has {}", what, name, elements,
                  *count);
        count = elements;
    }
    if (!count) return {};
    takeBudget(source, *count, 2 * sizeof(glm::dmat4), what);

    std::vector<glm::dmat4> instances(*count, glm::dmat4(1.0));
    if (accessor("TRANSLATION") >= 0) {
        const auto values = readVectors<glm::vec3>(source, accessor("TRANSLATION"), what);
        for (std::size_t i = 0; i < *count; ++i) instances[i] = glm::translate(instances[i], glm::dvec3(values[i]));
    }
    if (accessor("ROTATION") >= 0) {
        const auto values = readVectors<glm::vec4>(source, accessor("ROTATION"), what);
        for (std::size_t i = 0; i < *count; ++i)
            instances[i] *= glm::mat4_cast(unitQuaternion(values[i].x, values[i].y, values[i].z, values[i].w));
    }
    if (accessor("SCALE") >= 0) {
        const auto values = readVectors<glm::vec3>(source, accessor("SCALE"), what);
        for (std::size_t i = 0; i < *count; ++i) instances[i] = glm::scale(instances[i], glm::dvec3(values[i]));
    }
    return instances;
}

int lightOf(const Source& source, const nlohmann::json& json, const std::string& label) {
    const nlohmann::json* extension = findExtension(json, "KHR_lights_punctual");
    if (extension == nullptr) return -1;
    const auto light = (*extension)["light"].get<std::uint64_t>();
    if (light >= source.model.lights.size())
        fault(source.document, "{}: light {} does not exist; the file has {} lights", label, light,
              source.model.lights.size());
    return static_cast<int>(light);
}

// Returns the blur factor of the node's subtree, which is `cocScale` in the node's extras; 1 if absent. Throws Error
// unless the factor is a number ≥ 0.
double cocScaleOf(Source& source, const nlohmann::json& json, const std::string& label) {
    const nlohmann::json* extras = extrasOf(json);
    if (extras == nullptr || !extras->contains("cocScale")) return 1;
    const nlohmann::json& value = (*extras)["cocScale"];
    if (!value.is_number() || !(value.get<double>() >= 0))
        fault(source.document, "{}: extras.cocScale must be a number of at least 0, not {}", label, value.dump());
    return value.get<double>();
}

Node readNode(Source& source, std::size_t index) {
    const tinygltf::Node& from = source.model.nodes[index];
    const nlohmann::json& json = source.document.json["nodes"][index];
    const std::string label = labelOf("node", index, from.name);
    Node node;
    node.name = from.name;
    node.translation = vectorOf(from.translation, glm::dvec3(0));
    node.scale = vectorOf(from.scale, glm::dvec3(1));
    if (!from.rotation.empty())
        node.rotation = unitQuaternion(from.rotation[0], from.rotation[1], from.rotation[2], from.rotation[3]);
    if (!from.matrix.empty()) node.matrix = glm::make_mat4(from.matrix.data());
    node.mesh = from.mesh;
    node.skin = from.mesh >= 0 ? from.skin : -1;
    node.camera = from.camera;
    node.light = lightOf(source, json, label);
    node.cocScale = cocScaleOf(source, json, label);
    if (const nlohmann::json* visibility = findExtension(json, "KHR_node_visibility"))
        node.visible = visibility->value("visible", true);
    for (const double weight : from.weights) node.morphWeights.push_back(toFloat(weight));
    const nlohmann::json* instancing = findExtension(json, "EXT_mesh_gpu_instancing");
    if (instancing != nullptr && from.mesh >= 0) node.instances = readInstances(source, *instancing, label);
    return node;
}

// ---- cameras ------------------------------------------------------------------------------------

// Returns the numbers and booleans (0 or 1) in the extras of a camera or a camera's node. Blender exports custom
// properties as extras.
std::map<std::string, double, std::less<>> lensValues(const nlohmann::json& json) {
    std::map<std::string, double, std::less<>> values;
    const nlohmann::json* extras = extrasOf(json);
    if (extras == nullptr) return values;
    for (const auto& [name, value] : extras->items()) {
        if (value.is_number()) values[name] = value.get<double>();
        if (value.is_boolean()) values[name] = value.get<bool>() ? 1 : 0;
    }
    return values;
}

// Reads the draft extension EXT_camera_physical, whose lengths are in metres, into `camera`. Values from the extras
// take precedence.
void readPhysicalCamera(Source& source, const nlohmann::json& json, const std::string& label, Camera& camera) {
    constexpr double millimetres = 1e3;
    constexpr double longest = 10;  // max focal length in m; a longer one, such as 35, is probably in millimetres
    const nlohmann::json* extension = findExtension(json, "EXT_camera_physical");
    if (extension == nullptr) return;
    const auto number = [&](const nlohmann::json& value, const char* name) {
        const auto result = value.get<double>();
        if (!(result > 0) || !std::isfinite(result))
            fault(source.document, "{}: EXT_camera_physical has an invalid {}: {}", label, name, value.dump());
        return result;
    };
    PhysicalCamera physical;
    physical.focalLength = number((*extension)["focalLength"], "focalLength") * millimetres;
    physical.sensorSize.x = number((*extension)["sensorSize"][0], "sensorSize") * millimetres;
    physical.sensorSize.y = number((*extension)["sensorSize"][1], "sensorSize") * millimetres;
    if (extension->contains("fStop")) camera.lens.emplace("fStop", number((*extension)["fStop"], "fStop"));
    if (extension->contains("focusDistance"))
        camera.lens.emplace("focusDistance", number((*extension)["focusDistance"], "focusDistance"));
    if (physical.focalLength <= longest * millimetres)
        camera.physical = physical;
    else
        ignore(source, label, "the focal length in EXT_camera_physical exceeds 10 m; is it in millimetres?");
}

// Returns the path of the aperture image from the extras of a camera or a camera's node; empty if there is none.
std::string apertureImageOf(const nlohmann::json& camera) {
    const nlohmann::json* extras = extrasOf(camera);
    if (extras == nullptr) return {};
    const auto path = extras->find("apertureImage");
    return path != extras->end() && path->is_string() ? path->get<std::string>() : std::string();
}

// Adds lens properties from the extras of camera nodes to their cameras. Extras of the camera itself take precedence.
void addNodeExtras(const Source& source, std::vector<Camera>& cameras) {
    for (std::size_t i = 0; i < source.model.nodes.size(); ++i) {
        if (source.model.nodes[i].camera < 0) continue;
        const nlohmann::json& json = source.document.json["nodes"][i];
        Camera& camera = cameras[static_cast<std::size_t>(source.model.nodes[i].camera)];
        for (const auto& [name, value] : lensValues(json)) camera.lens.emplace(name, value);
        if (camera.apertureImage.empty()) camera.apertureImage = apertureImageOf(json);
    }
}

bool isFromBlender(const Source& source) {
    const auto asset = source.document.json.find("asset");
    const auto generator = asset->find("generator");
    return generator != asset->end() && generator->is_string() &&
           generator->get<std::string>().starts_with("Khronos glTF Blender I/O");
}

// Converts the blade rotation from Blender's convention. At rotation 0, the aperture's rightmost point is the midpoint
// of an edge in Blender, but a corner here.
void turnBlades(Camera& camera) {
    const double count = camera.lensValue("bladeCount").value_or(0);
    if (count >= 3) camera.lens["bladeRotation"] += 180 / count;
}

}  // namespace

Hierarchy readHierarchy(Source& source) {
    Hierarchy result;
    const std::vector<int> parents = parentsOf(source);
    const std::vector<int> roots = sceneRoots(source, parents, result.sceneName);

    // Keep needed nodes in file order.
    const std::vector<bool> needed = neededNodes(source, parents, roots);
    result.kept.assign(parents.size(), -1);
    result.nodes.reserve(static_cast<std::size_t>(std::count(needed.begin(), needed.end(), true)));
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (!needed[i]) continue;
        result.kept[i] = static_cast<int>(result.nodes.size());
        result.nodes.push_back(readNode(source, i));
    }

    // Set the parents and children of kept nodes.
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (!needed[i] || parents[i] < 0) continue;
        const int parent = result.kept[static_cast<std::size_t>(parents[i])];
        result.nodes[static_cast<std::size_t>(result.kept[i])].parent = parent;
        result.nodes[static_cast<std::size_t>(parent)].children.push_back(result.kept[i]);
    }
    for (const int root : roots) result.roots.push_back(result.kept[static_cast<std::size_t>(root)]);
    return result;
}

std::vector<Camera> readCameras(Source& source) {
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < source.model.cameras.size(); ++i) {
        const tinygltf::Camera& from = source.model.cameras[i];
        const nlohmann::json& json = source.document.json["cameras"][i];
        const std::string label = labelOf("camera", i, from.name);
        Camera camera;
        camera.name = from.name;
        camera.lens = lensValues(json);
        camera.apertureImage = apertureImageOf(json);
        if (from.type == "orthographic") {
            camera.orthographic = "orthographic cameras are not supported";
            ignore(source, label,
                   *camera.orthographic + "; the scene is framed automatically if it has no other camera");
        } else {
            camera.yfov = from.perspective.yfov;
            camera.znear = from.perspective.znear;
            if (from.perspective.aspectRatio > 0) camera.aspectRatio = from.perspective.aspectRatio;
            if (!(camera.yfov > 0 && camera.yfov < std::numbers::pi))
                fault(source.document, "{}: invalid yfov of {} rad", label, camera.yfov);
            readPhysicalCamera(source, json, label, camera);
            if (!(camera.znear > 0)) fault(source.document, "{}: invalid znear of {} m", label, camera.znear);
        }
        cameras.push_back(camera);
    }
    addNodeExtras(source, cameras);
    if (isFromBlender(source)) std::ranges::for_each(cameras, turnBlades);
    return cameras;
}

std::vector<Light> readLights(Source& source) {
    std::vector<Light> lights;
    for (std::size_t i = 0; i < source.model.lights.size(); ++i) {
        const tinygltf::Light& from = source.model.lights[i];
        Light light;
        light.name = from.name;
        if (from.type == "point")
            light.type = LightType::point;
        else if (from.type == "spot")
            light.type = LightType::spot;
        else if (from.type != "directional")
            fault(source.document, "{}: unknown type '{}'", labelOf("light", i, from.name), from.type);
        if (from.color.size() == 3)
            light.color = {toFloat(from.color[0]), toFloat(from.color[1]), toFloat(from.color[2])};
        light.intensity = toFloat(from.intensity);
        light.range = toFloat(std::max(from.range, 0.0));
        light.innerConeAngle = toFloat(from.spot.innerConeAngle);
        light.outerConeAngle = toFloat(from.spot.outerConeAngle);
        const bool cone = light.innerConeAngle >= 0 && light.outerConeAngle > light.innerConeAngle &&
                          light.outerConeAngle <= std::numbers::pi_v<float> / 2 + 1e-4f;
        if (light.type == LightType::spot && !cone)
            fault(source.document, "{}: invalid spot cone from {} to {} rad", labelOf("light", i, from.name),
                  light.innerConeAngle, light.outerConeAngle);
        lights.push_back(light);
    }
    return lights;
}

}  // namespace defocus::engine::gltf
