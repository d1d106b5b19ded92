#include "unlit_file.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/error.h"
#include "eval/convergence/unlit_scene.h"
#include "scene/gltf/model_writer.h"

namespace defocus::engine {

namespace {

namespace tinygltf = gltf::tinygltf;

void addMesh(tinygltf::Model& model, const Mesh& mesh) {
    if (!mesh.morphTargets.empty()) fail("mesh \"{}\" has morph targets, which are not written", mesh.name);
    // Write normals, although unlit materials don't need them, because importers give each triangle separate vertices
    // if there are no normals.
    const std::map<std::string, int> attributes = {{"POSITION", gltf::appendPositions(model, mesh.vertices.positions)},
                                                   {"NORMAL", gltf::appendVectors(model, mesh.vertices.normals)},
                                                   {"COLOR_0", gltf::appendVectors(model, mesh.vertices.colors)}};
    std::vector<tinygltf::Primitive> primitives;
    for (const Primitive& primitive : mesh.primitives) {
        tinygltf::Primitive& written = primitives.emplace_back();
        written.attributes = attributes;
        written.indices = gltf::appendIndices(model, primitive.indices);
        written.material = primitive.material;
        written.mode = TINYGLTF_MODE_TRIANGLES;
    }
    model.meshes.emplace_back().primitives = primitives;
}

tinygltf::Material materialOf(const Material& material) {
    tinygltf::Material written;
    const glm::vec4 colour = material.baseColorFactor;
    written.pbrMetallicRoughness.baseColorFactor = {colour.r, colour.g, colour.b, colour.a};
    written.doubleSided = material.doubleSided;
    written.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
    return written;
}

tinygltf::Camera cameraOf(const View& view) {
    const Lens& lens = view.lens;
    tinygltf::Camera camera;
    camera.type = "perspective";
    camera.perspective.yfov = 2 * std::atan(tanHalfHorizontalFov(lens) * view.height / view.width);
    camera.perspective.znear = view.nearPlane;
    camera.extras =
        tinygltf::Value(tinygltf::Value::Object{{"fStop", tinygltf::Value(lens.fStop)},
                                                {"focusDistance", tinygltf::Value(lens.focusDistance)},
                                                {"horizontalAperture", tinygltf::Value(lens.horizontalAperture)}});
    return camera;
}

tinygltf::Node& addNode(tinygltf::Model& model, const glm::dmat4& matrix) {
    tinygltf::Node& node = model.nodes.emplace_back();
    node.matrix.assign(glm::value_ptr(matrix), glm::value_ptr(matrix) + 16);
    return node;
}

tinygltf::Model modelOf(const PreparedFrame& frame) {
    const Scene scene = unlitScene(*frame.scene);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "defocus";
    model.extensionsUsed = {"KHR_materials_unlit"};
    for (const Material& material : scene.materials) model.materials.push_back(materialOf(material));
    model.cameras = {cameraOf(frame.view)};
    addNode(model, frame.view.worldFromCamera).camera = 0;
    std::map<int, int> meshes;  // for each drawn mesh, its index in the scene → its index in the file
    for (const Object& object : frame.world.pose.objects) {
        if (object.skinned()) fail("object \"{}\" has a skin, which is not written", object.name);
        const auto [found, added] = meshes.try_emplace(object.mesh, static_cast<int>(meshes.size()));
        if (added) addMesh(model, scene.meshes[static_cast<std::size_t>(object.mesh)]);
        addNode(model, object.worldFromObject).mesh = found->second;
    }
    model.defaultScene = 0;
    std::vector<int>& roots = model.scenes.emplace_back().nodes;
    roots.resize(model.nodes.size());
    std::iota(roots.begin(), roots.end(), 0);
    return model;
}

}  // namespace

void writeUnlitFile(const std::filesystem::path& path, const PreparedFrame& frame) {
    gltf::writeModel(path, modelOf(frame));
}

}  // namespace defocus::engine
