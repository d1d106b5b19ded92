#pragma once
// Draws the surfaces of a FramePlan with one shader program per set of material features. A primitive needs at most two
// instanced draws per batch (wave) of samples, because its level of detail changes at most once within a batch. Two
// more draws are needed if the sample at which the level changes draws both levels, each in some of the pixels. A level
// with culled clusters needs one draw per index range.

#include <array>
#include <map>
#include <optional>
#include <string>

#include "gl/program.h"
#include "render/gpu_scene/backdrop.h"
#include "render/gpu_scene/material_blocks.h"
#include "render/gpu_scene/object_set.h"
#include "render/gpu_scene/surface_draws.h"
#include "render/gpu_scene/vertex_arrays.h"
#include "render/occlusion/occlusion.h"

namespace defocus::engine {

struct SurfacePassInfo {
    std::string fragmentShader;  // path under shaders/
    ShaderDefines defines;       // defines of the pass, such as the layer format
    SurfaceLook look = SurfaceLook::seenThrough;
    // true: surfaces with BlendRun::stochastic are drawn with stochastic alpha; false: they are sorted and blended.
    bool stochasticAlpha = false;
    bool readsOwnBlur = false;       // true: the fragment shader reads the blur modifiers of surfaces
    bool readsPosition = false;      // true: the fragment shader reads surface positions even without shadows
    bool vertexShaderLayers = true;  // false: geometry shaders select the layer
    bool writesLayers = false;       // true: the fragment shader is accumulation/layers.frag
    bool writesNumbers = false;      // true: the fragment shader writes the indices of objects and materials
    std::filesystem::path shaderFolder;
};

class ShadowMaps;

class SurfacePass {
public:
    // `scene` and `pacer` must outlive this object. `pacer` must belong to the current context.
    SurfacePass(const GpuScene& scene, SubmissionPacer& pacer, SurfacePassInfo info)
        : scene_(&scene), pacer_(&pacer), info_(std::move(info)) {}

    // Prepares the draws and programs of `plan`. `shadows`: shadow maps of the plan; null without shadows. Lit surfaces
    // read the maps, and a pass with SurfaceLook::caster draws them. `frame` and `shadows` must exist until the last
    // draw.
    void prepare(const FramePlan& plan, const FrameUniforms& frame, const ShadowMaps* shadows = nullptr);
    // Draws the opaque, alpha-tested and stochastically transparent surfaces of samples [first, first + count), front
    // to back.
    void drawOpaque(std::uint32_t first, std::uint32_t count);
    // Returns the draws of drawOpaque, for Occlusion::prepare.
    [[nodiscard]] std::vector<OccludableDraw> opaqueDraws() const;
    // Draws the same image as drawOpaque, but skips hidden triangles if there are enough of them. `occlusion` must have
    // been prepared with opaqueDraws(). Layer `layer` of `depths` is the depth buffer of sample `first`, and the next
    // layers are the depth buffers of the next samples. Triangles are classified as visible or hidden once per block of
    // 64 samples. The batch (wave) with the block's first sample sets `block` to this classification; other batches
    // wait for it. Returns the number of skipped triangles.
    std::uint64_t drawOpaqueVisible(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                    std::uint32_t layer, const Occlusion& occlusion, WaveVisibility& block);
    // Draws alpha-blended and transmitting surfaces, in the order of FramePlan::blendOrder. `colors` is the render
    // target and already contains the environment. A transmitting surface shows a copy of `colors` made before its
    // object is drawn. The number of copies is limited: with more transmitting objects, only the nearest are visible
    // through each other. `objects` must contain all transmitting objects or none.
    void drawTranslucent(std::uint32_t first, std::uint32_t count, const GlTexture& colors,
                         const ObjectSet& objects = {});
    // Sets whether alpha-blended surfaces add their alpha to the target's alpha. If so, alpha exceeds 1 where they
    // cover opaque surfaces.
    void markBlended(bool marks) { marksBlended_ = marks; }
    [[nodiscard]] bool hasTranslucent() const { return !translucent_.empty(); }
    // Draws alpha-blended and transmitting surfaces into depth and all colour attachments except the first.
    void drawTranslucentDepth(std::uint32_t first, std::uint32_t count, const ObjectSet& objects = {});
    // Draws all surfaces of samples [first, first + count) as if they were opaque.
    void drawSurfaces(std::uint32_t first, std::uint32_t count);
    // Draws front and back faces of all surfaces into shadow map `slot` of each sample. `tinted`: the maps have a depth
    // per colour channel.
    void drawCasters(std::uint32_t first, std::uint32_t count, int slot, bool tinted);
    // Draws all surfaces without depth test and adds each fragment to the target by blending.
    void drawTouched(std::uint32_t first, std::uint32_t count);
    // Draws the environment into pixels without a surface. This is needed for environment maps; LayerSum can composite
    // other environments when it adds layers (images of samples).
    void drawSky(std::uint32_t first, std::uint32_t count);

