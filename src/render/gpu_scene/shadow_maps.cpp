// Sources: Williams 1978, Casting Curved Shadows on Curved Surfaces; Haeberli and Akeley 1990, The Accumulation Buffer.
#include "render/gpu_scene/shadow_maps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace defocus::engine {

namespace {

constexpr GLuint mapsUnit = 29;  // texture unit in shaders/include/shadows.glsl
constexpr GLuint projectionsUnit = 30;
constexpr GLint firstSampleLocation = 2;
constexpr GLint slotLocation = 3;  // attribute location in shaders/shadows/caster.vert

std::size_t mapsPerSample(const FramePlan& plan) {
    return plan.shadows.maps.size() * plan.shadows.points;
}

// Returns whether a shadow caster tints the light that it transmits.
bool tintsLight(const Scene& scene, const FramePlan& plan) {
    const auto isGrey = [](const glm::vec3& color) { return color.r == color.g && color.g == color.b; };
    return std::ranges::any_of(plan.shadows.casters, [&](const ObjectPlan& caster) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(caster.mesh)];
        return std::ranges::any_of(mesh.primitives, [&](const Primitive& primitive) {
            const Material& material = materialAt(scene, primitive.material);
            return material.transmits() &&
                   (!mesh.vertices.colors.empty() || material.baseColor.used() ||
                    !isGrey(glm::vec3(material.baseColorFactor)) || !isGrey(material.attenuationColor));
        });
    });
}

// Returns defines that give, for each light, the index of its first shadow map and its number of maps. The last entries
// are those of the environment.
ShaderDefines mapDefines(const FramePlan& plan, std::size_t lights) {
    std::vector<int> first(lights + 1, -1);
    std::vector<int> faces(lights + 1, 0);
    for (std::size_t i = 0; i < plan.shadows.maps.size(); ++i) {
        const int light = plan.shadows.maps[i].light;
        const std::size_t place = light == surroundings ? lights : static_cast<std::size_t>(light);
        if (first[place] < 0) first[place] = static_cast<int>(i);
        ++faces[place];
    }
    return {{"shadowed", "true"},
            {"shadowMapCount", std::to_string(plan.shadows.maps.size())},
            {"shadowPoints", std::to_string(plan.shadows.points)},
            {"shadowSize", std::to_string(plan.shadows.size)},
            {"shadowError", fmt::format("{:.8e}", plan.shadows.casterError)},
            {"shadowFirst", fmt::format("int[]({})", fmt::join(first, ","))},
            {"shadowFaces", fmt::format("int[]({})", fmt::join(faces, ","))}};
}

std::vector<float> texelsOf(const std::vector<ShadowProjection>& projections) {
    std::vector<float> texels;
    texels.reserve(projections.size() * 24);
    const auto add = [&](const glm::vec4& v) { texels.insert(texels.end(), {v.x, v.y, v.z, v.w}); };
    for (const ShadowProjection& projection : projections) {
        for (const glm::vec4& row : projection.clipRows) add(row);
        add(glm::vec4(projection.toLight, projection.texel));
        add(glm::vec4(projection.radiance, 0));
    }
    return texels;
}

// Returns a plan of the shadow casters only; each is drawn for all samples.
FramePlan castersOf(const FramePlan& plan) {
    FramePlan casters = plan;
    casters.objects = plan.shadows.casters;
    for (ObjectPlan& object : casters.objects) {
        object.fine.firstSample = 0;
        object.fine.sampleCount = static_cast<std::uint32_t>(plan.samples.size());
        if (plan.moments.empty()) object.motion.clear();
    }
    return casters;
}

}  // namespace

std::uint64_t shadowMapBytes(const Scene& scene, const FramePlan& plan) {
    const auto size = static_cast<std::uint64_t>(plan.shadows.size);
    const std::uint64_t texel =
        pixelBytes(TextureFormat::depth32f) + (tintsLight(scene, plan) ? pixelBytes(TextureFormat::rgba32f) : 0);
    return mapsPerSample(plan) * size * size * texel;
}

ShadowMaps::ShadowMaps(const GpuScene& scene, SubmissionPacer& pacer, bool vertexShaderLayers,
                       std::filesystem::path shaderFolder)
    : scene_(&scene),
      casters_(scene, pacer,
               {.fragmentShader = "shadows/caster.frag",
                .defines = {},
                .look = SurfaceLook::caster,
                .vertexShaderLayers = vertexShaderLayers,
                .shaderFolder = std::move(shaderFolder)}) {}

void ShadowMaps::prepare(const FramePlan& plan, const FrameUniforms& frame) {
    defines_.clear();
    if (plan.shadows.maps.empty() || plan.samples.empty()) {
        maps_ = GlTexture();
        tintedMaps_ = GlTexture();
        return;
    }
    const World& world = scene_->world();
    const Environment& environment = world.environment;
    if (!environment.map || environment.map.get() != directionsOf_) directions_ = environmentDirections(world);
    directionsOf_ = environment.map.get();
    frame_ = &frame;
    plan_ = castersOf(plan);
    defines_ = mapDefines(plan, world.lights.size());
    const bool tinted = tintsLight(*world.scene, plan);
    if (tinted) defines_.emplace_back("tintedShadows", "true");
    projections_ = TexelBuffer(texelsOf(shadowProjections(world, plan, directions_)), GL_RGBA32F, 4,
                               "shadow-map projections (use fewer samples)");
    const auto layers = static_cast<int>(frame.layerCount() * mapsPerSample(plan));
    if (!maps_ || maps_.info().width != plan.shadows.size || maps_.info().layers != layers ||
        static_cast<bool>(tintedMaps_) != tinted) {
        target_ = Target();
        maps_ = GlTexture();  // free the old maps first: there may not be enough memory for both
        tintedMaps_ = GlTexture();
        const auto mapsOf = [&](TextureFormat format) {
            return GlTexture(
                {.format = format, .width = plan.shadows.size, .height = plan.shadows.size, .layers = layers});
        };
        maps_ = mapsOf(TextureFormat::depth32f);
        if (tinted) tintedMaps_ = mapsOf(TextureFormat::rgba32f);
        target_ = tinted ? Target({&tintedMaps_}, &maps_) : Target({}, &maps_);
    }
    casters_.prepare(plan_, frame, this);
}

void ShadowMaps::draw(std::uint32_t first, std::uint32_t count) {
    if (defines_.empty()) return;
    target_.bind();
    glDepthMask(GL_TRUE);
    constexpr float nothing[4] = {};  // depth is reversed: 0 is infinitely far from the light
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, nothing);
    if (tintedMaps_) glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, nothing);
    for (std::size_t slot = 0; slot < mapsPerSample(plan_); ++slot)
        casters_.drawCasters(first, count, static_cast<int>(slot), static_cast<bool>(tintedMaps_));
}

void ShadowMaps::bind(std::uint32_t sample) const {
    (tintedMaps_ ? tintedMaps_ : maps_).attach(mapsUnit);
    projections_.attach(projectionsUnit);
    const std::uint32_t layer = sample % blockSamples % frame_->layerCount();
    glUniform1i(firstSampleLocation, static_cast<GLint>(sample - layer));
}

}  // namespace defocus::engine
