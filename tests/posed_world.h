#pragma once
// Loads a scene file posed at a given time, and bakes the posed vertices of each object into a static mesh.

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "lod/pyramid/pyramid.h"
#include "models.h"
#include "plan/view.h"
#include "scene/defaults.h"
#include "scene/gltf/gltf.h"
#include "scene/posed_mesh.h"
#include "small_world.h"

namespace defocus::engine {

// A model with animated skins or morph targets, and the index of one of its animation clips.
struct PosedModel {
    const char* file;
    int clip;
};
inline std::string posedModelName(const testing::TestParamInfo<PosedModel>& tested) {
    return testNameOf(std::string(tested.param.file) + "_" + std::to_string(tested.param.clip));
}
inline constexpr PosedModel posedModels[] = {{"meshes/reed.glb", 0},
                                             {"Fox.glb", 0},
                                             {"Fox.glb", 2},
                                             {"RiggedFigure.glb", 0},
                                             {"RecursiveSkeletons.glb", 0},
                                             {"AnimatedMorphCube.glb", 0},
                                             {"AnimatedMorphCube-Quantized.glb", 0},
                                             {"MorphPrimitivesTest.glb", 0}};

inline void poseWorld(SmallWorld& small, double time, int clip) {
    small.world.pose = poseAt(small.scene, time, clip);
}

// Returns a scene in its pose at a time of an animation clip, with a camera that frames the posed scene.
inline std::unique_ptr<SmallWorld> posedWorld(const std::filesystem::path& path, double time, int clip) {
    auto small = std::make_unique<SmallWorld>();
    small->scene = loadGltf(path);
    poseWorld(*small, time, clip);
    small->view.width = 128;
    small->view.height = 96;
    const PlacedCamera camera = chooseCamera(small->scene, small->world.pose, FramingCamera{}, 128.0 / 96);
    small->view.worldFromCamera = camera.worldFromCamera;
    small->view.nearPlane = camera.camera.znear;
    small->view.lens.focusDistance =
        glm::distance(glm::dvec3(camera.worldFromCamera[3]), small->world.pose.bounds.centre());
    small->view.lens.focalLength = focalLengthFromFov(128.0 / 96 * std::tan(camera.camera.yfov / 2), 36);
    small->world.lights = lightsOrDefault(small->scene, small->world.pose, camera);
    small->world.environment = environmentOrDefault(small->scene);
    finish(*small);
    return small;
}

// Returns level `level` of an object's pyramid in world space, relative to `origin` so that float precision suffices.
inline Mesh bakedLevel(const Mesh& mesh, const Pyramid& pyramid, std::uint32_t level, const Object& object,
                       const glm::dvec3& origin) {
    Mesh flat = mesh;
    flat.vertices = pyramid.vertices;
    const PyramidLevel& from = pyramid.levels[level];
    std::copy(from.positions.begin(), from.positions.end(), flat.vertices.positions.begin());
    std::copy(from.normals.begin(), from.normals.end(), flat.vertices.normals.begin());
    std::copy(from.colors.begin(), from.colors.end(), flat.vertices.colors.begin());
    std::copy(from.uv0.begin(), from.uv0.end(), flat.vertices.uv0.begin());
    std::copy(from.uv1.begin(), from.uv1.end(), flat.vertices.uv1.begin());
    for (MorphTarget& target : flat.morphTargets)
        for (std::vector<glm::vec3>* kind : {&target.positions, &target.normals, &target.tangents}) {
            if (kind->empty()) continue;
            std::vector<glm::vec3> picked;
            for (const std::uint32_t vertex : pyramid.source) picked.push_back((*kind)[vertex]);
            *kind = std::move(picked);
        }
    for (std::size_t p = 0; p < flat.primitives.size(); ++p) {
        const auto first = pyramid.indices.begin() + from.primitives[p].first;
        flat.primitives[p].indices.assign(first, first + from.primitives[p].count);
    }
    const std::vector<glm::dvec3> positions = posedPositions(flat, object);
    flat.vertices.normals = posedNormals(flat, object);
    for (std::size_t v = 0; v < positions.size(); ++v) flat.vertices.positions[v] = glm::vec3(positions[v] - origin);
    flat.vertices.joints.clear();
    flat.vertices.weights.clear();
    flat.vertices.joints1.clear();
    flat.vertices.weights1.clear();
    flat.vertices.tangents.clear();
    flat.morphTargets.clear();
    flat.morphWeights.clear();
    return flat;
}

// Returns the scene of `small` without skins and morph targets: one mesh for each object, at level `level`, or at the
// object's coarsest level if that is finer.
inline std::unique_ptr<SmallWorld> bakedWorld(const SmallWorld& small, std::uint32_t level) {
    auto baked = std::make_unique<SmallWorld>();
    baked->scene = small.scene;
    baked->scene.meshes.clear();
    baked->view = small.view;
    baked->world.lights = small.world.lights;
    baked->world.environment = small.world.environment;
    for (const Object& object : small.world.pose.objects) {
        const auto mesh = static_cast<std::size_t>(object.mesh);
        const Pyramid& pyramid = small.world.pyramids[mesh];
        const auto last = static_cast<std::uint32_t>(pyramid.levels.size() - 1);
        const auto origin = glm::dvec3(object.worldFromObject[3]);
        place(*baked, static_cast<int>(baked->scene.meshes.size()), glm::translate(glm::dmat4(1), origin));
        baked->scene.meshes.push_back(
            bakedLevel(small.scene.meshes[mesh], pyramid, std::min(level, last), object, origin));
    }
    for (const Mesh& mesh : baked->scene.meshes) baked->world.pyramids.push_back(fullDetail(mesh));
    return baked;
}

}  // namespace defocus::engine