    [[nodiscard]] std::size_t bytes() const;

private:
    enum class ScreenDoor {
        open,         // the level of detail is drawn in all pixels
        coarseShare,  // for a sample that mixes two levels: draws the pixels that show the coarser level
        fineShare,    // for a sample that mixes two levels: draws the pixels that show the finer level
    };

    struct Draw {  // one primitive of an object at one level of detail
        int mesh = -1;
        std::uint32_t level = 0;
        std::uint32_t primitive = 0;
        std::uint32_t object = 0;  // index into FramePlan::objects
        int material = -1;
        std::size_t materialSlot = 0;  // index into the material blocks
        std::uint32_t firstSample = 0;
        std::uint32_t sampleCount = 0;
        std::vector<IndexRun> runs;  // index ranges of the primitive
        std::uint32_t triangleCount = 0;
        bool mirrored = false;
        bool cuts = false;
        bool blurMoves = false;
        bool stochasticAlpha = false;
        bool partial = false;  // `runs` are ranges of partIndices_ instead of MeshBuffers::indices
        Refinement refinement = Refinement::none;
        ScreenDoor screenDoor = ScreenDoor::open;
        const Program* program = nullptr;
    };

    // Inputs of the latest draw. A draw with the same inputs does not bind them again, because binding takes longer
    // than drawing a small object.
    struct Bound {
        const Program* program = nullptr;
        int mesh = -1;
        std::uint32_t level = 0;
        GLuint indices = 0;
        std::optional<std::uint32_t> sample;  // first sample of the draw
        std::optional<std::uint32_t> object;
        std::optional<std::size_t> materialSlot;
    };

    // Shader programs of one pass. All have the defines of the pass; the key stands for the additional defines of a
    // draw.
    using Programs = std::map<std::string, Program>;

    void uploadMaterials();
    void addDraws(const FramePlan& plan);
    void addPrimitive(const FramePlan& plan, const BlendRun& run, std::vector<std::uint32_t>& partIndices);
    void addLevel(const Draw& draw, const ObjectPlan& object, const LevelDraw& level, ScreenDoor boundary);
    const Program& program(const Draw& draw);
    [[nodiscard]] bool shaded() const {
        return info_.look == SurfaceLook::lit || info_.look == SurfaceLook::seenThrough;
    }
    [[nodiscard]] bool needsGeometryShader(const Draw& draw) const;
    [[nodiscard]] ShaderDefines passDefines(bool vertexShaderLayers) const;
    [[nodiscard]] std::vector<std::string> shadersOf(const Draw& draw) const;
    void bindFrame();
    void bindSolid(GLenum depthTest);
    void addSamples(VertexArray& array) const;
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
    void bindVertices(const Draw& item, const Buffer& indices);

    const GpuScene* scene_;
    SubmissionPacer* pacer_;
    SurfacePassInfo info_;
    std::map<std::string, Programs> programs_;  // all programs, keyed by the defines of their pass
    std::array<ShaderDefines, 2>
        passDefines_;  // defines of this frame; index 0: with a geometry shader that selects the layer; 1: without
    std::array<Programs*, 2> passPrograms_{};  // entry i: the programs compiled with passDefines_[i]
    Bound bound_;
    Program sky_;
    ShaderDefines skyDefines_;
    VertexArrays arrays_;
    VertexArray skyArray_;
    const FrameUniforms* frame_ = nullptr;
    const ShadowMaps* shadows_ = nullptr;
    int shadowSlot_ = 0;  // shadow map into which casters are drawn
    std::vector<GpuObject> objects_;
    MaterialBlocks materialBlocks_;
    std::vector<GpuPoses> poses_;  // poses, one entry per object
    std::map<int, std::size_t> materialSlots_;
    std::vector<Draw> opaque_;
    std::vector<Draw> dissolved_;  // draws of stochastically transparent parts of primitives
    Buffer partIndices_;           // vertex indices of the triangles in BlendRun::triangles
    bool marksBlended_ = false;
    std::vector<Draw> translucent_;  // draws of sorted alpha-blended or transmitting surfaces, farthest first
    std::size_t transmittingObjects_ = 0;
    bool blursBackdrop_ = false;  // true if a transmitting surface is rough
    Backdrop backdrop_;
};

}  // namespace defocus::engine
