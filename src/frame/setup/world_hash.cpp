#include "frame/setup/world_hash.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "gl/shader_source.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/file.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// Hashes structs member by member, because their padding bytes are undefined.
class Hasher {
public:
    template <typename... Values>
    void add(const Values&... values) {
        (addOne(values), ...);
    }

    template <typename Value>
    void addAll(const std::vector<Value>& values) {
        static_assert(std::has_unique_object_representations_v<Value> || std::is_floating_point_v<Value>);
        hash_ = hashBytes(std::as_bytes(std::span(values)), hash_);
    }

    void addText(std::string_view text) { hash_ = hashBytes(std::as_bytes(std::span(text)), hash_); }

    [[nodiscard]] std::uint64_t hash() const { return hash_; }

private:
    template <typename Value>
    void addOne(const Value& value) {
        if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
            const std::array<Value, 1> one = {value};
            hash_ = hashBytes(std::as_bytes(std::span(one)), hash_);
        } else {  // value is a vector or matrix
            for (typename Value::length_type i = 0; i < Value::length(); ++i) addOne(value[i]);
        }
    }

    std::uint64_t hash_ = hashSeed;
};

void addTextureUse(Hasher& hasher, const TextureUse& use) {
    hasher.add(use.texture, use.uvSet, use.uvTransform);
}

void addMaterials(Hasher& hasher, const Scene& scene) {
    hasher.add(scene.materials.size(), scene.textures.size(), scene.images.size());
    for (const Material& m : scene.materials) {
        hasher.add(m.baseColorFactor, m.metallicFactor, m.roughnessFactor, m.emissiveFactor, m.normalScale,
                   m.occlusionStrength, m.alphaMode, m.alphaCutoff, m.doubleSided, m.unlit, m.ior, m.specularFactor,
                   m.specularColorFactor, m.transmissionFactor, m.thicknessFactor, m.attenuationDistance,
                   m.attenuationColor, m.clearcoatFactor, m.clearcoatRoughnessFactor, m.clearcoatNormalScale,
                   m.sheenColorFactor, m.sheenRoughnessFactor, m.anisotropyStrength, m.anisotropyRotation,
                   m.iridescenceFactor, m.iridescenceIor, m.iridescenceThicknessMinimum, m.iridescenceThicknessMaximum,
                   m.dispersion, m.diffuseTransmissionFactor, m.diffuseTransmissionColorFactor);
        for (const TextureUse* use : textureUses(m)) addTextureUse(hasher, *use);
    }
    for (const Texture& t : scene.textures)
        hasher.add(t.image, t.wrapS, t.wrapT, t.magnification, t.minification, t.mipmaps);
    for (const TextureImage& image : scene.images) {
        hasher.add(image.width, image.height);
        hasher.addAll(image.rgba);
    }
}

void addObjects(Hasher& hasher, const Pose& pose) {
    for (const Object& object : pose.objects) {
        hasher.add(object.mesh, object.worldFromObject, object.cocScale);
        for (const glm::dmat4& matrix : object.worldFromJoint) hasher.add(matrix);
        hasher.addAll(object.morphWeights);
    }
}

void addMeshes(Hasher& hasher, const World& world) {
    hasher.add(world.scene->meshes.size(), world.pose.objects.size());
    for (const Mesh& mesh : world.scene->meshes) {
        hasher.add(meshHash(mesh));
        for (const Primitive& primitive : mesh.primitives) hasher.add(primitive.material);
    }
    addObjects(hasher, world.pose);
    hasher.add(world.shutter.poses.size(), world.shutter.perSample);
    for (const Pose& pose : world.shutter.poses) addObjects(hasher, pose);
}

void addLight(Hasher& hasher, const World& world) {
    hasher.add(world.lights.size());
    for (const PlacedLight& placed : world.lights) {
        const Light& l = placed.light;
        hasher.add(placed.position, placed.direction, l.type, l.color, l.intensity, l.range, l.innerConeAngle,
                   l.outerConeAngle, l.angularDiameter, l.radius);
    }
    const Environment& e = world.environment;
    hasher.add(e.type, e.zenith, e.horizon, e.nadir, e.visible, e.lighting, e.map != nullptr);
    if (e.map == nullptr) return;
    hasher.add(e.map->width, e.map->height, e.map->channels);
    hasher.addAll(e.map->pixels);
}

void addView(Hasher& hasher, const View& view) {
    const Lens& l = view.lens;
    hasher.add(view.worldFromCamera, view.nearPlane, view.width, view.height);
    for (const glm::dmat4& camera : view.shutterCameras) hasher.add(camera);
    for (const LensField& field : lensFields()) hasher.add(lensFieldValue(l, field));
    hasher.add(l.apertureImage != nullptr);
    if (l.apertureImage == nullptr) return;
    hasher.add(l.apertureImage->width, l.apertureImage->height, l.apertureImage->channels);
    hasher.addAll(l.apertureImage->pixels);
}

void addShaders(Hasher& hasher, const fs::path& folder) {
    for (const auto& [name, text] : embeddedShaders()) {
        hasher.addText(name);
        hasher.addText(text);
    }
    if (folder.empty()) return;
    std::error_code fault;
    std::vector<fs::path> files;
    for (auto entry = fs::recursive_directory_iterator(folder, fault); !fault && entry != fs::end(entry);
         entry.increment(fault))
        if (entry->is_regular_file()) files.push_back(entry->path());
    if (fault) fail("cannot read the shaders in {}: {}", folder.string(), fault.message());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        hasher.addText(fs::relative(file, folder).string());
        hasher.addAll(readFile(file));
    }
}

}  // namespace

std::uint64_t worldHash(const World& world, const View& view, const fs::path& shaderFolder) {
    Hasher hasher;
    addMeshes(hasher, world);
    addMaterials(hasher, *world.scene);
    addLight(hasher, world);
    addView(hasher, view);
    addShaders(hasher, shaderFolder);
    return hasher.hash();
}

}  // namespace defocus::engine
