#pragma once
// Draws the surfaces of a FramePlan: one shader program for each set of features that the drawn materials need, and per
// object, primitive and wave at most two instanced draws (a wave meets at most one boundary between levels); two more
// where a sample at that boundary is split over its pixels. A level that clusters are left out of is drawn run by run
// of its indices.

#include <map>
#include <optional>
#include <string>

#include "gl/pacer.h"
#include "gl/program.h"
#include "render/gpu_scene/backdrop.h"
#include "render/gpu_scene/object_set.h"
#include "render/gpu_scene/surface_draws.h"
#include "render/occlusion/occlusion.h"

namespace defocus::engine {

struct SurfacePassInfo {
    std::string fragmentShader;  // under shaders/
    ShaderDefines defines;       // of the pass (layer format …)
    SurfaceLook look = SurfaceLook::seenThrough;
    bool vertexShaderLayers = true;  // false: a geometry shader picks the layer
    std::filesystem::path shaderFolder;
};

class ShadowMaps;

class SurfacePass {
public:
    SurfacePass(GpuScene& scene, SurfacePassInfo info)
        : scene_(&scene), info_(std::move(info)), occlusion_(scene.world()) {}

    // Builds the draws and programs of `plan`. `frame` and `shadows` must outlive the drawing. `shadows`, of the same
    // plan: the maps to be read, or of casters those to be drawn; null where there are none.
    void prepare(const FramePlan& plan, const FrameUniforms& frame, const ShadowMaps* shadows = nullptr);
    // Draws samples [first, first + count) of the opaque and alpha-tested surfaces, front to back.
    void drawOpaque(std::uint32_t first, std::uint32_t count);
    // Draws the same picture, and of the plan's opaque surfaces only what each sample may show, where that is much
    // less. Sample `first` is drawn into layer `layer`, the others into those after it, and these are the layers'
    // depths. Returns how many triangles are left out. findHidden goes before it, for the plan of prepare, which must
    // then outlive the drawing.
    void findHidden(const FramePlan& plan);
    std::uint64_t drawOpaqueVisible(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                    std::uint32_t layer);
    // The same for alpha-blended and transmitting surfaces, object by object and back to front. `colors` is what is
    // drawn into, the environment included: a transmitting surface shows a copy of what it holds before its object is
    // drawn. Of many such objects, only the nearest see each other. `objects` has all that transmit, or none.
    void drawTranslucent(std::uint32_t first, std::uint32_t count, const GlTexture& colors,
                         const ObjectSet& objects = {});
    // Whether alpha-blended surfaces add their alpha to what is there, so that it is above 1 where they lie over what
    // is opaque.
    void markBlended(bool marks) { marksBlended_ = marks; }
    [[nodiscard]] bool hasTranslucent() const { return !translucent_.empty(); }
    // Only the depth of the alpha-blended and transmitting surfaces, and what the shader writes beside the colour.
    void drawTranslucentDepth(std::uint32_t first, std::uint32_t count, const ObjectSet& objects = {});
    // All surfaces, translucent ones too, as if they were opaque.
    void drawSurfaces(std::uint32_t first, std::uint32_t count);
    // The same into the shadow map `slot` of each sample, both sides of each surface.
    void drawCasters(std::uint32_t first, std::uint32_t count, int slot);
    // All of them, each fragment added to what is there: nothing hides anything.
    void drawTouched(std::uint32_t first, std::uint32_t count);
    // The environment behind everything, where no surface was drawn. (The accumulation composes skies that are simpler
    // than maps when it adds layers.)
    void drawSky(std::uint32_t first, std::uint32_t count);

    [[nodiscard]] std::size_t bytes() const;

private:
    enum class ScreenDoor {
        open,         // every pixel
        coarseShare,  // the pixels of a boundary sample that draw the coarser level
        fineShare,    // the others
    };

    struct Draw {  // a primitive of an object at one level
        int mesh = -1;
        std::uint32_t level = 0;
        std::uint32_t primitive = 0;
        std::uint32_t object = 0;  // into the object blocks
        int material = -1;
        std::uint32_t firstSample = 0;
        std::uint32_t sampleCount = 0;
        std::vector<IndexRun> runs;  // of the primitive's indices
        std::uint32_t triangleCount = 0;
        bool mirrored = false;
        bool blurMoves = false;
        Refinement refinement = Refinement::none;
        ScreenDoor screenDoor = ScreenDoor::open;
        const Program* program = nullptr;
    };

    void uploadMaterials();
    void addDraws(const FramePlan& plan);
    void addLevel(const Draw& draw, const ObjectPlan& object, const LevelDraw& level, ScreenDoor boundary);
    const Program& program(const Draw& draw);
    [[nodiscard]] bool shaded() const {
        return info_.look == SurfaceLook::lit || info_.look == SurfaceLook::seenThrough;
    }
    [[nodiscard]] ShaderDefines passDefines(bool vertexShaderLayers) const;
    void bindFrame();
    void bindSolid(GLenum depthTest);
    void bindSamples(VertexArray& array) const;
    void drawSolid(const std::vector<Draw>& items, std::uint32_t first, std::uint32_t count,
                   GLenum depthTest = GL_GREATER, const ObjectSet& objects = {});
    void drawFronts(const std::vector<Draw>& items, std::uint32_t first, std::uint32_t count,
                    const ObjectSet& objects = {});
    void drawFront(const Draw& item, std::uint32_t first, std::uint32_t count);
    void drawBlended(const Draw& item, std::uint32_t first, std::uint32_t count);
    void draw(const Draw& item, std::uint32_t first, std::uint32_t count);
    std::uint64_t drawRemaining(const RemainingDraws& remaining, std::uint32_t first, std::uint32_t count);
    void setFaces(const Draw& item) const;
    void bindDraw(const Draw& item, std::uint32_t sample, const Buffer& indices);
    void submit(std::uint32_t first, std::uint32_t end, std::uint64_t triangles, const auto& drawSamples);

    GpuScene* scene_;
    SurfacePassInfo info_;
    std::map<std::string, Program> programs_;
    SubmissionPacer pacer_;
    Program sky_;
    ShaderDefines skyDefines_;  // that sky_ was built with
    VertexArray skyArray_;
    const FrameUniforms* frame_ = nullptr;
    const ShadowMaps* shadows_ = nullptr;
    int shadowSlot_ = 0;  // that casters are drawn into
    UniformBlocks<GpuObject> objectBlocks_;
    UniformBlocks<GpuMaterial> materialBlocks_;
    std::vector<GpuPoses> poses_;  // as many as objects
    std::map<int, std::size_t> materialSlots_;
    std::vector<Draw> opaque_;
    bool marksBlended_ = false;
    std::vector<Draw> translucent_;  // alpha-blended or transmitting, the farthest first
    std::size_t transmittingObjects_ = 0;
    bool blursBackdrop_ = false;  // some transmitting surface is rough
    Backdrop backdrop_;
    Occlusion occlusion_;
};

}  // namespace defocus::engine
